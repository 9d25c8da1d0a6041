// SPDX-License-Identifier: Apache-2.0
// X-ray: the line integral of emission (RGB) and of extinction (A), times the exposure. Exact for splatting, since the
// integral of a sum of kernels is the sum of their footprints. Needs neither order nor compositing.
#include "golden/render.hpp"
#include "golden/sheet_sweep.hpp"
#include "scene/kernel_growth.hpp"

namespace fastsplat::golden {

Image xray(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options) {
  const auto add = [](std::span<Sums> pixels, std::span<const Sums> sheet) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      for (int c = 0; c < 4; ++c) pixels[i][c] += sheet[i][c];
    }
  };
  const auto expose = [&scene](const Sums& pixel, float* rgba) {
    for (int c = 0; c < 4; ++c) rgba[c] = static_cast<float>(scene.xray_scale * pixel[c]);
  };
  const KernelSlices slices(scene.kernel, scene::sheet_plan(scene, scene::Method::XRay).slabs,
                            scene::largest_growth(scene));
  return sweep_sheets(scene, splats, options, slices, {.initial = {}, .take = add, .store = expose});
}

}  // namespace fastsplat::golden
