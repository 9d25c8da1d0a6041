// The steps from a real splat to an output word. Each has two sides: `device`, as docs/numerics.md rounds it, and
// `real`, as golden computes it; a mixture says which side each step takes (docs/errors.md).
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::stages {

/// In the order of the pipeline: a step works on what those before it made.
enum class Step : std::uint8_t {
  Position,  ///< a centre as a word S pi.pf (driver)
  Snap,      ///< that onto the 1/k grid
  Radius,    ///< the nearest radius set instead of the splat's own radius (driver)
  Emission,  ///< colour and optical depth of a whole splat as words U 4.cf, with the carry (driver)
  Depth,     ///< depths and slab boundaries in steps of 2^-zf kernel unit (driver)
  Phi,       ///< cumulative slice weight as One.hf (driver)
  Share,     ///< a slab's part of a splat as words U 0.cf (driver)
  Distance,  ///< q: squared distance along an axis as an RLUT word (driver)
  Index,     ///< t: of the radial table, whose entry stands for the middle of its step
  Weight,    ///< an entry as a word U wi.wf (driver)
  Product,   ///< colour times weight as U si.sf
  Sheet,     ///< sums are cut at the largest word U si.sf
  // Of frames whose sheets are densities (DensitySteps), pixel by pixel; others have nothing to do here:
  Transfer,   ///< colour and optical depth by straight lines between words, of a density of at most 1
  Slope,      ///< the density's differences as words of a gradient, S 4.16
  Normal,     ///< what makes its length 1, and its length: 1/sqrt from a table
  Facing,     ///< its cosines to light and half vector, One.14
  Phong,      ///< what light makes of them, U 5.12 and One.12
  Blend,      ///< share of shading, by the gradient floor, One.8
  Shaded,     ///< shaded colour as One.16
  Colour,     ///< that times optical depth as U si.sf
  Factor,     ///< slab factor from a table, interpolated, One.of
  Slab,       ///< slab colour and opacity as One.tf
  Composite,  ///< transmittance times slab as One.tf
  Freeze,     ///< below eps nothing changes any more
  Pixel,      ///< output words U xi.xf
};
inline constexpr std::size_t kStepCount = 25;

/// Steps that are exchanged together where their number has to be small.
enum class Group : std::uint8_t { Place, Material, Footprint, Sheets, Classification, Picture };
inline constexpr std::size_t kGroupCount = 6;

struct StepFacts {
  const char* name;  ///< "emission"
  Group group;
  bool driver;          ///< made by the driver and loaded; else the device's own
  const char* meaning;  ///< "colour and optical depth as words"
  const char* keys;     ///< of the configuration that decide it; empty: its formats are the device's design
};
const StepFacts& facts(Step step);
/// Only of frames whose sheets are densities.
inline bool of_densities(Step step) { return facts(step).group == Group::Classification; }
const char* to_string(Group group);
inline constexpr std::array<Step, kStepCount> all_steps() {
  std::array<Step, kStepCount> steps{};
  for (std::size_t i = 0; i < kStepCount; ++i) steps[i] = static_cast<Step>(i);
  return steps;
}

/// Which steps are the device's; the others are real.
class Mixture {
 public:
  constexpr Mixture() = default;
  Mixture(std::initializer_list<Step> device) {
    for (const Step step : device) set(step);
  }
  static Mixture all_device() {
    Mixture all;
    all.device_.set();
    return all;
  }
  bool device(Step step) const { return device_[static_cast<std::size_t>(step)]; }
  void set(Step step, bool device = true) { device_.set(static_cast<std::size_t>(step), device); }
  Mixture with(std::span<const Step> steps, bool device = true) const {
    Mixture out = *this;
    for (const Step step : steps) out.set(step, device);
    return out;
  }
  /// None of the steps first..last is the device's.
  bool real(Step first, Step last) const {
    for (auto i = static_cast<std::size_t>(first); i <= static_cast<std::size_t>(last); ++i) {
      if (device_[i]) return false;
    }
    return true;
  }
  bool operator==(const Mixture&) const = default;
  std::string text() const;  ///< "position, snap"; "none"; "all"

 private:
  std::bitset<kStepCount> device_;
};

/// Steps whose errors are reported as one.
struct StepSet {
  std::string name;  ///< of its steps, with '+'
  std::vector<Step> steps;
  const char* by = "";  ///< who rounds: "driver", "device" or "both"
};
/// Every step by itself, in order, except that position and snap are one step if together they round once. If k = 2^pf,
/// the snap of a position is the position. If the driver leaves the rounding to the snap, each alone would move every
/// splat.
/// With error diffusion, the words of splats make up for what products lose: `carried` has emission and product as one,
/// in the product's place. Steps of densities exist only if the frame has them: `densities`.
std::vector<StepSet> step_sets(const cmodel::Config& config, bool carried, bool densities);
std::vector<StepSet> group_sets(bool densities);

}  // namespace fastsplat::stages
