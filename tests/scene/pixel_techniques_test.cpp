// What goes together: each refusal by its key, in one line with a way out.
#include "scene/pixel_techniques.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::HasSubstr;

SceneDescription perspective() {
  SceneDescription d;
  d.volume = "point:9";
  d.width = d.height = 16;
  d.camera.projection = Projection::Perspective;
  d.shading = 1;
  return d;
}

TEST(PixelTechniques, RefusedCombinationsSayWhy) {
  struct Case {
    const char* expected;
    void (*change)(SceneDescription&);
  };
  const Case cases[] = {
      {"classify.order: needs the pixels of image-aligned sheets, not method xray; use --method image_aligned",
       [](SceneDescription& d) { d.classify = ClassifyOrder::Post, d.method = Method::XRay; }},
      {"texture.where: needs the pixels of image-aligned sheets, not method axis_aligned; use --method image_aligned, "
       "or "
       "--texture-where voxel",
       [](SceneDescription& d) { d.texture.kind = SolidKind::Wood, d.method = Method::AxisAligned; }},
      {"texture.where: densities have no colour",
       [](SceneDescription& d) {
         d.classify = ClassifyOrder::Post, d.texture.kind = SolidKind::Wood, d.texture.where = TextureWhere::Voxel;
       }},
      {"classify.order: motion and lens on splats",
       [](SceneDescription& d) { d.classify = ClassifyOrder::Post, d.motion.orbit = 1.0; }},
      {"classify.order: motion and lens on splats",
       [](SceneDescription& d) { d.classify = ClassifyOrder::Post, d.lens.depth_of_field = DepthOfField::Splats; }},
      {"classify.gradients: gradient splats",
       [](SceneDescription& d) {
         d.classify = ClassifyOrder::Post, d.gradients = GradientKind::Splats, d.footprint.antialias = true;
       }},
      {"lens.depth_of_field: sheets of one depth are image-aligned, not axis_aligned",
       [](SceneDescription& d) { d.lens.depth_of_field = DepthOfField::Sheets, d.method = Method::AxisAligned; }},
      {"classify.gradients: gradient splats",
       [](SceneDescription& d) {
         d.classify = ClassifyOrder::Post, d.gradients = GradientKind::Splats, d.footprint.texture.amplitude = 0.5;
       }},
      {"bump.kind: needs a normal at every pixel; add --classify post",
       [](SceneDescription& d) { d.bump.kind = SolidKind::Noise; }},
      {"bump.kind: bumps show in shading only",
       [](SceneDescription& d) { d.classify = ClassifyOrder::Post, d.bump.kind = SolidKind::Noise, d.shading = 0; }},
  };
  int refused = 0;
  for (const Case& wrong : cases) {
    SceneDescription d = perspective();
    wrong.change(d);
    try {
      build_scene(d);
      ADD_FAILURE() << "accepted: " << wrong.expected;
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      EXPECT_THAT(error.what(), HasSubstr(wrong.expected));
      ++refused;
    }
  }
  EXPECT_EQ(refused, 10);
}

TEST(PixelTechniques, WhatGoesTogetherIsTaken) {
  SceneDescription d = perspective();
  d.classify = ClassifyOrder::Post;
  d.footprint.antialias = true;
  d.texture.kind = SolidKind::Marble;
  d.bump.kind = SolidKind::Noise;
  d.lens.depth_of_field = DepthOfField::Sheets;
  EXPECT_NO_THROW(build_scene(d));
  for (const Method method : {Method::RayCast, Method::XRay, Method::Westover, Method::AxisAligned}) {
    SceneDescription voxels = perspective();
    voxels.method = method;
    voxels.texture = {SolidKind::Wood, TextureWhere::Voxel, 5.0, 1.0};
    EXPECT_NO_THROW(build_scene(voxels));
  }
}

TEST(PixelTechniques, TheFirstInUseIsNamed) {
  SceneDescription d;
  EXPECT_EQ(pixel_technique_in_use(d), "");
  d.texture = {SolidKind::Wood, TextureWhere::Voxel, 5.0, 1.0};
  EXPECT_EQ(pixel_technique_in_use(d), "");
  d.bump.kind = SolidKind::Noise;
  EXPECT_EQ(pixel_technique_in_use(d), "bump.kind");
  d.texture.where = TextureWhere::Pixel;
  EXPECT_EQ(pixel_technique_in_use(d), "texture.where");
  d.classify = ClassifyOrder::Post;
  EXPECT_EQ(pixel_technique_in_use(d), "classify.order");
}

}  // namespace
}  // namespace fastsplat::scene
