// X-ray: the line integral of emission (RGB) and of extinction (A), times the exposure. Exact for splatting, since the
// integral of a sum of kernels is the sum of their footprints; no order, no compositing.
#include "golden/render.hpp"
#include "golden/sheet_sweep.hpp"
#include "golden/splat/antialias.hpp"

namespace fastsplat::golden {

namespace {

/// The scene's depth range in as many slabs as the description asks for; the sum must not depend on it.
scene::SlabGrid xray_grid(const scene::Scene& scene) {
  scene::SlabGrid grid = scene::slab_grid(scene);
  const int sheets = scene.description.xray_sheets;
  grid.width *= static_cast<double>(grid.count) / sheets;
  grid.count = sheets;
  return grid;
}

}  // namespace

Image xray(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options) {
  const auto add = [](std::span<Sums> pixels, std::span<const Sums> sheet) {
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      for (int c = 0; c < 4; ++c) pixels[i][c] += sheet[i][c];
    }
  };
  const auto expose = [&scene](const Sums& pixel, float* rgba) {
    for (int c = 0; c < 4; ++c) rgba[c] = static_cast<float>(scene.xray_scale * pixel[c]);
  };
  return sweep_sheets(scene, splats, options, KernelSlices(scene.kernel, xray_grid(scene), largest_growth(scene)),
                      Sums{}, add, expose);
}

}  // namespace fastsplat::golden
