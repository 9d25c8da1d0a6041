// The floating-point reference: one technique per file, formulas as in the papers. Double inside, float out.
#pragma once

#include <cstdint>
#include <optional>

#include "base/image.hpp"
#include "base/progress.hpp"
#include "golden/culling_report.hpp"
#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

/// What a frame took.
struct RenderReport {
  double traversal_seconds = 0.0;       ///< classifying and shading the voxels
  double splatting_seconds = 0.0;       ///< all else: sorting, culling, splatting, compositing
  std::optional<std::uint64_t> splats;  ///< classified voxels that are not empty, where the technique collects them
  std::optional<CullingReport> culling;
  /// Of sheets in bands of rows, and westover: footprints, one per band that they reach into, and how many of them were
  /// not drawn, since every pixel that they reach was settled.
  std::uint64_t footprints = 0, hidden_footprints = 0;
};

struct RenderOptions {
  int threads = 0;  ///< 0: all cores. Never changes the result.
  Progress progress;
  RenderReport* report = nullptr;  ///< filled when given
  bool plain = false;              ///< as the formulas say it: nothing left out, no vectors. Never changes the result.
};

/// Renders scene.description.method. RGBA, premultiplied, linear; A is the opacity (X-ray: the exposed line integral of
/// extinction, not clamped). docs/golden.md defines each technique. Progress counts bands of image rows, or sheets.
Image render(const scene::Scene& scene, const RenderOptions& options = {});

// The techniques, each in its own file; scene.description.method is not read. All but the ray caster take the splats of
// the scene in traversal order, so that tests can permute them; only westover's picture depends on that order.
Image ray_cast(const scene::Scene& scene, const RenderOptions& options);
Image xray(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
Image westover(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
Image axis_aligned(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
Image image_aligned(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
/// Image-aligned, but the voxels' densities are splatted and classified at every pixel; with textures and bumps.
Image post_classified(const scene::Scene& scene, const RenderOptions& options);

}  // namespace fastsplat::golden
