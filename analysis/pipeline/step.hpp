// SPDX-License-Identifier: Apache-2.0
// The steps from a real splat to an output word. Each has three sides: `device`, as docs/numerics.md rounds it, `real`,
// as golden computes it, and floats, as a floating-point unit would compute it (docs/floats.md). A mixture (hybrid
// pipeline) selects the side of each step (docs/errors.md).
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "analysis/pipeline/float_format.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::stages {

/// In pipeline order: each step takes the results of the steps before.
enum class Step : std::uint8_t {
  Position,  ///< a centre as a word S pi.pf (driver)
  Snap,      ///< the centre snapped to the 1/K grid
  Radius,    ///< the nearest radius set instead of the splat's own radius (driver)
  Emission,  ///< colour and optical depth of a whole splat as words U 4.cf, with error diffusion (driver)
  Depth,     ///< depths and slab boundaries in steps of 2^-zf kernel unit (driver)
  Phi,       ///< cumulative slice weight as One.hf (driver)
  Share,     ///< a slab's part of a splat as words U 0.cf (driver)
  Distance,  ///< q: squared distance along an axis as an RLUT word (driver)
  Index,     ///< t: radial table entry, which stands for the middle of its step
  Weight,    ///< an entry as a word U wi.wf (driver)
  Product,   ///< colour times weight as U si.sf
  Sheet,     ///< sums saturate at the largest word U si.sf
  // Only in frames whose sheets hold densities (DensitySteps), pixel by pixel:
  Transfer,   ///< colour and optical depth interpolated between words, density at most 1
  Slope,      ///< the density's differences as words of a gradient, S 4.16
  Normal,     ///< factor that normalises it, and its length: 1/sqrt from a table
  Facing,     ///< cosines of the normal to light and half vector, One.14
  Phong,      ///< diffuse and specular light, U 5.12 and One.12
  Blend,      ///< share of shading, by the gradient floor, One.8
  Shaded,     ///< shaded colour as One.16
  Colour,     ///< shaded colour times optical depth as U si.sf
  Factor,     ///< slab factor from a table, interpolated, One.of
  Slab,       ///< slab colour and opacity as One.tf
  Composite,  ///< transmittance times slab as One.tf
  Freeze,     ///< early termination below eps
  Pixel,      ///< output words U xi.xf
};
inline constexpr std::size_t kStepCount = 25;

/// Steps that are exchanged together, to keep the number of combinations small.
enum class Group : std::uint8_t { Place, Material, Footprint, Sheets, Classification, Picture };
inline constexpr std::size_t kGroupCount = 6;

struct StepFacts {
  const char* name;  ///< "emission"
  Group group;
  bool driver;          ///< made by the driver and loaded; else the device's own
  const char* meaning;  ///< "colour and optical depth as words"
  const char* keys;     ///< configuration keys that decide it; empty: its formats are fixed
};
const StepFacts& facts(Step step);
/// Whether the step is only for sheets of densities.
inline bool of_densities(Step step) { return facts(step).group == Group::Classification; }
const char* to_string(Group group);
inline constexpr std::array<Step, kStepCount> all_steps() {
  std::array<Step, kStepCount> steps{};
  for (std::size_t i = 0; i < kStepCount; ++i) steps[i] = static_cast<Step>(i);
  return steps;
}

/// The numbers of the steps that are floats.
struct FloatNumbers {
  FloatFormat operands{}, sums{};  ///< sums: of sheets, and of a pixel's colours
  bool subnormals = true;
  bool tile_centres = false;  ///< centres relative to the tile of a pixel, not to the picture
  std::string text() const;   ///< "fp16, sums fp32, centres in the tile"
};

/// A hybrid pipeline: a side for each step.
class Mixture {
 public:
  Mixture() = default;
  Mixture(std::initializer_list<Step> device) {
    for (const Step step : device) set(step);
  }
  static Mixture all_device() {
    Mixture all;
    all.device_.set();
    return all;
  }
  static Mixture all_floats(const FloatNumbers& numbers) {
    Mixture all;
    all.floats_.set();
    all.use(numbers);
    return all;
  }
  bool device(Step step) const { return device_[static_cast<std::size_t>(step)]; }
  bool floats(Step step) const { return floats_[static_cast<std::size_t>(step)]; }
  bool any_floats() const { return floats_.any(); }
  void set(Step step, bool device = true) { device_.set(static_cast<std::size_t>(step), device); }
  /// With these steps on the device, or real.
  Mixture with(std::span<const Step> steps, bool device = true) const {
    return with(steps, device ? all_device() : Mixture{});
  }
  /// With the sides that these steps have in `as`.
  Mixture with(std::span<const Step> steps, const Mixture& as) const {
    Mixture out = *this;
    for (const Step step : steps) {
      const auto i = static_cast<std::size_t>(step);
      out.device_.set(i, as.device_[i]);
      out.floats_.set(i, as.floats_[i]);
    }
    if (as.any_floats()) out.use(as.numbers_);
    return out;
  }
  /// Whether all steps first..last are real.
  bool real(Step first, Step last) const {
    for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
      if (device_[i] || floats_[i]) return false;
    }
    return true;
  }
  /// Rounds a step's operations, if it is floats; sums have their own format.
  const RoundToFloat& rounding(Step step) const { return floats(step) ? operand_ : exact_; }
  const RoundToFloat& sum_rounding(Step step) const { return floats(step) ? sum_ : exact_; }
  const FloatNumbers& numbers() const { return numbers_; }  ///< of the steps that are floats
  bool tile_centres() const { return numbers_.tile_centres; }
  bool operator==(const Mixture& other) const { return device_ == other.device_ && floats_ == other.floats_; }
  std::string text() const;  ///< "position, snap"; "none"; "all"; steps that are floats with the format: "weight fp16"

 private:
  void use(const FloatNumbers& numbers) {
    numbers_ = numbers;
    operand_ = RoundToFloat(numbers.operands, numbers.subnormals);
    sum_ = RoundToFloat(numbers.sums, numbers.subnormals);
  }

  std::bitset<kStepCount> device_, floats_;  ///< never both
  FloatNumbers numbers_;
  RoundToFloat operand_, sum_, exact_;
};

/// Steps whose errors are reported as one.
struct StepSet {
  std::string name;  ///< names of its steps, joined by '+'
  std::vector<Step> steps;
  const char* by = "";  ///< who rounds: "driver", "device" or "both"
};
/// Every step by itself, in order, except that position and snap are one step if together they round once. If K = 2^pf,
/// the snap of a position is the position. If the driver leaves the rounding to the snap, each alone would move every
/// splat. With error diffusion (`carried`), the words of splats compensate what products lose: emission and product are
/// one step, in the product's place. Steps of densities are included with `densities`.
std::vector<StepSet> step_sets(const cmodel::Config& config, bool carried, bool densities);
/// Those of 3-D Gaussians, which have neither sheets nor slabs of depth.
std::vector<StepSet> gaussian_sets(const cmodel::Config& config);
/// Those of `sets` whose results differ if their arithmetic is floats: not the grid of positions, the table's entries
/// and the comparison that terminates a pixel.
std::vector<StepSet> float_sets(std::vector<StepSet> sets);
std::vector<StepSet> group_sets(bool densities);

}  // namespace fastsplat::stages
