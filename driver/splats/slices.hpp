// SPDX-License-Identifier: Apache-2.0
// Distributes a splat among the sheets it reaches (docs/numerics.md, N-8-44 to N-8-48): integers only, telescoping.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "driver/tables/quantise.hpp"
#include "scene/kernel.hpp"
#include "scene/scene.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::driver {

/// Whole splat: R, G, B, tau as words of U 4.cf.
using SplatWords = std::array<std::uint32_t, 4>;

struct Share {
  SplatWords words{};      ///< U 0.cf
  bool saturated = false;  ///< a channel did not fit U 0.cf
  bool empty() const { return (words[0] | words[1] | words[2] | words[3]) == 0; }
};

/// A kernel that anti-aliasing stretched along the view axis (docs/numerics.md, section 8, "Ellipses").
struct DepthGrowth {
  std::uint32_t shrink = 1U << 16;  ///< factor on depths, One.16; its word is at least 1
  std::int32_t half = 0;            ///< the kernel's half depth, depth steps
};

/// What a sheet takes of every splat.
struct SheetCut {
  const std::uint64_t* phi = nullptr;  ///< cumulative weights, 32 fraction bits; null: the whole splat
  std::int32_t last = 0;               ///< index of the last one
  std::int32_t near = 0, far = 0;      ///< index at the sheet's boundaries for depth 0; greater depths: less
  std::uint32_t largest = 0;           ///< word of U 0.cf
};

/// Slabs of a frame and the kernel's cumulative weights.
class Slices {
 public:
  /// `count` slabs of `width` kernel units from depth 0 on. Throws UserError (Usage) if two boundaries coincide.
  Slices(const cmodel::Config& config, const scene::Kernel& kernel, double width, int count);

  int count() const { return static_cast<int>(boundary_.size()) - 1; }
  /// B_s, s = 0..count(): in depth steps from the first boundary.
  std::int32_t boundary(int s) const { return boundary_[static_cast<std::size_t>(s)]; }
  /// Depth (kernel units from the first boundary) as a word: 2^zf steps per kernel unit.
  std::int32_t quantise_depth(double depth) const;
  const Target& depth_target() const { return depth_; }
  /// First and last slab that a kernel centred at `depth` reaches.
  int first(std::int32_t depth) const {
    const std::int32_t front = depth - middle_;
    return last_that(front, [front](std::int32_t boundary) { return boundary <= front; });
  }
  int last(std::int32_t depth) const {
    const std::int32_t back = depth + middle_;
    return last_that(back, [back](std::int32_t boundary) { return boundary < back; });
  }
  /// The most slabs that a kernel reaches beyond its first.
  int reach() const;
  // The same for a grown kernel. Half depths are limited to kDeepest, beyond any depth.
  static constexpr std::uint64_t kDeepest = std::uint64_t{1} << 28;
  DepthGrowth growth(std::uint32_t shrink) const {
    const auto words = static_cast<std::uint32_t>(middle_) << 16;
    return {shrink, static_cast<std::int32_t>(std::min((std::uint64_t{words} + shrink - 1) / shrink, kDeepest))};
  }
  int first(std::int32_t depth, const DepthGrowth& growth) const {
    return last_that(depth - growth.half, [front = depth - growth.half](std::int32_t at) { return at <= front; });
  }
  int last(std::int32_t depth, const DepthGrowth& growth) const {
    return last_that(depth + growth.half, [back = depth + growth.half](std::int32_t at) { return at < back; });
  }
  int reach(const DepthGrowth& growth) const;
  Share share(const SplatWords& whole, std::int32_t depth, int s, const DepthGrowth& growth) const {
    return between(whole, cumulative(depth, s, growth), cumulative(depth, s + 1, growth));
  }
  /// The splat's share in slab s.
  Share share(const SplatWords& whole, std::int32_t depth, int s) const {
    return between(whole, cumulative(depth, s), cumulative(depth, s + 1));
  }
  SheetCut cut(int s) const {
    return {.phi = phi_.data(),
            .last = 2 * middle_,
            .near = cut_[static_cast<std::size_t>(s)] + middle_,
            .far = cut_[static_cast<std::size_t>(s) + 1] + middle_,
            .largest = largest_};
  }
  SheetCut uncut() const { return {.largest = largest_}; }
  /// The same for consecutive slabs, starting with the first that the splat reaches. `before` is the part in front of
  /// slab s, initially 0; the call updates it for the next slab.
  Share next_share(const SplatWords& whole, std::int32_t depth, int s, SplatWords& before) const {
    const std::uint64_t far = cumulative(depth, s + 1);
    SplatWords difference;
    for (std::size_t c = 0; c < 4; ++c) {
      const std::uint32_t end = part(whole[c], far);
      difference[c] = end - before[c];
      before[c] = end;
    }
    return this->whole(difference);
  }
  /// The part of a hidden share that counters need.
  struct Outline {
    std::uint32_t largest = 0;  ///< largest of the four words; 0: the share is empty
    std::uint32_t excess = 0;   ///< its excess over tau
    bool saturated = false;
  };
  static Outline outline(const Share& share) {
    const auto& words = share.words;
    const std::uint32_t largest = std::max({words[0], words[1], words[2], words[3]});
    return {largest, largest - words[3], share.saturated};
  }
  /// visit(outline) for slabs first to last.
  template <class Visit>
  void outlines(const SplatWords& whole, std::int32_t depth, int first, int last, Visit visit) const {
    const std::uint32_t tau = whole[3], colour = std::max({whole[0], whole[1], whole[2]});
    const std::uint64_t above = tau > colour ? tau - colour : 0;
    std::uint64_t near = cumulative(depth, first);
    std::uint32_t before = part(tau, near);
    for (int s = first; s <= last; ++s) {
      const std::uint64_t far = cumulative(depth, s + 1);
      const std::uint32_t end = part(tau, far), word = end - before;
      // If tau's exact share exceeds the colours' by a word or more, rounding cannot reverse this: each of the two
      // differences is less than a word from the exact one.
      if (above * (far - near) >> 32 != 0) {
        visit(Outline{std::min(word, largest_), 0, word > largest_});
      } else {
        visit(outline(share(whole, depth, s)));
      }
      near = far;
      before = end;
    }
  }
  /// The whole splat in one sheet.
  Share whole(const SplatWords& whole) const {
    Share out;
    for (std::size_t c = 0; c < 4; ++c) {
      out.words[c] = std::min(whole[c], largest_);
      out.saturated = out.saturated || whole[c] > largest_;
    }
    return out;
  }

 private:
  /// Share of the kernel before a boundary, 32 fraction bits: 0 before the first boundary, 1 after the last.
  std::uint64_t cumulative(std::int32_t depth, int boundary) const {
    const std::int32_t at = cut_[static_cast<std::size_t>(boundary)] - depth + middle_;
    return phi_[static_cast<std::size_t>(std::clamp(at, 0, 2 * middle_))];
  }
  Share between(const SplatWords& whole, std::uint64_t near, std::uint64_t far) const {
    SplatWords difference;
    for (std::size_t c = 0; c < 4; ++c) difference[c] = part(whole[c], far) - part(whole[c], near);
    return this->whole(difference);
  }
  std::uint64_t cumulative(std::int32_t depth, int boundary, const DepthGrowth& growth) const {
    const std::int64_t steps = std::int64_t{cut_[static_cast<std::size_t>(boundary)]} - depth;
    const std::int64_t at = ((steps * growth.shrink) >> 16) + middle_;
    return phi_[static_cast<std::size_t>(std::clamp(at, std::int64_t{0}, std::int64_t{2} * middle_))];
  }
  /// Last slab whose near boundary is `before` the depth, else the first one. Boundaries lie nearly evenly: a guess,
  /// then a step or two.
  template <class Before>
  int last_that(std::int32_t depth, Before before) const {
    int s = std::clamp(static_cast<int>(depth * per_step_), 0, count() - 1);
    while (s + 1 < count() && before(boundary_[static_cast<std::size_t>(s) + 1])) ++s;
    while (s > 0 && !before(boundary_[static_cast<std::size_t>(s)])) --s;
    return s;
  }
  /// narrow<RND, SAT>(word * phi) to the whole's format; phi is at most 1.0, so nothing saturates. Zeros extend phi
  /// from hf to 32 fraction bits, so that the shift is a constant.
  static std::uint32_t part(std::uint32_t word, std::uint64_t phi) {
    return static_cast<std::uint32_t>((word * phi + (std::uint64_t{1} << 31)) >> 32);
  }

  std::uint32_t largest_;  ///< word of U 0.cf
  std::int32_t middle_;    ///< M/2
  double per_step_ = 0.0;  ///< slabs per depth step
  Target depth_;
  std::vector<std::uint64_t> phi_;      ///< M+1 words One.hf, with zeros to 32 fraction bits
  std::vector<std::int32_t> boundary_;  ///< B_s
  std::vector<std::int32_t> cut_;       ///< B_s, with the first and the last out of every kernel's reach
};

/// The slices of a frame; unused if its splats are not sliced.
Slices frame_slices(const cmodel::Config& config, const scene::Scene& scene, const scene::SheetPlan& plan);

}  // namespace fastsplat::driver
