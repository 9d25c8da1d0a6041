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
  std::uint64_t compared = 0, different = 0;
};

Differences against_device(const scene::Scene& scene, const cmodel::Config& config) {
  const cmodel::Frame frame = driver::render(scene, config).frame;
  const Picture picture = Chain(scene, config)(Mixture::all_device(), 2);
  Differences out;
  for (std::size_t i = 0; i < frame.words.size(); ++i) {
    const double word = std::ldexp(picture.pixels[i / 4][i % 4], frame.frac_bits);
    ++out.compared;
    out.different += word == static_cast<double>(frame.words[i]) ? 0 : 1;
  }
  return out;
}

TEST(Chain, AllDeviceIsTheIntegerModelBitForBit) {
  std::uint64_t compared = 0, frames = 0;
  for (const std::string& name : test::config_names()) {
    const cmodel::Config config = test::named_config(name);
    for (const auto& description : views(40)) {
      const Differences differences = against_device(scene::build_scene(description), config);
      EXPECT_EQ(differences.different, 0u) << name << ", view " << frames % 7;
      compared += differences.compared;
      ++frames;
    }
  }
  std::printf("[figure] %llu frames, %llu words, 0 different\n", static_cast<unsigned long long>(frames),
              static_cast<unsigned long long>(compared));
}

TEST(Chain, AllDeviceIsTheIntegerModelForEveryKindOfIndex) {
  std::uint64_t compared = 0, frames = 0;
  for (int kind = 0; kind < 6; ++kind) {
    for (const char* name : {"base", "compact", "tiny"}) {
      cmodel::Config config = test::named_config(name);
      config.index_kind = kind;
      if (const auto wrong = cmodel::first_violation(config)) {
        config.rlut_columns = 16;  // blit2d stores a footprint for every two phases
        config.phases = std::min(config.phases, 16);
        config.position_frac_bits = std::min(config.position_frac_bits, 5);
      }
      ASSERT_FALSE(cmodel::first_violation(config)) << kind << " " << name;
      for (const auto& description : views(24)) {
        const Differences differences = against_device(scene::build_scene(description), config);
        EXPECT_EQ(differences.different, 0u) << "kind " << kind << ", " << name << ", view " << frames % 7;
        compared += differences.compared;
        ++frames;
      }
    }
  }
  std::printf("[figure] %llu frames of six kinds, %llu words, 0 different\n", static_cast<unsigned long long>(frames),
              static_cast<unsigned long long>(compared));
}

TEST(Chain, AllRealIsGoldenFloatByFloat) {
  std::uint64_t compared = 0, frames = 0;
  for (const char* name : {"base", "tiny"}) {
    const cmodel::Config config = test::named_config(name);
    for (const auto& description : views(48)) {
      const scene::Scene scene = scene::build_scene(description);
      const Image image = golden::render(scene);
      const Picture picture = Chain(scene, config)(Mixture{}, 2);
      std::uint64_t different = 0;
      for (std::size_t i = 0; i < image.data.size(); ++i)
        different += image.data[i] == static_cast<float>(picture.pixels[i / 4][i % 4]) ? 0 : 1;
      EXPECT_EQ(different, 0u) << name << ", view " << frames % 7;
      compared += image.data.size();
      ++frames;
    }
  }
  std::printf("[figure] %llu frames, %llu floats, 0 different\n", static_cast<unsigned long long>(frames),
              static_cast<unsigned long long>(compared));
}

}  // namespace
}  // namespace fastsplat::stages
