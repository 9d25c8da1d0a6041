// Image-aligned sheets (Mueller and Crawfis 1998): slabs parallel to the image cut each splat's kernel into slices, and
// all the material between two planes is added before compositing. Nothing depends on the volume's axes, so nothing
// pops. What looks at pixels of whole sheets is put together here.
#include "golden/bump_mapping.hpp"
#include "golden/density_splats.hpp"
#include "golden/frame_sweep.hpp"
#include "golden/gradient_splats.hpp"
#include "golden/post_classified.hpp"
#include "golden/render.hpp"
#include "golden/sheet_sweep.hpp"
#include "golden/solid_textures.hpp"

namespace fastsplat::golden {
namespace {

bool textured_pixels(const scene::Scene& scene) {
  const scene::Texture& texture = scene.description.texture;
  return texture.kind != scene::SolidKind::None && texture.where == scene::TextureWhere::Pixel;
}

}  // namespace

Image image_aligned(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options) {
  const KernelSlices slices = image_slabs(scene);
  if (!textured_pixels(scene)) return composite_sheets(scene, splats, options, slices);
  const SheetGeometry geometry(scene);
  const TextureOfSheet texture(scene.description.texture, geometry);
  return sweep_frame(scene, splats, options, slices, {.sheet_stages = {&texture}});
}

Image post_classified(const scene::Scene& scene, const RenderOptions& options) {
  const SheetGeometry geometry(scene);
  const DensityField field = collect_densities(scene);
  std::vector<const PixelStage*> steps;
  const TextureOfPixel texture(scene.description.texture);
  if (textured_pixels(scene)) steps.push_back(&texture);
  const BumpMapping bumps(scene.description.bump);
  if (scene.description.bump.kind != scene::SolidKind::None) steps.push_back(&bumps);

  const PostClassified classified(scene, geometry, field.base, steps);
  const GradientSplats gradients(scene.kernel, geometry);
  const bool splatted = scene.shading.on && scene.description.gradients == scene::GradientKind::Splats;
  return sweep_frame(scene, field.splats, options, image_slabs(scene),
                     {.deposit = splatted ? &gradients : nullptr, .sheet_stages = {&classified}});
}

}  // namespace fastsplat::golden
