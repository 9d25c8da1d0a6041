// SPDX-License-Identifier: Apache-2.0
// Every record of a view of 3-D Gaussians from docs/numerics.md, section 8, alone: places, colours, shapes, order,
// counts. (Windows: gaussians_test.cpp.)
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "cmodel/stream/records.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/gaussian_frame.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

/// The words by the page (N-8-84).
struct Words {
  std::int64_t x, y, a, b, c, h;
  std::array<std::int64_t, 4> colour;
};

Words words_of(const scene::ProjectedGaussian& splat, double cutoff, const cmodel::Config& config) {
  const double steps = std::ldexp(1.0, config.position_frac_bits), cf = std::ldexp(1.0, config.colour_frac_bits);
  Words out{.x = static_cast<std::int64_t>(std::floor(splat.x * steps + 0.5)),
            .y = static_cast<std::int64_t>(std::floor(splat.y * steps + 0.5)),
            .a = 0,
            .b = 0,
            .c = 0,
            .h = 0,
            .colour = {}};
  for (std::size_t i = 0; i < 4; ++i) {
    const double value = i == 3 ? splat.opacity : splat.opacity * splat.colour[static_cast<int>(i)];
    const double most = std::ldexp(cf, config.colour_int_bits) - 1.0;
    out.colour[i] = static_cast<std::int64_t>(std::min(std::floor(value * cf + 0.5), most));
  }
  const double rr = cutoff * cutoff, fxx = rr * splat.shape.xx, fxy = rr * splat.shape.xy, fyy = rr * splat.shape.yy;
  const double m =
      static_cast<double>(config.radial_entries) * std::ldexp(1.0, config.rlut_guard_bits) / (steps * steps);
  const double a = m / (fxx - fxy * (fxy / fyy)), c = m / (fyy - fxy * (fxy / fxx)), b = -2.0 * (a * (fxy / fyy));
  out.h = std::clamp(21 - static_cast<int>(std::floor(std::log2(std::max(a, c)))), 0, 63);
  const auto scaled = [&](double value) { return std::ldexp(value, static_cast<int>(out.h)); };
  if (std::ceil(scaled(std::max(a, c))) >= 4194304.0) --out.h;
  out.a = static_cast<std::int64_t>(std::ceil(scaled(a)));
  out.c = static_cast<std::int64_t>(std::ceil(scaled(c)));
  out.b = static_cast<std::int64_t>(std::floor(scaled(std::abs(b)))) * (b < 0.0 ? -1 : 1);
  return out;
}

// N-8-84, and N-8-88: the mode, the only sheet, the order of records.
TEST(GaussianWords, AreThoseOfThePage) {
  auto config = load_config("ellipse");
  config.composite_every_sample = 1;
  config.tile_width = 64, config.tile_height = 48;
  std::uint64_t records = 0, different = 0, in_tiles = 0, bright = 0;
  for (const auto& [name, int_bits] : {std::pair{"shells:600", 0}, {"cloud:400", 0}, {"cloud:400", 2}}) {
    config.colour_int_bits = int_bits, config.colour_frac_bits = 16 - int_bits;
    scene::GaussianDescription description;
    description.camera.projection = scene::Projection::Perspective;
    description.camera.zoom = 1.7;
    description.width = 150, description.height = 110;
    auto cloud = scene::make_synthetic_gaussians(name);
    cloud.harmonics[3] = glm::vec3(9.0F);  // a truncated one
    const auto scene =
        scene::build_gaussian_scene(description, std::make_shared<scene::GaussianCloud>(std::move(cloud)));
    const auto projected = scene::project_all(scene);
    const GaussianFrame frame(scene, projected, config);
    for (int tile = 0; tile < frame.grid().count(); ++tile) {
      std::vector<cmodel::Record> all;
      const GaussianReport report = frame.emit_tile(tile, [&](std::span<const cmodel::Beat> beats) {
        for (const cmodel::Beat& beat : beats) all.push_back(cmodel::from_beat(beat));
      });
      const auto& begin = std::get<cmodel::BeginTile>(all.front());
      EXPECT_EQ(begin.mode, cmodel::Mode::SampleAdditive);
      EXPECT_EQ(begin.tile, static_cast<std::uint32_t>(tile));
      std::size_t at = 0;  // nearest first: a record's Gaussian is that of the previous record, or one behind it
      std::uint64_t here = 0;
      const cmodel::EllipseRecord* before = nullptr;
      for (const cmodel::Record& record : all) {
        const auto* const ellipse = std::get_if<cmodel::EllipseRecord>(&record);
        if (ellipse == nullptr) continue;
        EXPECT_EQ(ellipse->tag, here++);
        const auto is = [&](const scene::ProjectedGaussian& splat) {
          const Words words = words_of(splat, description.cutoff, config);
          bright += *std::ranges::max_element(words.colour) > 1 << config.colour_frac_bits ? 1 : 0;
          const std::array<std::int64_t, 4> colour{ellipse->colour[0], ellipse->colour[1], ellipse->colour[2],
                                                   ellipse->colour[3]};
          return ellipse->x + begin.x * 256 == words.x && ellipse->y + begin.y * 256 == words.y &&
                 colour == words.colour && ellipse->shape.a == words.a && ellipse->shape.b == words.b &&
                 ellipse->shape.c == words.c && ellipse->shape.shift == words.h;
        };
        std::size_t found = at;
        while (found < projected.size() && !is(projected[found])) ++found;
        if (found == projected.size()) {
          ++different;
          continue;
        }
        in_tiles += before == nullptr || found != at ? 1 : 0;
        at = found;
        before = ellipse;
      }
      EXPECT_EQ(report.records, here);
      records += here;
      if (here > 0) {
        EXPECT_EQ(std::get<cmodel::EndSheet>(all[all.size() - 2]).splats, here);
      }
      EXPECT_EQ(std::get<cmodel::EndTile>(all.back()).sheets, here > 0 ? 1U : 0U);
    }
  }
  figure("records", static_cast<double>(records));
  figure("Gaussians in tiles", static_cast<double>(in_tiles));
  figure("records that are not the page's, or not in order", static_cast<double>(different));
  EXPECT_GT(records, 3000U);
  EXPECT_EQ(different, 0U);
  EXPECT_GT(bright, 0U);
}

}  // namespace
}  // namespace fastsplat::driver
