// The floating-point reference: one technique per file, formulas as in the papers. Double inside, float out.
#pragma once

#include "base/progress.hpp"
#include "scene/image.hpp"
#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

struct RenderOptions {
  int threads = 0;  ///< 0: all cores. Never changes the result.
  Progress progress;
};

/// Renders scene.description.method. RGBA, premultiplied, linear.
Image render(const scene::Scene& scene, const RenderOptions& options = {});

// The techniques, each in its own file. All but the ray caster take the splats of the scene in traversal order, so that
// tests can permute them.
Image ray_cast(const scene::Scene& scene, const RenderOptions& options);
Image xray(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
Image westover(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
Image axis_aligned(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);
Image image_aligned(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options);

}  // namespace fastsplat::golden
