// SPDX-License-Identifier: Apache-2.0
// The visible part: crop, fit to the content, background and negative, in both engines.
#include <cmath>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "scene/volume/volume_file.hpp"
#include "tests/driver/scenes_helper.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::driver {
namespace {

using scene::SceneDescription;

Image golden_picture(const scene::Scene& scene) { return golden::render(scene, {.threads = 1, .progress = {}}); }
Image device_picture(const scene::Scene& scene) { return to_image(render(scene, load_config("base")).frame); }

/// A small bright cube far from the centre of a dark, larger volume.
std::shared_ptr<const volume::Volume> off_centre() {
  return std::make_shared<const volume::Volume>(
      volume::make_volume({40, 48, 44}, {1.0, 1.0, 1.5}, volume::VoxelType::U8, [](int i, int j, int k) {
        return i >= 4 && i < 12 && j >= 30 && j < 44 && k >= 6 && k < 20 ? 200 : (i == 20 && j == 20 ? 1 : 0);
      }));
}

SceneDescription bright(int width, int height) {
  SceneDescription d;
  d.volume = "none";
  d.transfer_function = "binary";
  d.width = width;
  d.height = height;
  return d;
}

struct Edges {
  int left, right, above, below;  ///< empty pixels there
};
Edges empty_edges(const Image& image) {
  Edges edges{image.width, image.width, image.height, image.height};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      if (!(image.pixel(x, y)[3] > 1e-4f)) continue;
      edges = {std::min(edges.left, x), std::min(edges.right, image.width - 1 - x), std::min(edges.above, y),
               std::min(edges.below, image.height - 1 - y)};
    }
  }
  return edges;
}

// N-8-14, and N-8-15: rays of such a camera.
TEST(View, FitContentFillsThePictureWithTheContent) {
  const auto volume = off_centre();
  int checked = 0;
  for (const bool perspective : {false, true}) {
    for (const auto& [width, height] : {std::pair{120, 80}, {64, 160}}) {
      SceneDescription d = bright(width, height);
      if (perspective) d.camera.projection = scene::Projection::Perspective;
      const Edges before = empty_edges(golden_picture(scene::build_scene(d, volume)));
      d.camera.fit = scene::Fit::Content;
      const scene::Scene scene = scene::build_scene(d, volume);
      for (const Image& image : {golden_picture(scene), device_picture(scene)}) {
        const Edges edges = empty_edges(image);
        figure("fit_content_empty_edges", std::min(edges.left + edges.right, edges.above + edges.below),
               "pixels across and down at best, " +
                   std::to_string(std::min(before.left + before.right, before.above + before.below)) + " before");
        EXPECT_LE(std::min(edges.left + edges.right, edges.above + edges.below), 6);  // the kernel's faint skirt
        EXPECT_LE(std::abs(edges.left - edges.right), 3);
        EXPECT_LE(std::abs(edges.above - edges.below), 3);
        ++checked;
      }
      // A ray meets the points that are projected to its pixel, off the axis too.
      const auto at = scene.camera.project({3.0, -5.0, 7.0});
      const scene::Ray ray = scene.camera.ray(at.x, at.y);
      EXPECT_NEAR(glm::distance(ray.origin + ray.direction * (at.depth / ray.depth_per_mm), {3.0, -5.0, 7.0}), 0.0,
                  1e-9);
      d.camera.zoom = 0.5;
      EXPECT_NEAR(scene::build_scene(d, volume).camera.scale_at(0.0), 0.5 * scene.camera.scale_at(0.0), 1e-9);
    }
  }
  EXPECT_EQ(checked, 8);
}

// N-8-3.
TEST(View, ACropIsTheVolumeOfItsVoxelsInTheColoursOfTheWhole) {
  const auto whole = std::make_shared<const volume::Volume>(volume::make_volume(
      glm::ivec3(24), glm::dvec3(1.0), volume::VoxelType::U8, [](int i, int j, int k) { return 7 * i + j + k; }));
  SceneDescription d = view_of("none", 64);
  d.transfer_function = "mri-head";  // by percentile
  d.crop = {{2, 0, 5}, {13, 23, 20}};
  const scene::Scene scene = scene::build_scene(d, whole);
  EXPECT_EQ(scene.volume->dims, glm::ivec3(12, 24, 16));
  EXPECT_EQ(scene.volume->at(0, 0, 0), whole->at(2, 0, 5));
  EXPECT_EQ(scene.volume->at(11, 23, 15), whole->at(13, 23, 20));
  EXPECT_EQ(scene.volume->centre, whole->position(2, 0, 5) + 0.5 * glm::dvec3(11, 23, 15));
  const scene::Classifier cut(scene.transfer_function, *scene.volume);
  const scene::Classifier all(scene::load_transfer_function("mri-head"), *whole);
  int different = 0;
  for (const float value : scene.volume->voxels)
    different += cut(value).extinction != all(value).extinction || cut(value).colour != all(value).colour;
  figure("colours_changed_by_a_crop", different, "voxels (limit 0)");
  EXPECT_EQ(different, 0);
  EXPECT_EQ(scene::build_scene(d, scene.whole).volume->voxels,
            scene.volume->voxels);  // as an animation builds it again
  EXPECT_GT(distance(device_picture(scene), golden_picture(scene)).psnr_db, 45.0);
  d.crop.high.y = 24;
  const std::string said = volume::refusal([&] { scene::build_scene(d, whole); }, ExitCode::Usage);
  EXPECT_NE(said.find("0..23,0..23,0..23"), std::string::npos) << said;
}

TEST(View, BackgroundAndNegativeAreForLooking) {
  SceneDescription d = view_of("shells:16", 40);
  const Image plain = golden_picture(scene::build_scene(d));
  EXPECT_TRUE(scene::displayed(plain, d) == plain);
  d.display.background = {0.25, 0.5, 1.0};
  EXPECT_TRUE(golden_picture(scene::build_scene(d)) == plain) << "the engine's picture changed";
  const Image shown = scene::displayed(plain, d);
  double worst = 0.0;
  for (std::size_t at = 0; at < shown.data.size(); at += 4) {
    EXPECT_EQ(shown.data[at + 3], 1.0f);
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(shown.data[at + c] -
                                       (plain.data[at + c] + (1.0 - plain.data[at + 3]) * d.display.background[c])));
  }
  figure("background_error", worst, "(limit 1e-6)");
  EXPECT_LT(worst, 1e-6);

  SceneDescription x = view_of("shells:16", 40);
  x.method = scene::Method::XRay;
  x.display.invert = true;
  for (const Image& ray : {golden_picture(scene::build_scene(x)), device_picture(scene::build_scene(x))}) {
    const Image film = scene::displayed(ray, x);
    EXPECT_EQ(film.pixel(0, 0)[0], 1.0f);  // an empty part: bright
    int wrong = 0;
    const auto srgb = [](double v) { return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055; };
    for (std::size_t at = 0; at < film.data.size(); ++at)
      wrong += at % 4 != 3 && std::abs(srgb(film.data[at]) + srgb(std::clamp(ray.data[at], 0.0f, 1.0f)) - 1.0) > 1e-5;
    figure("negative_wrong_values", wrong, "(limit 0)");
    EXPECT_EQ(wrong, 0);
  }
}

}  // namespace
}  // namespace fastsplat::driver
