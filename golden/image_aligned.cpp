// SPDX-License-Identifier: Apache-2.0
// Image-aligned sheets (Mueller and Crawfis 1998): slabs parallel to the image cut each splat's kernel into slices, and
// all material between two planes is added before compositing. Nothing depends on the volume's axes, so nothing pops.
// This file also assembles the stages that read pixels of whole sheets.
#include <optional>

#include "golden/bump_mapping.hpp"
#include "golden/density_splats.hpp"
#include "golden/depth_of_field_sheets.hpp"
#include "golden/gradient_splats.hpp"
#include "golden/occlusion_culling.hpp"
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

/// Depth of field, if the scene computes it from sheets.
std::optional<DepthOfFieldSheets> lens_on_sheets(const scene::Scene& scene, const SheetGeometry& geometry) {
  const scene::Lens& lens = scene.description.lens;
  if (lens.depth_of_field != scene::DepthOfField::Sheets) return std::nullopt;
  return DepthOfFieldSheets(lens, geometry);
}

}  // namespace

Image image_aligned(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const RenderOptions& options) {
  const SheetGeometry geometry(scene);
  const TextureOfSheet texture(scene.description.texture, geometry);
  const std::optional<DepthOfFieldSheets> lens = lens_on_sheets(scene, geometry);
  FrameStages stages;
  if (textured_pixels(scene)) stages.sheet_stages.push_back(&texture);
  if (lens) stages.filter = &*lens;
  return composite_visible(scene, splats, options, image_slabs(scene), stages);
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
  const std::optional<DepthOfFieldSheets> lens = lens_on_sheets(scene, geometry);
  return composite_visible(
      scene, field.splats, options, image_slabs(scene),
      {.deposit = splatted ? &gradients : nullptr, .sheet_stages = {&classified}, .filter = lens ? &*lens : nullptr});
}

}  // namespace fastsplat::golden
