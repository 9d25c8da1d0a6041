// The chain of steps: all device is the integer model, all real is golden, and each step alone does what its page says.
#include "stages/chain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "driver/render.hpp"
#include "golden/render.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::stages {
namespace {

scene::SceneDescription view_of(const std::string& volume, int size) {
  scene::SceneDescription description;
  description.volume = volume;
  description.width = description.height = size;
  return description;
}

/// Views that take every way through the chain.
std::vector<scene::SceneDescription> views(int size) {
  std::vector<scene::SceneDescription> all;
  all.push_back(view_of("shells:24", size));
  all.back().camera.azimuth = 25.0;
  all.back().camera.elevation = 15.0;
  all.push_back(all.front());
  all.back().camera.projection = scene::Projection::Perspective;
  all.push_back(all.front());
  all.back().slab_opacity = scene::SlabOpacity::Additive;
  all.push_back(all.front());
  all.back().method = scene::Method::AxisAligned;
  all.push_back(all.front());
  all.back().method = scene::Method::XRay;
  all.push_back(all.front());
  all.back().method = scene::Method::XRay;
  all.back().xray_sheets = 5;
  all.push_back(all.front());
  all.back().slab_width = 0.37;
  all.back().opacity_scale = 6.0;
  return all;
}

struct Differences {
  std::uint64_t frames = 0, compared = 0, different = 0;
  void add(bool same) {
    ++compared;
    different += same ? 0 : 1;
  }
  void print(const char* what) const {
    std::printf("[figure] %llu frames, %llu %s, %llu different\n", static_cast<unsigned long long>(frames),
                static_cast<unsigned long long>(compared), what, static_cast<unsigned long long>(different));
  }
};

/// All views of a configuration against the integer model.
void against_device(const cmodel::Config& config, int size, Differences& all) {
  for (const auto& description : views(size)) {
    const scene::Scene scene = scene::build_scene(description);
    const cmodel::Frame frame = driver::render(scene, config).frame;
    const Picture picture = Chain(scene, config)(Mixture::all_device(), 2);
    const std::uint64_t before = all.different;
    for (std::size_t i = 0; i < frame.words.size(); ++i)
      all.add(std::ldexp(picture.pixels[i / 4][i % 4], frame.frac_bits) == static_cast<double>(frame.words[i]));
    EXPECT_EQ(all.different, before) << config.name << ", index kind " << config.index_kind << ", view "
                                     << all.frames % 7;
    ++all.frames;
  }
}

TEST(Chain, AllDeviceIsTheIntegerModelBitForBit) {
  Differences all;
  for (const std::string& name : test::config_names()) against_device(test::named_config(name), 40, all);
  all.print("words");
  EXPECT_GT(all.compared, 100000u);
}

TEST(Chain, AllDeviceIsTheIntegerModelForEveryKindOfIndex) {
  Differences all;
  for (int kind = 0; kind < 6; ++kind) {
    for (const char* name : {"base", "compact", "tiny"}) {
      cmodel::Config config = test::named_config(name);
      config.index_kind = kind;
      if (cmodel::first_violation(config)) {
        config.rlut_columns = 16;  // blit2d stores a footprint for every two phases
        config.phases = std::min(config.phases, 16);
        config.position_frac_bits = std::min(config.position_frac_bits, 5);
      }
      ASSERT_FALSE(cmodel::first_violation(config)) << kind << " " << name;
      against_device(config, 24, all);
    }
  }
  all.print("words of six kinds of index");
  EXPECT_GT(all.compared, 100000u);
}

TEST(Chain, AllRealIsGoldenFloatByFloat) {
  Differences all;
  for (const char* name : {"base", "tiny"}) {
    const cmodel::Config config = test::named_config(name);
    for (const auto& description : views(48)) {
      const scene::Scene scene = scene::build_scene(description);
      const Image image = golden::render(scene);
      const Picture picture = Chain(scene, config)(Mixture{}, 2);
      const std::uint64_t before = all.different;
      for (std::size_t i = 0; i < image.data.size(); ++i)
        all.add(image.data[i] == static_cast<float>(picture.pixels[i / 4][i % 4]));
      EXPECT_EQ(all.different, before) << name << ", view " << all.frames % 7;
      ++all.frames;
    }
  }
  all.print("floats");
  EXPECT_GT(all.compared, 100000u);
}

}  // namespace
}  // namespace fastsplat::stages
