#include "scene/pixel_techniques.hpp"

#include <fmt/format.h>

#include "base/error.hpp"

namespace fastsplat::scene {
namespace {

[[noreturn]] void refuse(const std::string& where, const std::string& what, const std::string& fix) {
  throw_usage({.where = where, .what = what, .expected = {}, .got = {}, .fix = fix});
}

/// What cannot be combined with classification after splatting.
void check_post(const SceneDescription& d) {
  if (d.texture.kind != SolidKind::None && d.texture.where == TextureWhere::Voxel) {
    refuse("texture.where", "densities have no colour to tint before they are classified", "use --texture-where pixel");
  }
  if (!d.motion.none() || d.lens.depth_of_field == DepthOfField::Splats) {
    refuse("classify.order", "motion and lens on splats blur colours, and densities have none yet",
           "use --classify pre");
  }
  const bool plain =
      d.footprint.shape == FootprintShape::Circle && !d.footprint.antialias && !(d.footprint.texture.amplitude > 0.0);
  if (d.gradients == GradientKind::Splats && !plain) {
    refuse("classify.gradients", "gradient splats are derivatives of plain circular footprints",
           "use --gradients central, or --footprint circle without --antialias and --splat-texture");
  }
}

}  // namespace

std::string pixel_technique_in_use(const SceneDescription& d) {
  if (d.classify == ClassifyOrder::Post) return "classify.order";
  if (d.texture.kind != SolidKind::None && d.texture.where == TextureWhere::Pixel) return "texture.where";
  if (d.bump.kind != SolidKind::None) return "bump.kind";
  return {};
}

void check_pixel_techniques(const SceneDescription& d, const Shading& shading) {
  const std::string key = pixel_technique_in_use(d);
  if (!key.empty() && d.method != Method::ImageAligned) {
    refuse(
        key, fmt::format("needs the pixels of image-aligned sheets, not method {}", to_string(d.method)),
        key == "texture.where" ? "use --method image_aligned, or --texture-where voxel" : "use --method image_aligned");
  }
  if (d.lens.depth_of_field == DepthOfField::Sheets && d.method != Method::ImageAligned) {
    refuse("lens.depth_of_field", fmt::format("sheets of one depth are image-aligned, not {}", to_string(d.method)),
           "use --method image_aligned, or --depth-of-field splats");
  }
  if (d.classify == ClassifyOrder::Post) check_post(d);
  if (d.bump.kind == SolidKind::None) return;
  if (d.classify == ClassifyOrder::Pre) refuse("bump.kind", "needs a normal at every pixel", "add --classify post");
  if (!shading.on) refuse("bump.kind", "bumps show in shading only, which is off", "add --shading on");
}

}  // namespace fastsplat::scene
