// SPDX-License-Identifier: Apache-2.0
#include "scene/capability_table.hpp"

#include <array>

namespace fastsplat::scene {
namespace {

using D = SceneDescription;

constexpr Methods kSplatting = kAllMethods & ~only(Method::RayCast);
constexpr Methods kImage = only(Method::ImageAligned);
constexpr Methods kComposited = kImage | only(Method::AxisAligned);

constexpr const char* kNoFootprints = "the ray caster draws no footprints";
constexpr const char* kSplattingFix = "choose a splatting --method, or turn it off";
constexpr const char* kNoPixels = "needs the pixels of image-aligned sheets, which method {} lacks";
constexpr const char* kImageFix = "use --method image_aligned";
constexpr const char* kNoSheets = "{} does not composite sheets, so no pixel becomes opaque early";
constexpr const char* kSheetsFix = "use --method image_aligned or axis_aligned, or turn it off";

constexpr Link kLensNeeds[] = {
    {Technique::Perspective, "depth of field needs a perspective camera; an orthographic one has everything in focus",
     "add --perspective, or turn depth of field off"}};

constexpr const char* kNoColours =
    "motion and lens blur the colours of splats; with --classify post splats carry densities";
constexpr Link kPostExcludes[] = {{Technique::Translation, kNoColours, "use --classify pre"},
                                  {Technique::Orbit, kNoColours, "use --classify pre"},
                                  {Technique::LensOnSplats, kNoColours, "use --classify pre"}};

constexpr const char* kNotPlain = "gradient splats are derivatives of plain circular footprints";
constexpr const char* kPlainFix =
    "use --gradients central, or --footprint circle without --antialias and --splat-texture";
constexpr Link kGradientNeeds[] = {{Technique::Shading, "gradients are used only by shading, which is off"}};
constexpr Link kGradientExcludes[] = {{Technique::Ellipse, kNotPlain, kPlainFix},
                                      {Technique::Antialias, kNotPlain, kPlainFix},
                                      {Technique::SplatTexture, kNotPlain, kPlainFix}};

constexpr Link kVoxelTextureExcludes[] = {{Technique::PostClassified,
                                           "a texture tints colours; with --classify post voxels carry densities",
                                           "use --texture-where pixel"}};

constexpr Link kBumpNeeds[] = {{Technique::PostClassified, "needs a normal in every pixel"},
                               {Technique::Shading, "bumps are visible only with shading, which is off"}};

constexpr Link kCullingNeeds[] = {{Technique::Freezing, "no pixel becomes opaque while culling.freeze is 0"}};

constexpr const char* kUnknownReach = "culling in blocks does not support {}";
constexpr Link kBlocksExcludes[] = {
    {Technique::Ellipse, kUnknownReach, "use --culling splats"},
    {Technique::Antialias, kUnknownReach, "use --culling splats"},
    {Technique::SplatTexture, kUnknownReach, "use --culling splats"},
    {Technique::Translation, kUnknownReach, "use --culling splats"},
    {Technique::Orbit, kUnknownReach, "use --culling splats"},
    {Technique::Lens, kUnknownReach, "use --culling splats"},
};

constexpr std::array kRows{
    TechniqueRow{.technique = Technique::Ellipse,
                 .key = "footprint.shape",
                 .name = "ellipses",
                 .turn_on = "add --footprint ellipse",
                 .on = [](const D& d) { return d.footprint.shape != FootprintShape::Circle; },
                 .methods = kSplatting,
                 .no_method = kNoFootprints,
                 .method_fix = kSplattingFix,
                 .feature = Feature::Footprints},
    TechniqueRow{.technique = Technique::Antialias,
                 .key = "footprint.antialias",
                 .name = "anti-aliasing",
                 .turn_on = "add --antialias on",
                 .on = [](const D& d) { return d.footprint.antialias; },
                 .methods = kSplatting,
                 .no_method = kNoFootprints,
                 .method_fix = kSplattingFix,
                 .feature = Feature::Footprints},
    TechniqueRow{.technique = Technique::SplatTexture,
                 .key = "splat_texture.amplitude",
                 .name = "textured splats",
                 .turn_on = "add --splat-texture 1",
                 .on = [](const D& d) { return d.footprint.texture.amplitude > 0.0; },
                 .methods = kSplatting,
                 .no_method = kNoFootprints,
                 .method_fix = kSplattingFix,
                 .feature = Feature::Details},
    TechniqueRow{.technique = Technique::Translation,
                 .key = "motion.translate",
                 .name = "motion of the volume",
                 .turn_on = "add --motion-translate 5,0,0",
                 .on = [](const D& d) { return d.motion.translate != glm::dvec3(0.0); },
                 .methods = kSplatting,
                 .no_method = kNoFootprints,
                 .method_fix = kSplattingFix,
                 .feature = Feature::Footprints},
    TechniqueRow{.technique = Technique::Orbit,
                 .key = "motion.orbit",
                 .name = "motion of the camera",
                 .turn_on = "add --motion-orbit 5",
                 .on = [](const D& d) { return d.motion.orbit != 0.0; },
                 .methods = kSplatting,
                 .no_method = kNoFootprints,
                 .method_fix = kSplattingFix,
                 .feature = Feature::Footprints},
    TechniqueRow{.technique = Technique::Lens,
                 .key = "lens.depth_of_field",
                 .name = "depth of field",
                 .turn_on = "add --depth-of-field splats",
                 .on = [](const D& d) { return d.lens.depth_of_field != DepthOfField::Off; },
                 .methods = kSplatting,
                 .no_method = kNoFootprints,
                 .method_fix = kSplattingFix,
                 .feature = Feature::Footprints,
                 .needs = kLensNeeds},
    TechniqueRow{.technique = Technique::LensOnSplats,
                 .key = "lens.depth_of_field",
                 .name = "depth of field on splats",
                 .turn_on = "add --depth-of-field splats",
                 .on = [](const D& d) { return d.lens.depth_of_field == DepthOfField::Splats; },
                 .feature = Feature::Footprints},
    TechniqueRow{.technique = Technique::LensOnSheets,
                 .key = "lens.depth_of_field",
                 .name = "depth of field on sheets",
                 .turn_on = "add --depth-of-field sheets",
                 .on = [](const D& d) { return d.lens.depth_of_field == DepthOfField::Sheets; },
                 .methods = kImage,
                 .no_method = "sheets of one depth are image-aligned, not {}",
                 .method_fix = "use --method image_aligned, or --depth-of-field splats",
                 .feature = Feature::Pixels},
    TechniqueRow{.technique = Technique::PostClassified,
                 .key = "classify.order",
                 .name = "classification after splatting",
                 .turn_on = "add --classify post",
                 .on = [](const D& d) { return d.classify == ClassifyOrder::Post; },
                 .methods = kImage,
                 .no_method = kNoPixels,
                 .method_fix = kImageFix,
                 .feature = Feature::Densities,
                 .excludes = kPostExcludes},
    TechniqueRow{
        .technique = Technique::GradientSplats,
        .key = "classify.gradients",
        .name = "gradient splats",
        .turn_on = "add --gradients splats",
        .on = [](const D& d) { return d.classify == ClassifyOrder::Post && d.gradients == GradientKind::Splats; },
        .methods = kImage,
        .no_method = kNoPixels,
        .method_fix = kImageFix,
        .feature = Feature::Pixels,
        .needs = kGradientNeeds,
        .excludes = kGradientExcludes},
    TechniqueRow{.technique = Technique::SolidTexture,
                 .key = "texture.kind",
                 .name = "a texture",
                 .turn_on = "add --texture wood",
                 .on = [](const D& d) { return d.texture.kind != SolidKind::None; }},
    TechniqueRow{
        .technique = Technique::VoxelTexture,
        .key = "texture.where",
        .name = "a texture at voxels",
        .turn_on = "add --texture-where voxel",
        .on = [](const D& d) { return d.texture.kind != SolidKind::None && d.texture.where == TextureWhere::Voxel; },
        .excludes = kVoxelTextureExcludes},
    TechniqueRow{
        .technique = Technique::PixelTexture,
        .key = "texture.where",
        .name = "a texture at pixels",
        .turn_on = "add --texture-where pixel",
        .on = [](const D& d) { return d.texture.kind != SolidKind::None && d.texture.where == TextureWhere::Pixel; },
        .methods = kImage,
        .no_method = kNoPixels,
        .method_fix = "use --method image_aligned, or --texture-where voxel",
        .feature = Feature::Patterns},
    TechniqueRow{.technique = Technique::Bumps,
                 .key = "bump.kind",
                 .name = "bumps",
                 .turn_on = "add --bump noise",
                 .on = [](const D& d) { return d.bump.kind != SolidKind::None; },
                 .methods = kImage,
                 .no_method = kNoPixels,
                 .method_fix = kImageFix,
                 .feature = Feature::Patterns,
                 .needs = kBumpNeeds},
    TechniqueRow{.technique = Technique::Culling,
                 .key = "culling.mode",
                 .name = "culling",
                 .turn_on = "add --culling blocks",
                 .on = [](const D& d) { return d.culling.mode != CullingMode::Off; },
                 .methods = kComposited,
                 .no_method = kNoSheets,
                 .method_fix = kSheetsFix,
                 .feature = Feature::Freezing,
                 .needs = kCullingNeeds},
    TechniqueRow{.technique = Technique::Blocks,
                 .key = "culling.mode",
                 .name = "culling in blocks",
                 .turn_on = "use --culling blocks",
                 .on = [](const D& d) { return d.culling.mode == CullingMode::Blocks; },
                 .methods = kComposited,
                 .no_method = kNoSheets,
                 .method_fix = kSheetsFix,
                 .feature = Feature::Freezing,
                 .excludes = kBlocksExcludes},
    TechniqueRow{.technique = Technique::Freezing,
                 .key = "culling.freeze",
                 .name = "early termination",
                 .turn_on = "add --freeze 0.001 to terminate pixels of less transmittance",
                 .on = [](const D& d) { return d.culling.freeze > 0.0; },
                 .methods = kComposited,
                 .no_method = kNoSheets,
                 .method_fix = kSheetsFix,
                 .feature = Feature::Freezing},
    TechniqueRow{.technique = Technique::AverageTest,
                 .key = "culling.test",
                 .name = "the average test",
                 .turn_on = "add --culling-test average",
                 .on = [](const D& d) { return d.culling.test == VisibilityTest::Average; }},
    TechniqueRow{.technique = Technique::Perspective,
                 .key = "camera.projection",
                 .name = "a perspective camera",
                 .turn_on = "add --perspective",
                 .on = [](const D& d) { return d.camera.projection == Projection::Perspective; }},
    TechniqueRow{.technique = Technique::Shading,
                 .key = "shading",
                 .name = "shading",
                 .turn_on = "add --shading on",
                 .on = [](const D& d) { return d.shading != 0; }},
    TechniqueRow{.technique = Technique::Aperture,
                 .key = "lens.aperture",
                 .name = "an aperture (a pinhole has everything in focus)",
                 .turn_on = "add --aperture 5",
                 .on = [](const D& d) { return d.lens.aperture > 0.0; }},
    TechniqueRow{.technique = Technique::Exposure,
                 .key = "xray.exposure",
                 .name = "a fixed exposure in X-rays (the automatic one cancels it)",
                 .turn_on = "add --xray-exposure 0.05",
                 .on = [](const D& d) { return d.method != Method::XRay || d.xray_exposure > 0.0; }},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < kRows.size(); ++i) {
    if (static_cast<std::size_t>(kRows[i].technique) != i) return false;
  }
  return true;
}
static_assert(in_order() && kRows.back().technique == Technique::Exposure);

}  // namespace

std::span<const TechniqueRow> technique_rows() { return kRows; }
const TechniqueRow& row_of(Technique technique) { return kRows[static_cast<std::size_t>(technique)]; }

}  // namespace fastsplat::scene
