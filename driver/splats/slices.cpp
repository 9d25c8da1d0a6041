// SPDX-License-Identifier: Apache-2.0
#include "driver/splats/slices.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "driver/tables/quantise.hpp"
#include "driver/tables/tables.hpp"

namespace fastsplat::driver {

Slices::Slices(const cmodel::Config& config, const scene::Kernel& kernel, double width, int count)
    : largest_(static_cast<std::uint32_t>(config.colour_format().max)), depth_(target(Site::Depth, config)) {
  for (const std::uint32_t word : slice_table(config, kernel))
    phi_.push_back(std::uint64_t{word} << (32 - config.slice_frac_bits));
  middle_ = static_cast<std::int32_t>(phi_.size() / 2);
  const Target boundary = target(Site::Boundary, config);
  for (int s = 0; s <= count; ++s) {
    boundary_.push_back(quantise_to<std::int32_t>(s * width, boundary));
    if (s > 0 && boundary_[static_cast<std::size_t>(s)] == boundary_[static_cast<std::size_t>(s) - 1]) {
      throw_usage({.where = "configuration " + config.name,
                   .what = "slabs are thinner than the depth steps of the slice table",
                   .expected = fmt::format("at least {} kernel units (slices.phase_bits = {})",
                                           std::ldexp(1.0, -config.slice_phase_bits), config.slice_phase_bits),
                   .got = fmt::format("{}", width),
                   .fix = "use a larger --slab-width or fewer --xray-sheets"});
    }
  }
  constexpr std::int32_t kBeyond = std::int32_t{1} << 29;
  cut_ = boundary_;
  cut_.front() = -kBeyond;
  cut_.back() = kBeyond;
  per_step_ = count / static_cast<double>(boundary_.back());
}

int Slices::reach() const { return reach({.half = middle_}); }

int Slices::reach(const DepthGrowth& growth) const {
  int most = 0;
  // Back end of the deepest kernel whose first slab is s.
  for (int s = 0; s < count(); ++s) {
    const std::int32_t back = boundary_[static_cast<std::size_t>(s) + 1] - 1 + 2 * growth.half;
    most = std::max(most, last_that(back, [back](std::int32_t boundary) { return boundary < back; }) - s);
  }
  return most;
}

std::int32_t Slices::quantise_depth(double depth) const { return quantise_to<std::int32_t>(depth, depth_); }

Slices frame_slices(const cmodel::Config& config, const scene::Scene& scene, const scene::SheetPlan& plan) {
  const bool sliced = plan.use == scene::SheetUse::Sliced;
  return Slices(config, scene.kernel, sliced ? plan.slabs.width : 1.0, sliced ? plan.slabs.count : 1);
}

}  // namespace fastsplat::driver
