// SPDX-License-Identifier: Apache-2.0
// The floating-point renderer of 3-D Gaussians (docs/techniques/gaussians.md).
#pragma once

#include <cstdint>
#include <vector>

#include "base/image.hpp"
#include "base/progress.hpp"
#include "scene/gaussians/projected_gaussian.hpp"

namespace fastsplat::golden {

/// Order of Gaussians in depth. Centres: sorted once by the depth of their centres, as common renderers and the device
/// do. Pixels: sorted at every pixel by the depth at which each Gaussian is densest there.
enum class GaussianOrder { Centres, Pixels };

struct GaussianOptions {
  int threads = 0;  ///< 0: all cores. Never changes the result.
  Progress progress = {};
  GaussianOrder order = GaussianOrder::Centres;
  /// Caps opacity at kMostAlpha after multiplying by the kernel instead of before, as Kerbl et al. do. `projected` must
  /// then hold uncapped opacities.
  bool cap_samples = false;
  std::uint64_t* samples = nullptr;  ///< receives the number of composited samples
};

/// Returns RGBA, premultiplied, linear in the file's colours; A is the opacity. `projected` comes from project_all().
Image render_gaussians(const scene::GaussianScene& scene, const std::vector<scene::ProjectedGaussian>& projected,
                       const GaussianOptions& options = {});

}  // namespace fastsplat::golden
