// SPDX-License-Identifier: Apache-2.0
// Compatible settings: each refusal names its key, in one line with a fix; settings without effect; settings that a
// file may hold.
#include "scene/capability.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/scene_file.hpp"
#include "tests/scene/follow_fixes_testing.hpp"
#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

auto starts_idle(const std::string& name) {
  return AnyOf(StartsWith(name + " does not apply to "), StartsWith(name + " has no effect without "));
}

/// Every setting states where it has an effect.
template <class T>
concept MadeWithoutCapability = requires {
  T{"", "", "", "", "", "", Switch{nullptr}};
};
template <class T>
concept MadeWithCapability = requires {
  T{"", "", "", "", "", "", Switch{nullptr}, Capability::everywhere("on")};
};
static_assert(MadeWithCapability<Setting> && !MadeWithoutCapability<Setting>);

SceneDescription perspective() {
  SceneDescription d;
  d.volume = "point:9";
  d.width = d.height = 16;
  d.camera.projection = Projection::Perspective;
  d.shading = 1;
  return d;
}

TEST(Capability, RefusedCombinationsSayWhy) {
  struct Case {
    const char* expected;
    void (*change)(SceneDescription&);
  };
  const Case cases[] = {
      {"classify.order: needs the pixels of image-aligned sheets, which method xray lacks; use --method image_aligned",
       [](SceneDescription& d) { d.classify = ClassifyOrder::Post, d.method = Method::XRay; }},
      {"texture.where: needs the pixels of image-aligned sheets, which method axis_aligned lacks; use --method "
       "image_aligned, "
       "or "
       "--texture-where voxel",
       [](SceneDescription& d) { d.texture.kind = SolidKind::Wood, d.method = Method::AxisAligned; }},
      {"texture.where: a texture tints colours",
       [](SceneDescription& d) {
         d.classify = ClassifyOrder::Post, d.texture.kind = SolidKind::Wood, d.texture.where = TextureWhere::Voxel;
       }},
      {"classify.order: motion and lens blur",
       [](SceneDescription& d) { d.classify = ClassifyOrder::Post, d.motion.orbit = 1.0; }},
      {"classify.order: motion and lens blur",
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
      {"bump.kind: needs a normal in every pixel; add --classify post",
       [](SceneDescription& d) { d.bump.kind = SolidKind::Noise; }},
      {"bump.kind: bumps are visible only with shading",
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

TEST(Capability, CompatibleSettingsAreAccepted) {
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

TEST(Capability, AnEngineRefusesTheFirstThatItHasNot) {
  static constexpr Offers kNothing{"toy", only(Method::ImageAligned), 0u};
  SceneDescription d;
  const auto first = [&d] { return refusal(d, kNothing).value_or(ErrorParts{}).where; };
  EXPECT_EQ(first(), "");
  d.texture = {SolidKind::Wood, TextureWhere::Voxel, 5.0, 1.0};
  EXPECT_EQ(first(), "");
  d.method = Method::XRay;
  EXPECT_EQ(first(), "method");
  d.method = Method::ImageAligned;
  d.culling.freeze = 0.1;
  EXPECT_EQ(first(), "culling.freeze");
  d.culling.mode = CullingMode::Splats;
  EXPECT_EQ(first(), "culling.mode");
  d.texture.where = TextureWhere::Pixel;
  EXPECT_EQ(first(), "texture.where");
  d.classify = ClassifyOrder::Post;
  EXPECT_EQ(first(), "classify.order");
  d.classify = ClassifyOrder::Pre;
  d.motion.orbit = -1.0;
  EXPECT_EQ(first(), "motion.orbit");
  d.motion.translate.z = 1.0;
  EXPECT_EQ(first(), "motion.translate");
  d.footprint.texture.amplitude = 0.1;
  EXPECT_EQ(first(), "splat_texture.amplitude");
  d.footprint.antialias = true;
  EXPECT_EQ(first(), "footprint.antialias");
  d.footprint.shape = FootprintShape::Ellipse;
  EXPECT_EQ(first(), "footprint.shape");
  EXPECT_EQ(refusal(d, kNothing)->what, "the toy does not support this technique");
}

/// The message of a setting that was given at its probe.
std::string said_of(const std::string& flag, const SceneDescription& start) {
  SceneDescription d = start;
  const Setting& setting = setting_of(flag);
  apply(setting, setting.capability.probe, d);
  const auto refused = refusal(Given{&setting}, d);
  return refused ? one_line(*refused) : "";
}

TEST(Capability, SettingsWithoutEffectAreRefusedWithAFix) {
  struct Case {
    const char* flag;
    Method method;
    const char* said;
  };
  const char* const kSlabs = "which has no slabs; use --method image_aligned";
  const char* const kOpacity = "which gives sheets no opacity; use --method image_aligned, axis_aligned or westover";
  const char* const kXRay = "use --method xray";
  const Case cases[] = {
      {"--slab-width", Method::AxisAligned, kSlabs},
      {"--slab-width", Method::RayCast, kSlabs},
      {"--slab-width", Method::Westover, kSlabs},
      {"--slab-width", Method::XRay, kSlabs},
      {"--slab-opacity", Method::RayCast, kOpacity},
      {"--slab-opacity", Method::XRay, kOpacity},
      {"--xray-exposure", Method::RayCast, kXRay},
      {"--xray-exposure", Method::Westover, kXRay},
      {"--xray-exposure", Method::AxisAligned, kXRay},
      {"--xray-exposure", Method::ImageAligned, kXRay},
      {"--xray-sheets", Method::RayCast, kXRay},
      {"--xray-sheets", Method::Westover, kXRay},
      {"--xray-sheets", Method::AxisAligned, kXRay},
      {"--xray-sheets", Method::ImageAligned, kXRay},
      {"--opacity-scale", Method::XRay, "without a fixed exposure in X-rays (the automatic one cancels it); add "},
      {"--fov", Method::ImageAligned, "without a perspective camera; add --perspective"},
      {"--footprint", Method::ImageAligned, "without a perspective camera; add --perspective"},
      {"--footprint", Method::XRay, "without a perspective camera; add --perspective"},
      {"--splat-phases", Method::ImageAligned, "without textured splats; add --splat-texture 1"},
      {"--splat-frame", Method::ImageAligned, "without textured splats; add --splat-texture 1"},
      {"--splat-scale", Method::ImageAligned, "without textured splats; add --splat-texture 1"},
      {"--depth-of-field", Method::ImageAligned, "without an aperture (a pinhole has everything in focus); add "},
      {"--aperture", Method::ImageAligned, "without depth of field; add --depth-of-field splats"},
      {"--focus", Method::ImageAligned, "without depth of field; add --depth-of-field splats"},
      {"--gradients", Method::ImageAligned, "without classification after splatting; add --classify post"},
      {"--texture-where", Method::ImageAligned, "without a texture; add --texture wood"},
      {"--texture-scale", Method::ImageAligned, "without a texture; add --texture wood"},
      {"--texture-amplitude", Method::ImageAligned, "without a texture; add --texture wood"},
      {"--bump-scale", Method::ImageAligned, "without bumps; add --bump noise"},
      {"--bump-amplitude", Method::ImageAligned, "without bumps; add --bump noise"},
      {"--culling-test", Method::ImageAligned, "without culling; add --culling blocks"},
      {"--culling-theta", Method::ImageAligned, "without the average test; add --culling-test average"},
      {"--culling-block", Method::ImageAligned, "without culling in blocks; use --culling blocks"},
  };
  int refused = 0;
  for (const Case& idle : cases) {
    SceneDescription d;
    d.method = idle.method;
    const std::string said = said_of(idle.flag, d);
    EXPECT_THAT(said, starts_idle(idle.flag));
    EXPECT_THAT(said, HasSubstr(idle.said)) << to_string(idle.method);
    refused += said.empty() ? 0 : 1;
  }
  std::printf("[figure] idle_settings_refused = %d (all of %zu)\n", refused, std::size(cases));
  EXPECT_EQ(refused, 33);
}

TEST(Capability, TurningOffIsNeverInVain) {
  SceneDescription d;
  d.method = Method::RayCast;
  int taken = 0;
  for (const Setting& setting : settings()) {
    if (!setting.capability.turns) continue;
    EXPECT_FALSE(refusal(Given{&setting}, d)) << setting.key;
    ++taken;
  }
  EXPECT_EQ(taken, 11);
}

class IdleKeys : public TemporaryFolder {
 protected:
  std::filesystem::path scene(const std::string& text) const {
    return write("s.toml", "volume = \"point:5\"\n" + text);
  }
  std::string refused(const std::string& text) const {
    const auto path = scene(text);
    return refusal([&] { load_scene_file(path); });
  }
};

TEST_F(IdleKeys, AreRefusedLikeTheirFlagsWithTheirPlace) {
  int checked = 0;
  // Every setting that can be idle in a plain scene of some method, in that scene.
  for (const Setting& setting : settings()) {
    for (const std::string& method : method_names()) {
      SceneDescription d;
      apply(setting_of("--method"), method, d);
      apply(setting, setting.capability.probe, d);
      const auto flag = refusal(Given{&setting}, d);
      if (!flag) continue;
      const std::string table = *setting.table ? fmt::format("[{}]\n", setting.table) : "";
      const std::string said =
          refused(fmt::format("method = \"{}\"\n{}{} = {}\n", method, table, setting.key, value_as_toml(setting, d)));
      EXPECT_THAT(said, HasSubstr(*setting.table ? "s.toml:4:" : "s.toml:3:")) << method;
      EXPECT_THAT(said.substr(said.find(dotted(setting))), starts_idle(dotted(setting))) << method;
      EXPECT_THAT(said, HasSubstr(flag->fix + ", or remove this line")) << method;
      ++checked;
    }
  }
  std::printf("[figure] idle_keys_refused = %d (limit >= 100)\n", checked);
  EXPECT_GE(checked, 100);
}

TEST_F(IdleKeys, AtTheirDefaultAreAccepted) {
  std::string text = to_toml({});
  EXPECT_THAT(text, HasSubstr("aperture"));
  EXPECT_NO_THROW(load_scene_file(write("plain.toml", text)));
}

TEST_F(IdleKeys, MeanSomethingIfAnyFrameSaysSo) {
  const std::string still = "[splat_texture]\nphases = 5\n";
  EXPECT_THAT(refused(still), HasSubstr("splat_texture.phases has no effect without textured"));
  EXPECT_THAT(refused(still + "[sequence]\nframes = 3\nsplat_texture.frame = [0, 3]\n"), HasSubstr("s.toml:3:"));
  EXPECT_THAT(refused("[sequence]\nframes = 3\nsplat_texture.frame = [0, 3]\n"),
              HasSubstr("s.toml:4:23: splat_texture.frame has no effect without textured splats"));
  EXPECT_THAT(refused("[sequence]\nframes = 3\nxray.exposure = [1, 3]\n"),
              HasSubstr("does not apply to image_aligned"));
  EXPECT_NO_THROW(load_scene_file(scene(still + "[sequence]\nframes = 3\nsplat_texture.amplitude = [0, 1]\n")));
}

TEST_F(IdleKeys, AreLeftToTheFlagsByWhoAsks) {
  const SceneFile file = read_scene_file(scene("[xray]\nexposure = 2.0\n"));
  ASSERT_EQ(file.idle.size(), 1u);
  SceneDescription d = file.description;
  d.method = Method::XRay;
  EXPECT_TRUE(idle_of(file.idle, d).empty());
  EXPECT_NO_THROW(refuse_idle(file.idle, d));
}

}  // namespace
}  // namespace fastsplat::scene
