// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdio>

#include "scene/scene.hpp"
#include "scene/volume/volume_file.hpp"
#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::HasSubstr;

class SceneFile : public TemporaryFolder {
 protected:
  SceneDescription load(const std::string& text) const { return load_scene_file(write("scene.toml", text)); }
  std::string refused(const std::string& text) const {
    const std::string message = refusal([&] { load(text); });
    EXPECT_THAT(message, HasSubstr("scene.toml:"));
    return message;
  }
};

/// No key at its default, only keys that the method reads.
SceneDescription unusual(Method method) {
  SceneDescription d;
  d.volume = "marschner-lobb:17";
  d.transfer_function = "bone";
  d.kernel = "";
  d.kernel_a = 1.1;
  d.kernel_radius = 2.5;
  d.camera = {
      .projection = Projection::Perspective, .azimuth = 0.1, .elevation = -77.25, .roll = 1e-5, .zoom = 2, .fov = 45.5};
  d.width = 333;
  d.height = 77;
  d.method = method;
  if (method == Method::ImageAligned) {
    d.slab_width = 1.0 / 3.0;
    d.slab_opacity = SlabOpacity::Additive;
  } else if (method == Method::RayCast) {
    d.ray_end = 1e-6;
  } else {
    d.xray_sheets = 9;
    d.xray_exposure = 0.7;
  }
  d.shading = 1;
  d.opacity_scale = 1e-3;
  return d;
}

TEST_F(SceneFile, RoundTripsEveryField) {
  for (const SceneDescription& d :
       {SceneDescription{}, unusual(Method::ImageAligned), unusual(Method::XRay), unusual(Method::RayCast)}) {
    const std::string text = to_toml(d);
    const SceneDescription back = load(text);
    EXPECT_EQ(to_toml(back), text);
    EXPECT_EQ(back.volume, d.volume);
    EXPECT_EQ(back.transfer_function, d.transfer_function);
    EXPECT_EQ(back.kernel, d.kernel);
    if (d.kernel.empty()) {
      EXPECT_EQ(back.kernel_a, d.kernel_a);
      EXPECT_EQ(back.kernel_radius, d.kernel_radius);
    }
    EXPECT_EQ(back.camera.projection, d.camera.projection);
    EXPECT_EQ(back.camera.azimuth, d.camera.azimuth);
    EXPECT_EQ(back.camera.elevation, d.camera.elevation);
    EXPECT_EQ(back.camera.roll, d.camera.roll);
    EXPECT_EQ(back.camera.zoom, d.camera.zoom);
    EXPECT_EQ(back.camera.fov, d.camera.fov);
    EXPECT_EQ(back.width, d.width);
    EXPECT_EQ(back.height, d.height);
    EXPECT_EQ(back.method, d.method);
    EXPECT_EQ(back.slab_width, d.slab_width);
    EXPECT_EQ(back.slab_opacity, d.slab_opacity);
    EXPECT_EQ(back.xray_sheets, d.xray_sheets);
    EXPECT_EQ(back.xray_exposure, d.xray_exposure);
    EXPECT_EQ(back.ray_end, d.ray_end);
    EXPECT_EQ(back.shading, d.shading);
    EXPECT_EQ(back.opacity_scale, d.opacity_scale);
  }
}

TEST_F(SceneFile, AbsentKeysKeepTheirDefaults) {
  const SceneDescription d = load("volume = \"point\"\n");
  SceneDescription expected;
  expected.volume = "point";
  EXPECT_EQ(to_toml(d), to_toml(expected));
  EXPECT_EQ(load("[image]\nsize = 64\n").width, 64);
  EXPECT_EQ(load("[image]\nsize = 64\n").height, 64);
  EXPECT_EQ(load("[kernel]\nradius = 3\n").kernel, "");
}

TEST_F(SceneFile, PathsAreRelativeToTheFile) {
  const SceneDescription d = load("volume = \"data/v.nrrd\"\ntransfer_function = \"tf.toml\"\n");
  EXPECT_EQ(d.volume, (folder_ / "data/v.nrrd").string());
  EXPECT_EQ(d.transfer_function, (folder_ / "tf.toml").string());
  EXPECT_EQ(load("volume = \"/abs/v.nrrd\"\n").volume, "/abs/v.nrrd");
  EXPECT_EQ(load("volume = \"ch2bet\"\n").volume, "ch2bet");
  SceneDescription odd;
  odd.volume = "/a \"b\"\\c/\x01.nrrd";
  EXPECT_EQ(load(to_toml(odd)).volume, odd.volume);
}

TEST_F(SceneFile, RefusesWithLineColumnAndHint) {
  EXPECT_THAT(refused("volum = \"shells\"\n"),
              HasSubstr("scene.toml:1:1: unknown key 'volum'; did you mean 'volume'?"));
  EXPECT_THAT(refused("\n[camera]\nazimut = 3\n"),
              HasSubstr("scene.toml:3:1: unknown key 'azimut' in [camera]; did you mean 'azimuth'?"));
  EXPECT_THAT(refused("[camra]\n"), HasSubstr("did you mean 'camera'?"));
  EXPECT_THAT(
      refused("method = \"image-aligned\"\n"),
      HasSubstr("scene.toml:1:10: method: unknown name (got \"image-aligned\"); did you mean 'image_aligned'?"));
  EXPECT_THAT(refused("[camera]\nzoom = 0\n"), HasSubstr("camera.zoom: value out of range"));
  EXPECT_THAT(refused("[camera]\nazimuth = \"3\"\n"), HasSubstr("wrong type"));
  EXPECT_THAT(refused("[image]\nwidth = 16385\n"), HasSubstr("expected a whole number in 1..16384, got 16385"));
  EXPECT_THAT(refused("[image]\nwidth = 0.5\n"), HasSubstr("wrong type"));
  EXPECT_THAT(refused("[image]\nsize = 5\nwidth = 6\n"), HasSubstr("either size, or width and height"));
  EXPECT_THAT(refused("[kernel]\nname = \"gauss2\"\na = 2\n"), HasSubstr("both a name and a shape"));
  EXPECT_THAT(refused("[kernel]\nname = \"gaus2\"\n"), HasSubstr("did you mean 'gauss2'?"));
  EXPECT_THAT(refused("transfer_function = \"bon\"\n"), HasSubstr("did you mean 'bone'?"));
  EXPECT_THAT(refused("camera = 3\n"), HasSubstr("a table"));
  EXPECT_THAT(refused("volume = \"\"\n"), HasSubstr("empty"));
  EXPECT_THAT(refused("volume = 3\n"), HasSubstr("text in quotes"));
  EXPECT_THAT(refused("volume = \"a\"\nvolume = \"b\"\n"), HasSubstr("not valid TOML"));
  EXPECT_THAT(refused("[slabs]\nwidth = inf\n"), HasSubstr("out of range"));
}

TEST_F(SceneFile, InvalidReferencesAreRefusedWithTheirPlace) {
  const auto refused_later = [&](const std::string& text) {
    const SceneDescription d = load(text);
    try {
      build_scene(d);
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(refused_later("[image]\nsize = 8\n\n"), "");
  EXPECT_THAT(refused_later("\nvolume = \"gone.nrrd\"\n"), HasSubstr("scene.toml:2:10: "));
  EXPECT_THAT(refused_later("volume = \"scene.toml\"\n"), HasSubstr("scene.toml:1:10: "));
  EXPECT_THAT(refused_later("volume = \"shells:0\"\n"), HasSubstr("scene.toml:1:10: "));
  EXPECT_THAT(refused_later("volume = \"shells:8\"\ntransfer_function = \"gone.toml\"\n"),
              HasSubstr("scene.toml:2:21: "));
}

TEST(BuildScene, ChoosesTheTransferFunctionByVolume) {
  for (const auto& [volume, preset] : {std::pair{"binary-cube:8", "binary"},
                                       {"point", "binary"},
                                       {"checkerboard-floor:8", "checker"},
                                       {"shells:8", "default"}}) {
    EXPECT_EQ(build_scene({.volume = volume}).transfer_function.name, preset);
  }
  EXPECT_TRUE(build_scene({.volume = "shells:8"}).shading.on);
  EXPECT_FALSE(build_scene({.volume = "shells:8", .shading = 0}).shading.on);
  EXPECT_TRUE(build_scene({.volume = "point", .shading = 1}).shading.on);
}

}  // namespace
}  // namespace fastsplat::scene
