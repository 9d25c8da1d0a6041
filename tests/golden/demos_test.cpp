// SPDX-License-Identifier: Apache-2.0
// The built-in demo scenes show what they claim to show.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "scene/sequence.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

scene::SceneDescription demo(const std::string& name, int size = 0) {
  auto description = scene::load_scene_file("demo:" + name);
  if (size > 0) description.width = description.height = size;
  return description;
}

Image picture(const scene::SceneDescription& description) { return render(scene::build_scene(description)); }

std::vector<Image> pictures(const std::string& name) {
  const auto sequence = scene::load_sequence("demo:" + name);
  std::vector<Image> all;
  for (int frame = 0; frame < sequence.frames; ++frame)
    all.push_back(picture(scene::at_frame(sequence, demo(name), frame)));
  return all;
}

TEST(DemoScenes, PoppingOfTheBinaryCube) {
  struct Steps {
    double popping, at_45;
  };
  const auto steps = [](const std::string& name) -> Steps {
    const auto at = pictures(name);  // 44.2, 44.7, 45.0, 45.1, 45.2
    EXPECT_EQ(at.size(), 5u);
    const double ordinary = rms_difference(at[1], at[0]);
    return {rms_difference(at[4], at[1]) / ordinary, 5.0 * rms_difference(at[3], at[2]) / ordinary};
  };
  const Steps axis = steps("popping-axis-aligned");
  const Steps image = steps("popping-image-aligned");
  figure("demo_popping_axis_aligned_44.7_45.2", axis.popping, "at least 3");
  figure("demo_popping_axis_aligned_45_45.1", axis.at_45, "at least 10: a fifth of the turn, most of the pop");
  figure("demo_popping_image_aligned_44.7_45.2", image.popping, "0.95 to 1.05");
  figure("demo_popping_image_aligned_45_45.1", image.at_45, "0.95 to 1.05");
  EXPECT_GE(axis.popping, 3.0);
  EXPECT_GE(axis.at_45, 10.0);
  EXPECT_NEAR(image.popping, 1.0, 0.05);
  EXPECT_NEAR(image.at_45, 1.0, 0.05);
}

struct Flatness {
  double mean, ripple;  ///< opacity, and its peak-to-peak over the mean
};

/// Over whole cells in the middle of the layer.
Flatness middle_of(const std::string& name) {
  const auto scene = scene::build_scene(demo(name));
  const Image image = render(scene);
  const double cell = scene.camera.project(glm::dvec3(0.0)).scale;
  const auto side = static_cast<int>(std::lround(4.0 * cell));
  double sum = 0.0, least = 1.0, most = 0.0;
  for (int y = (image.height - side) / 2; y < (image.height + side) / 2; ++y) {
    for (int x = (image.width - side) / 2; x < (image.width + side) / 2; ++x) {
      const double opacity = image.pixel(x, y)[3];
      sum += opacity;
      least = std::min(least, opacity);
      most = std::max(most, opacity);
    }
  }
  const double mean = sum / (side * side);
  return {mean, (most - least) / mean};
}

TEST(DemoScenes, AddingAndCompositingOneLayer) {
  const Flatness added = middle_of("layer-adding");
  const Flatness composited = middle_of("layer-compositing");
  // The footprints of a lattice add up to 1 in the mean. So a layer's opacity is one voxel's extinction, -ln(1-0.6).
  // Its ripple is that of the kernel's footprints, by Poisson 8 exp(-pi^2/a) peak to peak.
  const double opacity = -std::log(0.4);
  const double ripple = 8.0 * std::exp(-std::numbers::pi * std::numbers::pi / 2.0);
  figure("demo_layer_adding_opacity", added.mean, "0.916 +- 0.005");
  figure("demo_layer_adding_ripple", added.ripple, "0.058 +- 0.003");
  figure("demo_layer_compositing_opacity", composited.mean, "at least 0.2 less than added");
  figure("demo_layer_compositing_ripple", composited.ripple, "more than added");
  EXPECT_NEAR(added.mean, opacity, 0.005);
  EXPECT_NEAR(added.ripple, ripple, 0.003);
  EXPECT_LT(composited.mean, added.mean - 0.2);
  EXPECT_GT(composited.ripple, added.ripple);
}

/// Largest difference between red and the mirror image of green, of two splats that are mirror images.
double favouritism(const Image& image) {
  double largest = 0.0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double difference = image.pixel(x, y)[0] - image.pixel(image.width - 1 - x, y)[1];
      largest = std::max(largest, std::abs(difference));
    }
  }
  return largest;
}

TEST(DemoScenes, OverlappingSplatsOfOneLayer) {
  const Image added = picture(demo("overlap-adding"));
  const Image composited = picture(demo("overlap-compositing"));
  EXPECT_GT(max_opacity(added), 0.5);
  figure("demo_overlap_adding_asymmetry", favouritism(added), "below 1e-6: neither splat is in front");
  figure("demo_overlap_compositing_asymmetry", favouritism(composited), "above 0.1: one hides the other");
  EXPECT_LT(favouritism(added), 1e-6);
  EXPECT_GT(favouritism(composited), 0.1);
}

TEST(DemoScenes, OneFootprintAtDifferentResolutions) {
  const auto sequence = scene::load_sequence("demo:footprint-resolutions");
  ASSERT_EQ(sequence.frames, 5);
  for (int frame = 0; frame < sequence.frames; ++frame) {
    const auto scene = scene::build_scene(scene::at_frame(sequence, demo("footprint-resolutions"), frame));
    EXPECT_EQ(scene.camera.width(), 8 << frame);
    const double scale = scene.camera.project(glm::dvec3(0.0)).scale;
    const double energy = channel_sum(render(scene), 3) / (scale * scale) / -std::log(0.4);
    // Sampling a Gaussian: 2 exp(-pi^2 s^2 / a) in each direction; its rim, exp(-a R^2) of the peak, is all or nothing.
    const double ripple = 2.0 * std::exp(-std::pow(std::numbers::pi * scale, 2) / 2.0);
    const double bound = (1.0 + ripple) * (1.0 + ripple) - 1.0 + 0.001;
    figure("demo_footprint_energy_" + std::to_string(8 << frame), energy, ("1 +- " + std::to_string(bound)).c_str());
    EXPECT_NEAR(energy, 1.0, bound);
  }
}

/// Each `factor` x `factor` pixels averaged into one.
Image averaged(const Image& image, int factor) {
  Image small(image.width / factor, image.height / factor);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) {
      for (int c = 0; c < 4; ++c) {
        double sum = 0.0;
        for (int i = 0; i < factor * factor; ++i)
          sum += image.pixel(factor * x + i % factor, factor * y + i / factor)[c];
        small.pixel(x, y)[c] = static_cast<float>(sum / (factor * factor));
      }
    }
  }
  return small;
}

TEST(DemoScenes, TheTunnelsFarEndAliases) {
  constexpr int kSize = 96, kFiner = 4;
  const auto description = demo("tunnel", kSize);
  const auto scene = scene::build_scene(description);
  const double half = 0.5 * (scene.volume->dims.y - 1);
  const double near = scene.camera.project({0, half, 0}).scale, far = scene.camera.project({0, -half, 0}).scale;
  figure("demo_tunnel_pixels_per_voxel_near", near, "above 1");
  figure("demo_tunnel_pixels_per_voxel_far", far, "below 0.5: squares of two voxels under a pixel");
  EXPECT_GT(near, 1.0);
  EXPECT_LT(far, 0.5);

  // Alias: the difference from the mean of a finer picture. Far: nearer the middle of the picture.
  const Image coarse = render(scene);
  const Image truth = averaged(picture(demo("tunnel", kFiner * kSize)), kFiner);
  const double mouth = far * half / (0.5 * kSize);  // the far end's place between middle and border of the picture
  double sum[2] = {}, count[2] = {};
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      const double place = std::max(std::abs(x - 0.5 * (kSize - 1)), std::abs(y - 0.5 * (kSize - 1))) / (0.5 * kSize);
      if (place < mouth) continue;
      const int zone = place > 0.5 * (1.0 + mouth) ? 0 : 1;
      sum[zone] += std::pow(coarse.pixel(x, y)[0] - truth.pixel(x, y)[0], 2);
      count[zone] += 1.0;
    }
  }
  ASSERT_GT(std::min(count[0], count[1]), 100.0);
  const double alias[2] = {std::sqrt(sum[0] / count[0]), std::sqrt(sum[1] / count[1])};
  figure("demo_tunnel_alias_near", alias[0], "rms");
  figure("demo_tunnel_alias_far", alias[1], "rms, more than near");
  EXPECT_GT(alias[1], alias[0]);
}

TEST(DemoScenes, TheTerrainIsTheSameOnEveryMachine) {
  const auto scene = scene::build_scene(demo("terrain", 64));
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a of the voxels in 1/65536
  std::uint64_t ground = 0;
  for (const float voxel : scene.volume->voxels) {
    hash = (hash ^ static_cast<std::uint64_t>(std::lround(voxel * 65536.0f))) * 0x100000001b3u;
    ground += voxel > 0.0f;
  }
  std::printf("[figure] demo_terrain_voxels = %llu of %zu, hash %016llx\n", static_cast<unsigned long long>(ground),
              scene.volume->voxels.size(), static_cast<unsigned long long>(hash));
  EXPECT_EQ(hash, 0x6796aab43cf4db67u);
  EXPECT_GT(max_opacity(render(scene)), 0.99);
}

TEST(DemoScenes, TheFireMovesAndComesBack) {
  const auto sequence = scene::load_sequence("demo:fire");
  const auto small = [&](int frame, double amplitude) {
    auto description = scene::at_frame(sequence, demo("fire", 96), frame);
    description.footprint.texture.amplitude *= amplitude;
    return picture(description);
  };
  const Image first = small(0, 1.0);
  const double moved = rms_difference(small(1, 1.0), first);
  const double detail = rms_difference(small(0, 0.0), first);
  figure("demo_fire_frame_to_frame", moved, "rms, above 0.005");
  figure("demo_fire_detail", detail, "rms from plain splats, above 0.005");
  EXPECT_GT(moved, 0.005);
  EXPECT_GT(detail, 0.005);
  auto after = demo("fire", 96);
  after.footprint.texture.frame = sequence.frames;
  EXPECT_EQ(picture(after), first) << "the cycle does not close";
}

TEST(DemoScenes, EveryOneIsATestedOne) {
  const std::vector<std::string> tested{"fire",
                                        "footprint-resolutions",
                                        "layer-adding",
                                        "layer-compositing",
                                        "overlap-adding",
                                        "overlap-compositing",
                                        "popping-axis-aligned",
                                        "popping-image-aligned",
                                        "terrain",
                                        "tunnel"};
  EXPECT_EQ(scene::demo_names(), tested);
}

}  // namespace
}  // namespace fastsplat::golden::testing
