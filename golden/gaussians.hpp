// The floating-point renderer of 3-D Gaussians (docs/techniques/gaussians.md).
#pragma once

#include <cstdint>
#include <vector>

#include "base/image.hpp"
#include "base/progress.hpp"
#include "scene/gaussians/projected_gaussian.hpp"

namespace fastsplat::golden {

/// What lies in front of what: decided once, by the depth of centres, as common renderers and the device do; or at
/// every pixel, by the depth at which each Gaussian is densest there.
enum class GaussianOrder { Centres, Pixels };

struct GaussianOptions {
  int threads = 0;  ///< 0: all cores. Never changes the result.
  Progress progress = {};
  GaussianOrder order = GaussianOrder::Centres;
  /// Opacity is not cut to kMostAlpha before it meets the kernel but after, as Kerbl et al. do: `projected` must then
  /// hold opacities that are not cut.
  bool cap_samples = false;
  std::uint64_t* samples = nullptr;  ///< gets how many were composited
};

/// RGBA, premultiplied, linear in what the file's colours are; A is the opacity. `projected` from project_all().
Image render_gaussians(const scene::GaussianScene& scene, const std::vector<scene::ProjectedGaussian>& projected,
                       const GaussianOptions& options = {});

}  // namespace fastsplat::golden
