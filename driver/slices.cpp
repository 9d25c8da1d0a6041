#include "driver/slices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "cmodel/narrow.hpp"
#include "driver/quantise.hpp"
#include "driver/tables.hpp"

namespace fastsplat::driver {

using cmodel::narrow;
using cmodel::Overflow;
using cmodel::Rounding;

Slices::Slices(const cmodel::Config& config, const scene::Kernel& kernel, double width, int count)
    : config_(config), depth_(target(Site::Depth, config)), phi_(slice_table(config, kernel)) {
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
}

std::int32_t Slices::quantise_depth(double depth) const { return quantise_to<std::int32_t>(depth, depth_); }

int Slices::first(std::int32_t depth) const {
  const std::int32_t front = depth - static_cast<std::int32_t>(phi_.size() / 2);
  const auto above = std::upper_bound(boundary_.begin(), boundary_.end(), front);
  return std::clamp(static_cast<int>(above - boundary_.begin()) - 1, 0, count() - 1);
}

int Slices::last(std::int32_t depth) const {
  const std::int32_t back = depth + static_cast<std::int32_t>(phi_.size() / 2);
  const auto at_or_above = std::lower_bound(boundary_.begin(), boundary_.end(), back);
  return std::clamp(static_cast<int>(at_or_above - boundary_.begin()) - 1, 0, count() - 1);
}

std::uint32_t Slices::cumulative(std::int32_t depth, int boundary) const {
  const auto steps = static_cast<std::int32_t>(phi_.size()) - 1;
  if (boundary == 0) return phi_.front();
  if (boundary == count()) return phi_.back();
  return phi_[static_cast<std::size_t>(
      std::clamp(boundary_[static_cast<std::size_t>(boundary)] - depth + steps / 2, 0, steps))];
}

Share Slices::share(const SplatWords& whole, std::int32_t depth, int s) const {
  const std::int64_t near = cumulative(depth, s), far = cumulative(depth, s + 1);
  const int frac_bits = config_.colour_frac_bits + config_.slice_frac_bits;
  const cmodel::Format whole_format = target(Site::Whole, config_).to;
  SplatWords difference{};
  for (std::size_t c = 0; c < 4; ++c) {
    difference[c] =
        static_cast<std::uint32_t>(narrow<Rounding::RND, Overflow::SAT>(whole[c] * far, frac_bits, whole_format).word -
                                   narrow<Rounding::RND, Overflow::SAT>(whole[c] * near, frac_bits, whole_format).word);
  }
  return this->whole(difference);
}

Share Slices::whole(const SplatWords& whole) const {
  Share out;
  for (std::size_t c = 0; c < 4; ++c) {
    const auto fitted =
        narrow<Rounding::TRN, Overflow::SAT>(whole[c], config_.colour_frac_bits, config_.colour_format());
    out.words[c] = static_cast<std::uint32_t>(fitted.word);
    out.saturated = out.saturated || fitted.overflow;
  }
  return out;
}

}  // namespace fastsplat::driver
