// SPDX-License-Identifier: Apache-2.0
// Whole frames of every kind of index: independence of tiles and units, kinds that must agree, and golden, within
// bounds derived for each pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "driver/config/config_file.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/driver/oracle/given.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

using cmodel::IndexKind;
using test::name_of;

constexpr IndexKind kKinds[] = {IndexKind::Linear, IndexKind::Squared, IndexKind::SquaredElliptic,
                                IndexKind::Blit2d, IndexKind::Rlut,    IndexKind::Separable};

/// base with a kind; for blit2d with as many phases as its tables can hold.
cmodel::Config base_of(IndexKind kind) {
  auto config = load_config("base");
  config.index_kind = static_cast<int>(kind);
  if (kind == IndexKind::Blit2d) config.phases = 16;
  EXPECT_FALSE(cmodel::first_violation(config)) << name_of(kind);
  return config;
}

class FamilyFrames : public ::testing::TestWithParam<IndexKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, FamilyFrames, ::testing::ValuesIn(kKinds),
                         [](const auto& param_info) { return name_of(param_info.param); });

TEST_P(FamilyFrames, TilesAndUnitsDoNotMatter) {
  std::uint64_t compared = 0, fast = 0;
  for (const auto method : {scene::Method::ImageAligned, scene::Method::XRay}) {
    for (const auto projection : {scene::Projection::Orthographic, scene::Projection::Perspective}) {
      auto description = view_of("shells:12", 70);
      description.method = method;
      description.camera.projection = projection;
      const auto scene = scene::build_scene(description);
      auto config = base_of(GetParam());
      config.rlut_sets = 4;
      config.position_frac_bits = 4;  // as many phases as the footprints of every frame need
      config.phases = 8;
      config.tile_width = config.tile_height = 72;
      const auto whole = render(scene, config, {.unit = Unit::Plain});
      ASSERT_EQ(whole.report.tiles, 1U);
      for (const auto& [width, height] : {std::pair{16, 24}, {64, 8}, {72, 72}}) {
        config.tile_width = width, config.tile_height = height;
        const auto tiled = render(scene, config, {.unit = Unit::Plain}), drawn = render(scene, config);
        EXPECT_EQ(difference(whole.frame, tiled.frame).different, 0U) << width << " x " << height;
        EXPECT_EQ(difference(tiled.frame, drawn.frame).different, 0U) << width << " x " << height << ", fast unit";
        EXPECT_TRUE(tiled.counters == drawn.counters) << width << " x " << height;
        compared += difference(whole.frame, drawn.frame).compared;
        fast += drawn.units.fast;
      }
    }
  }
  figure("words compared", static_cast<double>(compared));
  figure("tiles drawn by the fast unit", static_cast<double>(fast));
  EXPECT_GT(fast, 0U);
}

scene::Scene xray_of(const char* volume, int size) {
  auto description = view_of(volume, size);
  description.method = scene::Method::XRay;
  description.camera.azimuth = 33.0, description.camera.elevation = 21.0;
  return scene::build_scene(description);
}

TEST(FamilyPairs, ACircleIsAnEllipseAndAnImageItsMirrorImage) {
  const auto scene = xray_of("shells:16", 90);
  const auto squared = render(scene, base_of(IndexKind::Squared));
  const auto elliptic = render(scene, base_of(IndexKind::SquaredElliptic));
  auto config = base_of(IndexKind::Blit2d);
  const auto all = render(scene, config);
  config.index_symmetry = static_cast<int>(cmodel::IndexSymmetry::Eightfold);
  const auto once = render(scene, config);
  EXPECT_EQ(difference(squared.frame, elliptic.frame).different, 0U);
  EXPECT_EQ(difference(all.frame, once.frame).different, 0U);
  EXPECT_TRUE(squared.counters == elliptic.counters);
  EXPECT_TRUE(all.counters == once.counters);
  figure("words compared", static_cast<double>(2 * squared.frame.words.size()));
}

/// The largest error of a kind's weight from F at the true place, in units of the peak.
struct WeightBound {
  double anywhere = 0.0;  ///< within the support
  double rim = 0.0;       ///< in addition, near the rim: inside for one, outside for the other
  double shift = 0.0;     ///< of the centre, pixels
  bool square = false;    ///< support
};

/// From numerics.md alone; F(u) = exp(-a R^2 u), u = (distance / r)^2. Slopes: |dF/du| <= a R^2, |dF/d distance| <=
/// sqrt(2 a / e) R / r.
WeightBound bound_of(const cmodel::Config& config, double a, double R, double r) {
  const double by_u = a * R * R, by_distance = std::sqrt(2.0 * a / std::numbers::e) * R / r;
  const double N = config.radial_entries, ulp = std::ldexp(1.0, -config.radial_frac_bits);
  const double guard = std::ldexp(1.0, -config.rlut_guard_bits), K = config.grid();
  WeightBound bound;
  // A centre is rounded once, by half a step of its grid on each axis.
  bound.shift = std::sqrt(0.5) / K;
  bound.anywhere = bound.shift * by_distance;
  bound.rim = std::exp(-by_u);
  switch (config.index()) {
    case IndexKind::Rlut:  // half an entry; two words rounded to half of 2^-g entries; an entry to one ulp
      bound.anywhere += by_u * (0.5 + guard) / N + ulp;
      break;
    case IndexKind::Squared:
    case IndexKind::SquaredElliptic:  // half an entry; the scale, 2^-23 of the whole table
      bound.anywhere += by_u * (0.5 / N + 0x1p-23) + ulp;
      break;
    case IndexKind::Linear:  // half an entry of the distance; the root 2^-g/K pixel; the scale
      bound.anywhere += by_distance * r * (0.5 / N + 0x1p-23) + by_distance * guard / K + ulp;
      break;
    case IndexKind::Blit2d:
      bound.anywhere += ulp / 2.0;
      break;
    case IndexKind::Separable:  // two words with g bits more, and the product
      bound.anywhere += ulp / 2.0 + ulp * guard;
      bound.square = true;
      break;
  }
  return bound;
}

/// Every pixel of an X-ray against golden's: the error bounds of all splats over it are added up.
TEST_P(FamilyFrames, XRayIsGoldensWithinTheBoundOfEachPixel) {
  const auto scene = xray_of("shells:16", 90);
  auto config = base_of(GetParam());
  config.pixel_int_bits = config.sheet_int_bits, config.pixel_frac_bits = config.sheet_frac_bits;
  config.rounding_carry = static_cast<int>(cmodel::Carry::Off);
  const auto given = scene_oracle::given_by(scene, config);
  const Image truth = golden::render(scene), made = to_image(render(scene, config).frame);
  const double peak = given.a / (std::numbers::pi * (1.0 - std::exp(-given.a * given.R * given.R)));
  const double amplitude = peak * given.cx * given.cy * given.cz * scene.xray_scale;
  const double r = given.R * given.u * given.scale_at_corner[0];  // orthographic: of all
  const WeightBound weight = bound_of(config, given.a, given.R, r);
  // A colour word is rounded to half of 2^-cf, a product to half of 2^-sf; a product that vanishes is less than half a
  // word.
  const double words = std::ldexp(0.5, -config.colour_frac_bits) + std::ldexp(0.5, -config.sheet_frac_bits);
  const double reach = r + weight.shift, least = r - weight.shift - 1.0 / config.grid();
  std::vector<double> bound(static_cast<std::size_t>(given.width) * static_cast<std::size_t>(given.height), 0.0);
  for (const auto& splat : given.splats) {
    const double v = splat.e[3] * amplitude;
    for (int y = std::max(0, static_cast<int>(splat.y - reach - 1)); y < given.height && y <= splat.y + reach + 1; ++y)
      for (int x = std::max(0, static_cast<int>(splat.x - reach - 1)); x < given.width && x <= splat.x + reach + 1;
           ++x) {
        const double dx = std::abs(x - splat.x), dy = std::abs(y - splat.y), d = std::hypot(dx, dy);
        if (weight.square ? std::max(dx, dy) > reach : d > reach) continue;
        const bool disc = d < reach;
        bound[static_cast<std::size_t>(y) * static_cast<std::size_t>(given.width) + static_cast<std::size_t>(x)] +=
            words +
            v * ((disc ? weight.anywhere : std::ldexp(1.0, -config.radial_frac_bits)) + (d > least ? weight.rim : 0.0));
      }
  }
  double largest = 0.0, share = 0.0, allowed = 0.0;
  std::size_t beyond = 0, lit = 0;
  for (std::size_t i = 0; i < bound.size(); ++i) {
    const double apart = std::abs(static_cast<double>(made.data[4 * i + 3]) - truth.data[4 * i + 3]);
    // Golden adds in float: as many half ulps as it has splats, far less than a word.
    const double most = bound[i] + 1e-5;
    beyond += apart > most ? 1 : 0;
    lit += truth.data[4 * i + 3] > 0.0F ? 1 : 0;
    largest = std::max(largest, apart);
    allowed = std::max(allowed, most);
    share = std::max(share, apart / most);
  }
  figure("pixels lit", static_cast<double>(lit));
  figure("pixels beyond their bound (limit 0)", static_cast<double>(beyond));
  figure("largest error", largest * 255.0, "LSB8");
  figure("largest bound", allowed * 255.0, "LSB8");
  figure("largest share of a bound", share);
  EXPECT_EQ(beyond, 0U);
  EXPECT_GT(lit, 1000U);
  EXPECT_GT(share, 0.01) << "the bound says nothing";
}

// At their finest, squared and rlut are the same device: their centres lie on one grid. Their entries differ by one if
// q is next to a step, which is one word of the table's slope.
TEST(FamilyPairs, SquaredIsRlutOfAsManyPhasesAsPositionsHave) {
  const auto scene = xray_of("shells:16", 90);
  auto rlut = base_of(IndexKind::Rlut);
  rlut.rounding_carry = static_cast<int>(cmodel::Carry::Off);
  rlut.pixel_int_bits = rlut.sheet_int_bits, rlut.pixel_frac_bits = rlut.sheet_frac_bits;
  ASSERT_EQ(rlut.phases, 1 << rlut.position_frac_bits);
  auto squared = rlut;
  squared.index_kind = static_cast<int>(IndexKind::Squared);
  const auto given = scene_oracle::given_by(scene, rlut);
  const double peak = given.a / (std::numbers::pi * (1.0 - std::exp(-given.a * given.R * given.R)));
  const double amplitude = peak * given.cx * given.cy * given.cz * scene.xray_scale;
  const double r = given.R * given.u * given.scale_at_corner[0];
  // One entry further: the slope of F, and a word of rounding each; the difference at the rim is smaller than that.
  const double step = given.a * given.R * given.R / rlut.radial_entries + std::ldexp(2.0, -rlut.radial_frac_bits);
  ASSERT_GT(step, std::exp(-given.a * given.R * given.R));
  const auto a = to_image(render(scene, rlut).frame), b = to_image(render(scene, squared).frame);
  std::vector<double> bound(a.data.size() / 4, 0.0);
  for (const auto& splat : given.splats)
    for (int y = 0; y < given.height; ++y)
      for (int x = 0; x < given.width; ++x)
        if (std::hypot(x - splat.x, y - splat.y) < r + 1.0)
          bound[static_cast<std::size_t>(y) * static_cast<std::size_t>(given.width) + static_cast<std::size_t>(x)] +=
              splat.e[3] * amplitude * step + std::ldexp(1.0, -rlut.sheet_frac_bits);
  double largest = 0.0, share = 0.0;
  std::size_t different = 0;
  for (std::size_t i = 0; i < bound.size(); ++i) {
    const double apart = std::abs(static_cast<double>(a.data[4 * i + 3]) - b.data[4 * i + 3]);
    EXPECT_LE(apart, bound[i] + std::ldexp(1.0, -rlut.colour_frac_bits)) << "pixel " << i;
    different += apart > 0.0 ? 1 : 0;
    largest = std::max(largest, apart);
    if (bound[i] > 0.0) share = std::max(share, apart / bound[i]);
  }
  figure("pixels that differ", static_cast<double>(different));
  figure("largest difference", largest * 255.0, "LSB8");
  figure("largest share of the bound", share);
  EXPECT_GT(different, 0U) << "they round differently";
}

}  // namespace
}  // namespace fastsplat::driver
