// SPDX-License-Identifier: Apache-2.0
// The kernels of many splats give the words of the functions of one, with every kind of vector instruction here.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "driver/config/config_file.hpp"
#include "driver/splats/splat_quantiser.hpp"
#include "driver/tiles/frame_head.hpp"
#include "driver/tiles/share_kernel.hpp"
#include "tests/driver/fast_unit_helper.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

/// A frame's quantiser with what it refers to.
struct Frame {
  scene::Scene scene;
  FrameHead head;
  SplatQuantiser quantised;

  Frame(const scene::SceneDescription& description, const cmodel::Config& config)
      : scene(scene::build_scene(description)),
        head(scene, config, 1),
        quantised(scene, head.config, head.sets, head.slices, head.plan) {}
};

scene::SceneDescription turned(scene::Projection projection) {
  auto description = view_of("shells:16", 90);
  description.camera.projection = projection;
  description.camera.azimuth = 33.0, description.camera.elevation = -21.0, description.camera.roll = 7.0;
  return description;
}

/// Numbers of one kind that differ.
struct Compared {
  std::size_t all = 0, different = 0;
  template <class T>
  void add(const T& a, const T& b) {
    ++all;
    different += a == b ? 0 : 1;
  }
  ~Compared() {
    figure("words compared", static_cast<double>(all));
    figure("words that differ", static_cast<double>(different));
    EXPECT_GT(all, 0U);
    EXPECT_EQ(different, 0U);
  }
};

TEST(SplatKernels, PlaceCentresAsOneByOne) {
  Compared compared;
  Targets targets;
  std::mt19937 random(7);
  for (const auto projection : {scene::Projection::Orthographic, scene::Projection::Perspective}) {
    for (const auto& name : config_names()) {
      const Frame frame(turned(projection), load_config(name));
      const auto radius = static_cast<float>(frame.scene.volume->bounding_radius() / std::sqrt(3.0));
      std::uniform_real_distribution<float> somewhere(-radius, radius);
      constexpr std::size_t kCount = 37;  // no multiple of a vector
      std::array<std::array<float, kCount + kMoreCentres>, 3> at{};
      for (auto& row : at)
        for (std::size_t i = 0; i < kCount; ++i) row[i] = somewhere(random);
      for (const std::uint64_t target : targets.all()) {
        targets.choose(target);
        std::array<std::int32_t, kCount + kMoreCentres> x{}, y{}, depth{};
        std::array<double, kCount + kMoreCentres> scale{};
        place_centres(frame.quantised.centre_rule(), {at[0].data(), at[1].data(), at[2].data()}, kCount, x.data(),
                      y.data(), depth.data(), scale.data());
        for (std::size_t i = 0; i < kCount; ++i) {
          const glm::vec3 position(at[0][i], at[1][i], at[2][i]);
          const auto one = frame.quantised.place(frame.scene.camera.project(glm::dvec3(position)), 0, position);
          const auto many = frame.quantised.placed(x[i], y[i], depth[i], scale[i], 0, position);
          compared.add(many.splat.x, one.splat.x);
          compared.add(many.splat.y, one.splat.y);
          compared.add(many.splat.depth, one.splat.depth);
          compared.add(many.splat.set, one.splat.set);
          compared.add(many.amplitude, one.amplitude);
        }
      }
    }
  }
}

TEST(SplatKernels, RoundColoursAsOneByOne) {
  Compared compared;
  Targets targets;
  std::mt19937 random(8);
  std::uniform_real_distribution<float> material(0.0f, 1.0f);
  int saturated = 0, vanished = 0;
  for (const auto& name : config_names()) {
    const Frame frame(turned(scene::Projection::Orthographic), load_config(name));
    // From what vanishes to what leaves U 4.cf.
    for (const double amplitude : {1e-9, 2e-5, 0.01, 1.0, 15.0, 40.0}) {
      std::vector<ColourToRound> colours(19);
      for (auto& one : colours) {
        for (auto& channel : one.material) channel = material(random);
        one.amplitude = amplitude;
      }
      for (const std::uint64_t target : targets.all()) {
        targets.choose(target);
        frame.quantised.colour(colours.data(), colours.size());
        for (const ColourToRound& many : colours) {
          SplatWords words{};
          bool cut = false;
          double asked = 0.0;
          for (std::size_t c = 0; c < 4; ++c) {
            const double value = static_cast<double>(many.material[c]) * amplitude;
            const Quantised channel = quantise(value, driver::target(Site::Whole, frame.head.config));
            words[c] = static_cast<std::uint32_t>(channel.word);
            cut = cut || channel.saturated;
            asked += value;
          }
          compared.add(many.words, words);
          compared.add(many.saturated, cut);
          compared.add(many.asked, asked);
          compared.add(many.empty(), words == SplatWords{});
          saturated += cut ? 1 : 0;
          vanished += many.empty() ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(saturated, 0);
  EXPECT_GT(vanished, 0);
}

TEST(SplatKernels, ShareOutAsOneByOne) {
  Compared compared;
  Targets targets;
  std::mt19937 random(9);
  int saturated = 0, empty = 0;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    const int shift = 16 - config.colour_frac_bits;
    const Slices slices(config, scene::kernel_by_name("gauss2"), 0.7, 20);
    const std::uint32_t most = (16U << config.colour_frac_bits) - 1;
    std::vector<WaitingSplat> splats(200);
    for (auto& splat : splats) {
      // Words of all sizes; the largest too.
      for (auto& word : splat.words)
        word = random() % 8 == 0 ? most : static_cast<std::uint32_t>(random()) & most >> random() % 24;
      splat.depth = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(slices.boundary(20)));
    }
    for (const std::uint64_t target : targets.all()) {
      targets.choose(target);
      for (int sheet = -1; sheet < 20; ++sheet) {  // -1: whole splats
        std::vector<SheetColour> out(splats.size());
        share_out(sheet < 0 ? slices.uncut() : slices.cut(sheet), shift, splats.data(), splats.size(), out.data());
        for (std::size_t i = 0; i < splats.size(); ++i) {
          const Share share =
              sheet < 0 ? slices.whole(splats[i].words) : slices.share(splats[i].words, splats[i].depth, sheet);
          std::array<std::uint16_t, 4> words{};
          for (std::size_t c = 0; c < 4; ++c) words[c] = static_cast<std::uint16_t>(share.words[c] << shift);
          compared.add(out[i].words, words);
          compared.add(out[i].empty, share.empty());
          compared.add(out[i].saturated, share.saturated);
          saturated += share.saturated ? 1 : 0;
          empty += share.empty() ? 1 : 0;
        }
      }
    }
  }
  EXPECT_GT(saturated, 0);
  EXPECT_GT(empty, 0);
}

}  // namespace
}  // namespace fastsplat::driver
