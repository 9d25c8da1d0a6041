// How a splat is shared out among the sheets it reaches (docs/numerics.md, section 8): integers only, telescoping.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cmodel/config.hpp"
#include "driver/quantise.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::driver {

/// Whole splat: R, G, B, tau as words of U 4.cf.
using SplatWords = std::array<std::uint32_t, 4>;

struct Share {
  SplatWords words{};      ///< U 0.cf
  bool saturated = false;  ///< a channel did not fit U 0.cf
  bool empty() const { return (words[0] | words[1] | words[2] | words[3]) == 0; }
};

/// Slabs of a frame and the kernel's cumulative weights.
class Slices {
 public:
  /// `count` slabs of `width` kernel units from depth 0 on. Throws UserError (Usage) if two boundaries coincide.
  Slices(const cmodel::Config& config, const scene::Kernel& kernel, double width, int count);

  int count() const { return static_cast<int>(boundary_.size()) - 1; }
  /// Depth (kernel units from the first boundary) as a word: 2^zf steps per kernel unit.
  std::int32_t quantise_depth(double depth) const;
  /// First and last slab that a kernel centred at `depth` reaches.
  int first(std::int32_t depth) const;
  int last(std::int32_t depth) const;
  /// What falls into slab s.
  Share share(const SplatWords& whole, std::int32_t depth, int s) const;
  /// The whole splat in one sheet.
  Share whole(const SplatWords& whole) const;

 private:
  std::uint32_t cumulative(std::int32_t depth, int boundary) const;

  cmodel::Config config_;
  Target depth_;
  std::vector<std::uint32_t> phi_;      ///< M+1 words One.hf
  std::vector<std::int32_t> boundary_;  ///< B_s
};

}  // namespace fastsplat::driver
