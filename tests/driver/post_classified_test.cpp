// SPDX-License-Identifier: Apache-2.0
// Classification by pixel on the device: against golden's, over methods of opacity, slabs, tiles and projections; its
// normals; refusals.
#include "golden/post_classified.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <mutex>
#include <numbers>
#include <tuple>

#include "base/error.hpp"
#include "cmodel/model.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/render.hpp"
#include "golden/density_splats.hpp"
#include "golden/render.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

scene::SceneDescription post_view(const std::string& volume, int size, const std::string& transfer_function) {
  auto description = view_of(volume, size, transfer_function);
  description.classify = scene::ClassifyOrder::Post;
  description.camera.azimuth = 31;
  description.camera.elevation = 20;
  return description;
}

cmodel::Config with_densities(const std::string& name) {
  auto config = load_config(name);
  config.classify_segment_bits = 9;
  EXPECT_FALSE(cmodel::first_violation(config)) << one_line(*cmodel::first_violation(config));
  return config;
}

Lsb8 measure_post(const scene::SceneDescription& description, const cmodel::Config& config, const std::string& what) {
  const auto scene = scene::build_scene(description);
  const auto device = render(scene, config);
  EXPECT_EQ(device.counters.snap_saturated + device.counters.sheet_saturated, 0u);
  const Image reference = golden::render(scene);
  double lit = 0.0;
  for (const float value : reference.data) lit = std::max(lit, static_cast<double>(value));
  EXPECT_GT(lit, 0.2) << "a dark picture compares nothing";
  const Lsb8 apart = distance(reference, to_image(device.frame));
  figure(what + ": PSNR", apart.psnr_db, "dB");
  figure(what + ": max", apart.largest, "LSB8");
  return apart;
}

// Ramps as wide as the presets', up to 2.5 pixels a voxel; the volume is 24 voxels wide.
TEST(PostOnDevice, base_is_within_50_db_of_golden) {
  for (const double width : {1.0, 0.5}) {
    for (const auto opacity : {scene::SlabOpacity::Exponential, scene::SlabOpacity::Additive}) {
      auto description = post_view("marschner-lobb:24", 64, "ct-head");
      description.slab_width = width;
      description.slab_opacity = opacity;
      const auto apart =
          measure_post(description, with_densities("base"),
                       std::string(width < 1.0 ? "half" : "whole") + " slabs, " + scene::to_string(opacity));
      EXPECT_GE(apart.psnr_db, 50.0);
    }
  }
}

// The same and nearer: 1.5 to 10 pixels a voxel.
TEST(PostOnDevice, fine_is_within_57_db_of_golden) {
  for (const double zoom : {1.0, 3.0, 6.5}) {
    auto description = post_view("marschner-lobb:24", 64, "ct-head");
    description.camera.zoom = zoom;
    const auto apart =
        measure_post(description, with_densities("fine"), "fine, zoom " + std::to_string(zoom).substr(0, 3));
    EXPECT_GE(apart.psnr_db, 57.0);
  }
}

// Pixels per unit change from sheet to sheet, and rays lean. If radii differ much, the steps between radius sets
// dominate: a voxel of the next set has another width, and the gradient shows it. RLUT columns decide how many sets
// exist: 8 in base and fine here, 32 with 512 columns.
TEST(PostOnDevice, perspective_is_within_50_db_of_golden_where_radius_sets_are_many) {
  auto description = post_view("marschner-lobb:24", 64, "ct-head");
  description.camera.projection = scene::Projection::Perspective;
  description.camera.fov = 45;
  const double few = measure_post(description, with_densities("fine"), "fine, perspective, 8 sets").psnr_db;
  auto config = with_densities("fine");
  config.rlut_columns = 512;
  config.rlut_sets = 64;
  const double many = measure_post(description, config, "fine, perspective, 32 sets").psnr_db;
  EXPECT_GE(many, 50.0);
  EXPECT_GT(many, few);
}

// Each ellipse has the radius of its own splat: no steps remain, and the table needs no more words.
TEST(PostOnDevice, perspective_with_ellipses_is_within_50_db_of_golden) {
  auto description = post_view("marschner-lobb:24", 64, "ct-head");
  description.camera.projection = scene::Projection::Perspective;
  description.camera.fov = 45;
  description.footprint.shape = scene::FootprintShape::Ellipse;
  for (const char* name : {"base", "fine"}) {
    auto config = with_densities(name);
    config.ellipse_frac_bits = 12;
    ASSERT_FALSE(cmodel::first_violation(config));
    const auto apart = measure_post(description, config, std::string(name) + ", perspective, ellipses");
    EXPECT_GE(apart.psnr_db, 50.0);
  }
}

// N-8-89.
TEST(PostOnDevice, tiles_never_show) {
  auto description = post_view("shells:20", 60, "ct-head");
  description.camera.zoom = 1.7;
  auto config = with_densities("base");
  config.tile_width = config.tile_height = 64;
  const auto whole = render(scene::build_scene(description), config).frame;
  config.tile_width = 24, config.tile_height = 16;
  const auto parts = render(scene::build_scene(description), config).frame;
  const WordDifference apart = difference(whole, parts);
  figure("words compared", static_cast<double>(apart.compared));
  EXPECT_EQ(apart.different, 0u);
  EXPECT_GT(apart.compared, 10000u);
}

TEST(PostOnDevice, what_it_has_not_is_refused) {
  const auto scene = scene::build_scene(post_view("shells:12", 24, "ct-head"));
  EXPECT_THROW(render(scene, load_config("base")), UserError) << "a device without densities";
  auto shown = scene;
  shown.transfer_function.points = {{0.0, glm::dvec3(1.0), 0.5}, {1.0, glm::dvec3(1.0), 0.5}};
  // N-8-91
  EXPECT_THROW(render(shown, with_densities("base")), UserError) << "what lies around the volume would be seen";
}

using Place = std::tuple<std::uint32_t, int, int>;  ///< sheet, y, x

/// Golden's gradients where the density is near the middle of the range.
class GoldenGradients final : public golden::SheetStage {
 public:
  GoldenGradients(const golden::PostClassified& classified, const golden::SheetGeometry& geometry, double range)
      : classified_(classified), geometry_(geometry), range_(range) {}
  bool needs_neighbours() const override { return true; }
  void row(const golden::SheetWindow& window, int y, int begin, std::span<golden::Sums> pixels) const override {
    for (int i = 0; i < static_cast<int>(pixels.size()); ++i) {
      const int x = begin + i;
      if (std::abs(window.here.row(y)[x][3] / geometry_.width() / range_ - 0.5) > 0.1) continue;
      const auto gradient = classified_.gradient(window, x, y, geometry_.pixels_per_unit(window.number));
      const std::lock_guard lock(mutex_);
      at[{static_cast<std::uint32_t>(window.number), y, x}] = gradient;
    }
  }
  mutable std::map<Place, glm::dvec3> at;

 private:
  const golden::PostClassified& classified_;
  const golden::SheetGeometry& geometry_;
  double range_;
  mutable std::mutex mutex_;
};

/// The device's densities, from the output of each window.
class Densities final : public cmodel::TapSink {
 public:
  Densities(const TileGrid& grid, int lanes, int sheets)
      : grid_(grid),
        lanes_(lanes),
        words_(static_cast<std::size_t>(sheets + 2) * static_cast<std::size_t>(grid.image_height * grid.image_width)) {}
  void on_tap(const cmodel::TapRecord& tap) override {
    if (tap.tap != cmodel::Tap::Sheet) return;
    const int tile = static_cast<int>(tap.tile);
    for (int lane = 0; lane < lanes_ * lanes_; ++lane) {
      const int x = tap.x + lane % lanes_, y = tap.y + lane / lanes_;
      if (x < 0 || y < 0 || x >= grid_.width(tile) || y >= grid_.height(tile)) continue;
      words_[place(tap.sheet, grid_.y(tile) + y, grid_.x(tile) + x)] =
          tap.payload[static_cast<std::size_t>(lane) * 4 + 3];
    }
  }
  double operator()(std::uint32_t sheet, int y, int x) const { return words_[place(sheet, y, x)]; }

 private:
  std::size_t place(std::uint32_t sheet, int y, int x) const {
    return (static_cast<std::size_t>(sheet + 1) * static_cast<std::size_t>(grid_.image_height) +
            static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(grid_.image_width) +
           static_cast<std::size_t>(x);
  }
  const TileGrid& grid_;
  int lanes_;
  std::vector<std::uint32_t> words_;
};

/// 1 in the middle, 1/2 at 10 voxels from it, over 8 voxels; 32 voxels wide.
std::shared_ptr<const volume::Volume> ball() {
  auto volume = std::make_shared<volume::Volume>();
  volume->name = volume->source = "ball";
  volume->dims = glm::ivec3(32);
  for (int k = 0; k < 32; ++k)
    for (int j = 0; j < 32; ++j)
      for (int i = 0; i < 32; ++i)
        volume->voxels.push_back(
            static_cast<float>(std::clamp(0.5 + (10.0 - glm::length(volume->position(i, j, k))) / 8.0, 0.0, 1.0)));
  volume->min = 0.0F, volume->max = 1.0F;
  return volume;
}

// A ball's normals at 3 pixels a voxel. The device's words of g add less than a thousandth of a degree (g has 16
// fraction bits and is at least a thirtieth). The error of the densities' words is all of it.
TEST(PostOnDevice, normals_are_within_1_2_degrees_of_goldens) {
  auto description = post_view("shells:20", 40, "ct-head");
  description.camera.zoom = 3.6;
  const auto scene = scene::build_scene(description, ball());
  const golden::SheetGeometry geometry(scene);
  const golden::DensityField field = golden::collect_densities(scene, false);
  const golden::PostClassified classified(scene, geometry, field.base, {});
  const double range = static_cast<double>(scene.volume->max) - scene.volume->min;
  const GoldenGradients gradients(classified, geometry, range);
  golden::sweep_frame(scene, field.splats, {}, golden::image_slabs(scene), {.sheet_stages = {&gradients}});
  ASSERT_GT(gradients.at.size(), 2000u);

  for (const char* name : {"base", "fine"}) {
    const auto config = with_densities(name);
    const CompiledFrame compiled(scene, config);
    Densities device(compiled.grid(), config.lanes, geometry.sheets());
    cmodel::NullPixels nowhere;
    cmodel::Model model(config, cmodel::StreamScope::Subset, nowhere, &device);
    compiled.emit([&](std::span<const cmodel::Beat> beats) { model.consume(beats); });
    double sum = 0.0, most = 0.0;
    for (const auto& [place, gradient] : gradients.at) {
      const auto [sheet, y, x] = place;
      if (x == 0 || y == 0 || x == description.width - 1 || y == description.height - 1) continue;
      const double pixels = geometry.pixels_per_unit(static_cast<int>(sheet)) / 2.0, deep = 0.5 / geometry.width();
      const glm::dvec3 g = (device(sheet, y, x + 1) - device(sheet, y, x - 1)) * pixels * scene.camera.right() +
                           (device(sheet, y + 1, x) - device(sheet, y - 1, x)) * pixels * scene.camera.down() +
                           (device(sheet + 1, y, x) - device(sheet - 1, y, x)) * deep * scene.camera.direction();
      const double cosine = glm::dot(glm::normalize(g), glm::normalize(gradient));
      const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
      sum += angle, most = std::max(most, angle);
    }
    std::printf("[figure] %.2f pixels a voxel: ", geometry.pixels_per_unit(geometry.sheets() / 2));
    const double mean = sum / static_cast<double>(gradients.at.size());
    figure(std::string(name) + ": normals, mean", mean, "degrees (goal 1.2 in base)");
    figure(std::string(name) + ": normals, max", most, "degrees");
    EXPECT_LE(mean, 1.2);
    EXPECT_GT(mean, 0.0) << "nothing was compared";
  }
}

}  // namespace
}  // namespace fastsplat::driver
