// The voxels as densities, for classification after reconstruction.
#pragma once

#include <cstddef>
#include <vector>

#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

struct DensityField {
  /// What lies outside the volume, and what the splats are counted from: the volume's minimum.
  double base = 0.0;
  /// `extinction` is value - base, > 0; no emission.
  std::vector<scene::Splat> splats;
  std::size_t skipped = 0;  ///< voxels above the base that cannot matter
};

/// All voxels that can affect a pixel: the voxels above the base, except in clear bricks. Around a clear brick, as far
/// as any pixel's density and gradient reaches, the reconstructed values stay within [base, (1+ripple) * largest], and
/// the transfer function is clear there. Leaving these out changes no bit. `skip` false keeps them.
DensityField collect_densities(const scene::Scene& scene, bool skip = true);

/// Bound on how far the sum of kernels on a unit lattice can exceed its mean, along a ray that leans by `tilt`
/// (tangent) from the view axis. It is theta^3 / (share of the Gaussian inside the support), with theta = sum over n of
/// exp(-(pi n s)^2 / a) and s the least singular value of the shear.
double ripple_bound(const scene::Kernel& kernel, double tilt);

}  // namespace fastsplat::golden
