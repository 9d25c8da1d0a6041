// SPDX-License-Identifier: Apache-2.0
// If the fast unit was requested and could not draw, the report gives the reason; else it gives none.
#include <gtest/gtest.h>

#include <string>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

/// "" for none.
std::string why_plain(const cmodel::Config& config, Unit unit = Unit::Fast) {
  const auto scene = scene::build_scene(view_of("shells:12", 24));
  const auto units = render(scene, config, {.threads = 1, .unit = unit, .progress = {}}).units;
  EXPECT_EQ(units.why_plain != nullptr, unit == Unit::Fast && units.fast == 0 && units.redone == 0);
  return units.why_plain == nullptr ? "" : units.why_plain;
}

TEST(WhyPlain, SaysWhichNumbersOfTheConfiguration) {
  const auto base = load_config("base");
  if (!why_plain(base).empty()) GTEST_SKIP() << "no vectors here: " << why_plain(base);
  EXPECT_EQ(why_plain(base, Unit::Plain), "");

  auto even = base;
  even.rounding_product = 2;
  EXPECT_EQ(cmodel::find_key("rounding.product")->names[2], std::string("rnd_conv"));
  EXPECT_NE(why_plain(even).find("rounded to even"), std::string::npos) << why_plain(even);

  auto wide = base;
  wide.colour_frac_bits = 20;
  EXPECT_NE(why_plain(wide).find("too wide for the vector lanes"), std::string::npos) << why_plain(wide);

  // A footprint of 8 x 8 pixels at 1024 x 1024 places is 128 MB.
  auto fine = base;
  fine.index_kind = static_cast<int>(cmodel::IndexKind::Squared);
  fine.phases = 1;
  fine.position_frac_bits = 10;
  EXPECT_NE(why_plain(fine).find("exceed its memory"), std::string::npos) << why_plain(fine);
  auto perspective = view_of("shells:12", 24);
  perspective.camera.projection = scene::Projection::Perspective;
  perspective.footprint.shape = scene::FootprintShape::Ellipse;
  auto culling = load_config("ellipse");
  const auto shaped = [&] {
    const auto units = render(scene::build_scene(perspective), culling, {.threads = 1}).units;
    return std::string(units.why_plain == nullptr ? "" : units.why_plain);
  };
  EXPECT_EQ(shaped(), "");
  culling.cull_map = static_cast<int>(cmodel::CullMap::Block);
  EXPECT_NE(shaped().find("the device culls them"), std::string::npos) << shaped();

  perspective.method = scene::Method::Westover;
  culling = load_config("ellipse");
  culling.composite_every_sample = 1;
  EXPECT_EQ(shaped(), "");
  culling.rounding_light = 2;
  EXPECT_NE(shaped().find("samples are rounded to even"), std::string::npos) << shaped();
  culling.rounding_light = 1;
  culling.composite_frac_bits = 18;
  EXPECT_NE(shaped().find("too wide for the sample lanes"), std::string::npos) << shaped();
  figure("reasons printed", 6);
}

}  // namespace
}  // namespace fastsplat::driver
