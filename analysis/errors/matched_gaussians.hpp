// SPDX-License-Identifier: Apache-2.0
// Which Gaussian of one cloud became which of another: encoders reorder, drop and round them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::analysis {

/// For each Gaussian of `from` the one of `to`, each at most once: a stable matching among the nearest by position, of
/// likeness in position, scales, opacity and colour. Clouds of one size whose order fits keep it.
std::vector<std::optional<std::uint32_t>> matched_gaussians(const scene::GaussianCloud& from,
                                                            const scene::GaussianCloud& to);

}  // namespace fastsplat::analysis
