// SPDX-License-Identifier: Apache-2.0
// The floating-point reference: one technique per file, formulas as in the papers. Computes in double, returns float.
#pragma once

#include <cstdint>
#include <optional>

#include "base/image.hpp"
#include "base/progress.hpp"
#include "golden/culling_report.hpp"
#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

/// Times and counts of one frame.
struct RenderReport {
  double traversal_seconds = 0.0;       ///< classifying and shading the voxels
  double splatting_seconds = 0.0;       ///< the rest: sorting, culling, splatting, compositing
  std::optional<std::uint64_t> splats;  ///< classified voxels that are not empty, if the technique collects them
  std::optional<CullingReport> culling;
  /// Number of footprints, one per band that they reach, and of those not drawn because all pixels they reach were
  /// settled. Only for westover and for sheets in bands of rows.
  std::uint64_t footprints = 0, hidden_footprints = 0;
};

struct RenderOptions {
  int threads = 0;  ///< 0: all cores. Never changes the result.
  Progress progress;
  RenderReport* report = nullptr;  ///< filled unless null
  bool plain = false;              ///< direct formulas, nothing left out, no vectors. Never changes the result.
};

/// Renders scene.description.method. RGBA, premultiplied, linear; A is the opacity (X-ray: the exposed line integral of
/// extinction, not clamped). docs/golden.md defines each technique. Progress counts bands of image rows, or sheets.
Image render(const scene::Scene& scene, const RenderOptions& options = {});

// The techniques, each in its own file, ignore scene.description.method. Most take the scene's splats in traversal
// order as an argument, so that tests can permute them; only westover's picture depends on that order.
Image ray_cast(const scene::Scene& scene, const RenderOptions& options);
Image xray(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
Image westover(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
Image axis_aligned(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
Image image_aligned(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
/// Image-aligned, but densities are splatted and classified at every pixel; with textures and bumps.
Image post_classified(const scene::Scene& scene, const RenderOptions& options);

}  // namespace fastsplat::golden
