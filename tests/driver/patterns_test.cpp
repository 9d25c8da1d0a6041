// SPDX-License-Identifier: Apache-2.0
// Solid textures and bumps on the device: the table against the pattern, pictures against golden's, patterns without
// effect, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "cmodel/classify/pattern_unit.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tables/pattern_tables.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "golden/sheet_geometry.hpp"
#include "tests/driver/scenes_helper.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::driver {
namespace {

using scene::SceneDescription, scene::SolidKind, scene::TextureWhere;

/// A lit smooth volume, 24 voxels wide, classified by pixel.
SceneDescription post_view(int size = 64) {
  auto description = view_of("marschner-lobb:24", size, "ct-head");
  description.classify = scene::ClassifyOrder::Post;
  description.camera.azimuth = 31, description.camera.elevation = 20;
  description.shading = 1;
  return description;
}

SceneDescription with_texture(SceneDescription description, SolidKind kind, double scale, double amplitude = 1.0) {
  description.texture = {kind, TextureWhere::Pixel, scale, amplitude};
  return description;
}

SceneDescription with_bumps(SceneDescription description, SolidKind kind, double scale, double amplitude) {
  description.bump = {kind, scale, amplitude};
  return description;
}

cmodel::Config with_nodes(const std::string& name, int node_bits) {
  auto config = load_config(name);
  config.classify_segment_bits = 9;
  config.pattern_node_bits = node_bits;
  EXPECT_FALSE(cmodel::first_violation(config));
  return config;
}

cmodel::PatternUnit loaded(const cmodel::Config& config, const scene::Scene& scene) {
  cmodel::PatternUnit unit(config);
  for (const cmodel::LoadTable& table : pattern_tables(config, scene, plan_for_device(scene).slabs, 1))
    unit.load(table.table, table.words);
  return unit;
}

/// Frames and their distance; the golden one is neither dark nor equal to that without the pattern.
Lsb8 measure(const SceneDescription& description, const cmodel::Config& config, const std::string& what) {
  const auto scene = scene::build_scene(description);
  const Image reference = golden::render(scene);
  auto plain = description;
  plain.texture.kind = plain.bump.kind = SolidKind::None;
  EXPECT_GT(distance(reference, golden::render(scene::build_scene(plain))).largest, 20.0) << "a pattern that shows";
  const Lsb8 apart = distance(reference, to_image(render(scene, config).frame));
  figure(what + ": PSNR", apart.psnr_db, "dB");
  figure(what + ": max", apart.largest, "LSB8");
  return apart;
}

// N-8-101, N-8-103. Stripes of period L across nodes h apart lie within h^2 |f''| / 12 <= (2 pi h / L)^2 / 24 of the
// lines. Here h is along the stripes' direction, which three axes share. The second differences that level the nodes
// differ from the second derivatives by 1/12 (2 pi h / L)^2 of them. N-8-96, N-8-97: the tables of densities follow
// those of the radius sets, those of patterns all others.
TEST(PatternTables, ComeInTheirOrder) {
  for (const bool lit : {false, true}) {
    const auto view = post_view();
    const auto description =
        lit ? with_bumps(with_texture(view, SolidKind::Marble, 8.0), SolidKind::Noise, 8.0, 0.2) : view;
    const CompiledFrame frame(scene::build_scene(description), with_nodes("base", 4));
    const auto beats = frame.preamble();
    std::vector<std::int64_t> order;
    for (std::size_t at = 0; at < beats.size(); at += 1 + cmodel::announced_beats(beats[at])) {
      if (static_cast<cmodel::Opcode>(get(beats[at], cmodel::layout::kOpcode)) != cmodel::Opcode::LoadTable) continue;
      const std::int64_t table = get(beats[at], cmodel::layout::kTableId);
      if (order.empty() || table != 0 || order.back() != 0) order.push_back(table);  // consecutive sets count once
    }
    std::vector<std::int64_t> expected{1, 2, 0, 3, 4, 5, 6, 7};
    if (lit) expected.insert(expected.end(), {8, 9});
    EXPECT_EQ(order, expected);
    std::printf("[figure] tables in their order = %zu\n", order.size());
  }
}

TEST(PatternTables, StripesAreAsNearAsTheirNodesAllow) {
  for (const bool perspective : {false, true}) {
    auto description = with_texture(post_view(300), SolidKind::Stripes, 6.0);
    if (perspective) description.camera.projection = scene::Projection::Perspective;
    const auto scene = scene::build_scene(description);
    for (const int bits : {4, 5, 6}) {
      const auto config = with_nodes("base", bits);
      const auto tables = pattern_tables(config, scene, plan_for_device(scene).slabs, 1);
      const auto& words = tables[1].words;
      const auto unit = loaded(config, scene);
      const golden::SheetGeometry geometry(scene);
      const double last = (1 << bits) - 1;
      double worst = 0.0, allowed = 0.0;
      int compared = 0;
      const auto far = [&](std::size_t axis) { return words[axis] + last / std::ldexp(words[3 + axis], -24); };
      const auto node = [&](std::size_t axis) { return 1.0 / std::ldexp(words[3 + axis], -24); };
      // Distance of a node from every side, beyond which nodes are levelled.
      for (double z = words[2] + node(2); z <= far(2) - node(2); z += 1.0)
        for (double y = words[1] + node(1); y <= far(1) - node(1); y += 3.0)
          for (double x = words[0] + node(0); x <= far(0) - node(0); x += 3.0, ++compared) {
            const int X = static_cast<int>(x), Y = static_cast<int>(y), s = static_cast<int>(z);
            const glm::dvec3 place = geometry.position(X, Y, s);
            const double steps[] = {geometry.position(X + node(0), Y, s).x - place.x,
                                    geometry.position(X, Y + node(1), s).x - place.x,
                                    geometry.position(X, Y, s + 1).x * node(2) - place.x * node(2)};
            double share = 0.0;
            for (std::size_t axis = 0; axis < 3; ++axis) {
              if (words[3 + axis] == 1U << 24) continue;  // nodes at pixels
              const double bend = std::pow(2.0 * std::numbers::pi * steps[axis] / 6.0, 2.0);
              share += bend / 24.0 * (1.0 + bend / 2.0);
            }
            const double want = scene::tint(description.texture, place).r;
            const double got = std::ldexp(static_cast<double>(unit({.x = X, .y = Y, .sheet = s}).tint[0]), -16);
            worst = std::max(worst, std::abs(got - want));
            allowed = std::max(allowed, share * 0.8 + 5.0 / 65536);
            EXPECT_LE(std::abs(got - want), share * 0.8 + 5.0 / 65536);
          }
      const std::string name = std::to_string(1 << bits) + (perspective ? " nodes, perspective" : " nodes");
      figure(name + ": farthest from the tint", worst, "of " + std::to_string(allowed) + " allowed");
      EXPECT_GT(compared, 5000);
      EXPECT_GT(worst, allowed / 20);
    }
  }
}

// N-8-98, N-8-99, N-8-100: the nodes enclose all that is visible, and little else: a kernel's radius to each side, and
// a tenth of the values.
TEST(PatternTables, NodesLieWhereSomethingIsSeen) {
  for (const auto order : {scene::ClassifyOrder::Post, scene::ClassifyOrder::Pre}) {
    for (const bool perspective : {false, true}) {
      auto description = with_texture(post_view(100), SolidKind::Marble, 6.0);
      description.volume = "shells:24";
      description.classify = order;
      description.camera.zoom = 0.7;
      if (perspective) description.camera.projection = scene::Projection::Perspective;
      const auto scene = scene::build_scene(description);
      const auto words = pattern_tables(with_nodes("base", 3), scene, plan_for_device(scene).slabs, 1)[1].words;
      const Image picture = golden::render(scene);
      glm::dvec2 first(100.0), last(0.0);
      for (int y = 0; y < 100; ++y) {
        for (int x = 0; x < 100; ++x) {
          if (!(picture.data[static_cast<std::size_t>(4 * (y * 100 + x) + 3)] > 0.0F)) continue;
          first = glm::min(first, glm::dvec2(x, y));
          last = glm::max(last, glm::dvec2(x, y));
        }
      }
      ASSERT_LT(first.x + 20.0, last.x) << "something is seen";
      EXPECT_GT(first.x, 10.0) << "and not everywhere";
      const double reach = 3.0 * scene.kernel.radius() * scene.volume->kernel_unit() * scene.camera.scale_at(0.0);
      for (int axis = 0; axis < 2; ++axis) {
        const double begin = words[static_cast<std::size_t>(axis)];
        const double end = begin + 7.0 / std::ldexp(words[static_cast<std::size_t>(3 + axis)], -24);
        EXPECT_LE(begin, first[axis]);
        EXPECT_GE(begin, first[axis] - reach);
        EXPECT_GE(end, last[axis] - 1e-3);
        EXPECT_LE(end, last[axis] + reach);
      }
    }
  }
}

// N-8-98, N-8-99: an invisible haze fills the volume, with a visible cube in its middle: nodes lie around the cube.
// Each side has one more column, because places are rounded outwards.
TEST(PatternTables, NodesLieAroundTheVisibleInAHaze) {
  auto description = with_texture(post_view(100), SolidKind::Marble, 6.0);
  auto scene = scene::build_scene(description,
                                  std::make_shared<const volume::Volume>(volume::make_volume(
                                      glm::ivec3(24), glm::dvec3(1.0), volume::VoxelType::U8, [](int i, int j, int k) {
                                        const bool cube = std::min({i, j, k}) >= 9 && std::max({i, j, k}) < 15;
                                        return cube ? 200 : i + j + k == 0 ? 0 : 50;
                                      })));
  scene.transfer_function.domain = scene::Domain::Range;
  scene.transfer_function.points = {
      {0.0, glm::dvec3(1.0), 0.0}, {0.5, glm::dvec3(1.0), 0.0}, {1.0, glm::dvec3(1.0), 0.9}};
  const auto words = pattern_tables(with_nodes("base", 3), scene, plan_for_device(scene).slabs, 1)[1].words;
  glm::dvec2 low(100.0), high(0.0);
  for (int corner = 0; corner < 8; ++corner) {
    const auto at = scene.camera.project(
        scene.volume->position((corner & 1) != 0 ? 14 : 9, (corner & 2) != 0 ? 14 : 9, (corner & 4) != 0 ? 14 : 9));
    const double reach = scene.kernel.radius() * scene.volume->kernel_unit() * at.scale;
    low = glm::min(low, glm::dvec2(at.x, at.y) - reach);
    high = glm::max(high, glm::dvec2(at.x, at.y) + reach);
  }
  for (int axis = 0; axis < 2; ++axis) {
    const double begin = words[static_cast<std::size_t>(axis)];
    const double end = begin + 7.0 / std::ldexp(words[static_cast<std::size_t>(3 + axis)], -24);
    figure("columns or rows from " + std::to_string(low[axis]) + " to " + std::to_string(high[axis]) + ": nodes from",
           begin, "to " + std::to_string(end));
    EXPECT_LE(begin, low[axis]);
    EXPECT_GT(begin, low[axis] - 1.0);
    EXPECT_GE(end, high[axis] - 1e-3);
    EXPECT_LT(end, high[axis] + 1.0);
  }
}

// N-8-101 to N-8-104: nodes are levelled between others. Those at the ends lack a neighbour, so the corners are the
// pattern itself, at the place of the node (N-8-102).
TEST(PatternTables, NodesAtTheCornersAreThePattern) {
  const auto description = with_texture(post_view(300), SolidKind::Stripes, 6.0);
  const auto scene = scene::build_scene(description);
  const auto tables = pattern_tables(with_nodes("base", 6), scene, plan_for_device(scene).slabs, 1);
  const auto &nodes = tables[0].words, &words = tables[1].words;
  const golden::SheetGeometry geometry(scene);
  const auto place = [&](std::size_t axis, int node) {
    return words[axis] + node / std::ldexp(static_cast<double>(words[3 + axis]), -24);
  };
  ASSERT_LT(words[3], 1U << 24) << "nodes are farther apart than pixels";
  ASSERT_LT(words[4], 1U << 24);
  ASSERT_EQ(words[5], 1U << 24) << "and a sheet each";
  int compared = 0, bright = 0;
  double farthest = 0.0;
  for (const int k : {0, 10, 20, 31, 63}) {
    for (const int j : {0, 63}) {
      for (const int i : {0, 63}) {
        const glm::dvec3 at = geometry.position(place(0, i), place(1, j), static_cast<int>(words[2]) + k);
        const double want = std::min(65536.0 * scene::solid_field(SolidKind::Stripes, at / 6.0), 65535.0);
        const double got = nodes[static_cast<std::size_t>(2 * ((k * 64 + j) * 64 + i))] & 0xFFFFU;
        // The nearest word, for a place that was computed in another order.
        farthest = std::max(farthest, std::abs(got - want));
        bright += got > 32768.0 ? 1 : 0;
        ++compared;
      }
    }
  }
  figure("corners compared", compared);
  figure("farthest from the pattern", farthest, "words (limit 0.501)");
  EXPECT_LE(farthest, 0.501);
  EXPECT_GT(bright, 2) << "not all of one colour";
  EXPECT_LT(bright, compared - 2);
}

// As many nodes as pixels along the picture's sides: the remaining errors are nodes between sheets, and words.
TEST(PatternsOnDevice, TexturesAreWithin60DbOfGoldens) {
  EXPECT_GE(measure(with_texture(post_view(), SolidKind::Marble, 6.0), with_nodes("fine", 6), "marble").psnr_db, 60.0);
  EXPECT_GE(measure(with_texture(post_view(), SolidKind::Wood, 3.0), with_nodes("fine", 6), "wood").psnr_db, 60.0);
  auto near = with_texture(post_view(), SolidKind::Noise, 3.0);
  near.camera.projection = scene::Projection::Perspective;
  near.footprint.shape = scene::FootprintShape::Ellipse;
  auto config = with_nodes("fine", 6);
  config.ellipse_frac_bits = 12;
  EXPECT_GE(measure(near, config, "noise, perspective").psnr_db, 60.0);
}

// N-8-101, N-8-104: B and A.
TEST(PatternsOnDevice, BumpsAreWithin60DbOfGoldens) {
  EXPECT_GE(measure(with_bumps(post_view(), SolidKind::Stripes, 6.0, 0.3), with_nodes("fine", 6), "stripes").psnr_db,
            60.0);
  EXPECT_GE(measure(with_bumps(post_view(), SolidKind::Noise, 8.0, 0.6), with_nodes("fine", 6), "noise").psnr_db, 60.0);
  const auto both = with_bumps(with_texture(post_view(), SolidKind::Marble, 6.0), SolidKind::Wood, 6.0, 0.15);
  EXPECT_GE(measure(both, with_nodes("fine", 6), "marble, raised as wood").psnr_db, 60.0);
}

// N-8-105: colours, classified before splatting: sheets are tinted. The plain unit draws them, and reports why.
TEST(PatternsOnDevice, SheetsOfColoursAreTinted) {
  auto description = with_texture(post_view(), SolidKind::Marble, 6.0);
  description.classify = scene::ClassifyOrder::Pre;
  auto config = load_config("base");
  config.pattern_node_bits = 6;
  EXPECT_GE(measure(description, config, "marble on colours").psnr_db, 60.0);
  const auto drawn = render(scene::build_scene(description), config);
  ASSERT_NE(drawn.units.why_plain, nullptr);
  EXPECT_STREQ(drawn.units.why_plain, "sheets are tinted by a pattern");
}

// N-6.3-13
TEST(PatternsOnDevice, AmplitudeZeroChangesNoBit) {
  const auto same = [](const SceneDescription& off, const SceneDescription& zero, const cmodel::Config& with) {
    auto without = with;
    without.pattern_node_bits = 0;
    const WordDifference apart =
        difference(render(scene::build_scene(off), without).frame, render(scene::build_scene(zero), with).frame);
    EXPECT_GT(apart.compared, 10000u);
    EXPECT_EQ(apart.different, 0u);
    EXPECT_EQ(difference(render(scene::build_scene(off), without).frame, render(scene::build_scene(off), with).frame)
                  .different,
              0u)
        << "the key alone";
  };
  for (const char* name : {"base", "fine"}) {
    const auto config = with_nodes(name, 4);
    same(post_view(), with_texture(post_view(), SolidKind::Wood, 5.0, 0.0), config);
    same(post_view(), with_bumps(post_view(), SolidKind::Noise, 5.0, 0.0), config);
  }
  auto colours = post_view();
  colours.classify = scene::ClassifyOrder::Pre;
  same(colours, with_texture(colours, SolidKind::Marble, 5.0, 0.0), with_nodes("base", 4));
}

TEST(PatternsOnDevice, TilesNeverShow) {
  auto description = with_bumps(with_texture(post_view(60), SolidKind::Wood, 3.0), SolidKind::Noise, 5.0, 0.5);
  auto config = with_nodes("base", 5);
  config.tile_width = config.tile_height = 64;
  expect_tiles_never_show(description, config);
  description.classify = scene::ClassifyOrder::Pre;
  description.bump.kind = SolidKind::None;
  expect_tiles_never_show(description, config);
}

TEST(PatternsOnDevice, ThreadsAndUnitsDrawTheSame) {
  const auto scene =
      scene::build_scene(with_bumps(with_texture(post_view(), SolidKind::Marble, 4.0), SolidKind::Wood, 5.0, 0.2));
  const auto config = with_nodes("base", 5);
  const auto tables = [&](int threads) { return pattern_tables(config, scene, plan_for_device(scene).slabs, threads); };
  const auto one = tables(1), three = tables(3);
  ASSERT_EQ(one.size(), 2u);  // N-6.3-1
  EXPECT_EQ(one[0].words.size(), 2u * 32 * 32 * 32);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(one[i].words, three[i].words);
  const auto fast = render(scene, config, {.threads = 1}), several = render(scene, config, {.threads = 3}),
             plain = render(scene, config, {.unit = Unit::Plain});
  EXPECT_EQ(difference(fast.frame, several.frame).different, 0u);
  EXPECT_EQ(difference(fast.frame, plain.frame).different, 0u);
  EXPECT_EQ(fast.counters, plain.counters);
  EXPECT_GT(fast.units.fast, 0u) << "where it has vectors";
}

TEST(PatternsOnDevice, UnsupportedPatternsAreRefused) {
  const auto refused = [](const SceneDescription& description, const cmodel::Config& config) -> std::string {
    try {
      CompiledFrame(scene::build_scene(description), config);
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      return error.what();
    }
    return "";
  };
  auto config = with_nodes("base", 4);
  const auto texture = with_texture(post_view(24), SolidKind::Wood, 5.0),
             bumps = with_bumps(post_view(24), SolidKind::Wood, 5.0, 0.2);
  EXPECT_EQ(refused(texture, config), "");
  EXPECT_EQ(refused(bumps, config), "");
  config.pattern_node_bits = 0;
  using testing::AllOf, testing::HasSubstr, testing::StartsWith;
  EXPECT_THAT(refused(texture, config), AllOf(StartsWith("texture.where"), HasSubstr("set pattern.node_bits = 7")));
  EXPECT_THAT(refused(bumps, config), AllOf(StartsWith("bump.kind"), HasSubstr("set pattern.node_bits = 7")));
}

// An empty picture shows nothing: its nodes are at places that exist.
TEST(PatternsOnDevice, NothingToBeSeenIsDrawn) {
  auto description = with_texture(post_view(24), SolidKind::Wood, 5.0);
  auto scene = scene::build_scene(description);
  for (auto& point : scene.transfer_function.points) point.opacity = 0.0;
  const auto drawn = render(scene, with_nodes("base", 3));
  for (const std::uint32_t word : drawn.frame.words) EXPECT_EQ(word, 0u);
}

}  // namespace
}  // namespace fastsplat::driver
