// SPDX-License-Identifier: Apache-2.0
// Whole pictures by the plain and the fast code: the same floats, over methods, views, kernels, techniques and numbers
// of threads, thin and opaque.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "golden/collect_splats.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::Method;

/// Totals of the comparisons.
struct Tally {
  std::size_t pictures = 0, floats = 0, differing = 0;
  std::uint64_t footprints = 0, hidden = 0;
};

void compare(const scene::Scene& scene, const std::string& what, Tally& tally) {
  const Image plain = render(scene, {.threads = 0, .progress = {}, .report = nullptr, .plain = true});
  ASSERT_GT(max_opacity(plain), 0.0) << what;
  for (const int threads : {1, 3}) {
    RenderReport report;
    const Image fast = render(scene, {.threads = threads, .progress = {}, .report = &report});
    ASSERT_EQ(plain.data.size(), fast.data.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < plain.data.size(); ++i) {
      differing += std::bit_cast<std::uint32_t>(plain.data[i]) != std::bit_cast<std::uint32_t>(fast.data[i]);
    }
    EXPECT_EQ(differing, 0u) << what << ", " << threads << " threads";
    ++tally.pictures;
    tally.floats += plain.data.size(), tally.differing += differing;
    tally.footprints += report.footprints, tally.hidden += report.hidden_footprints;
  }
}

Lattice view() {
  Lattice lattice;
  lattice.dims = {22, 17, 26};
  lattice.azimuth = 35, lattice.elevation = 25, lattice.roll = 10;
  lattice.pixels_per_mm = 2.7;
  lattice.width = 83, lattice.height = 67;  // some of it lies outside the picture
  return lattice;
}

std::string name_of(const scene::Scene& scene, double depth) {
  return std::string(scene::to_string(scene.description.method)) + ", optical depth " + std::to_string(depth) +
         ", kernel " + std::to_string(scene.kernel.a()) + " " + std::to_string(scene.kernel.radius());
}

TEST(PlainAndFast, EveryMethodThinAndOpaque) {
  Tally tally;
  std::uint64_t hidden_by_method[5] = {};
  for (const double depth : {0.02, 0.9, 4.0, 60.0, 3000.0}) {
    for (const auto projection : {scene::Projection::Orthographic, scene::Projection::Perspective}) {
      for (const auto opacity : {scene::SlabOpacity::Exponential, scene::SlabOpacity::Additive}) {
        for (const auto& [a, radius] : std::initializer_list<std::pair<double, double>>{{2, 2}, {1.02, 3}, {6, 0.6}}) {
          Lattice lattice = view();
          lattice.optical_depth = depth, lattice.projection = projection, lattice.slab_opacity = opacity;
          lattice.a = a, lattice.radius = radius;
          lattice.xray_sheets = 5;
          scene::Scene scene = make_scene(lattice);
          for (const Method method : {Method::XRay, Method::Westover, Method::AxisAligned, Method::ImageAligned}) {
            scene.description.method = method;
            for (const double width : {0.4, 1.0, 3.0}) {
              if (method != Method::ImageAligned && width != 1.0) continue;
              scene.description.slab_width = width;
              const std::uint64_t before = tally.hidden;
              compare(scene, name_of(scene, depth), tally);
              hidden_by_method[static_cast<int>(method)] += tally.hidden - before;
            }
          }
        }
      }
    }
  }
  figure("pictures_equal_bit_for_bit", static_cast<double>(tally.pictures), "every one");
  figure("floats_equal_bit_for_bit", static_cast<double>(tally.floats - tally.differing), "every one");
  figure("share_of_footprints_hidden", static_cast<double>(tally.hidden) / static_cast<double>(tally.footprints),
         "more than 0.1");
  EXPECT_GT(tally.hidden, tally.footprints / 10);
  for (const Method method : {Method::Westover, Method::AxisAligned, Method::ImageAligned}) {
    EXPECT_GT(hidden_by_method[static_cast<int>(method)], 1000u) << scene::to_string(method);
  }
  EXPECT_EQ(hidden_by_method[static_cast<int>(Method::XRay)], 0u);  // every splat counts
}

TEST(PlainAndFast, EveryTechnique) {
  Tally tally;
  using D = scene::SceneDescription;
  const std::pair<const char*, void (*)(D&)> techniques[] = {
      {"plain", [](D&) {}},
      {"frozen", [](D& d) { d.culling.freeze = 0.05; }},
      {"culled", [](D& d) { d.culling = {.mode = scene::CullingMode::Splats, .freeze = 0.01}; }},
      {"culled in blocks", [](D& d) { d.culling = {.mode = scene::CullingMode::Blocks, .freeze = 0.01}; }},
      {"ellipses", [](D& d) { d.footprint.shape = scene::FootprintShape::Ellipse; }},
      {"antialiased", [](D& d) { d.footprint.antialias = true; }},
      {"textured splats", [](D& d) { d.footprint.texture = {.amplitude = 1.0}; }},
      {"moving",
       [](D& d) {
         d.motion = {{3.0, -2.0, 1.0}, 10.0};
       }},
      {"lens on splats",
       [](D& d) {
         d.lens = {scene::DepthOfField::Splats, 10.0, -4.0};
       }},
      {"lens on sheets",
       [](D& d) {
         d.lens = {scene::DepthOfField::Sheets, 10.0, -4.0};
       }},
      {"texture", [](D& d) { d.texture.kind = scene::SolidKind::Wood; }},
      {"post-classified", [](D& d) { d.classify = scene::ClassifyOrder::Post; }},
      {"all of them", [](D& d) {
         d.footprint = {.shape = scene::FootprintShape::Ellipse, .antialias = true, .texture = {.amplitude = 0.6}};
         d.motion = {{3.0, -2.0, 1.0}, 10.0};
         d.lens = {scene::DepthOfField::Splats, 10.0, -4.0};
       }}};
  for (const double depth : {0.5, 6.0, 200.0}) {
    for (const auto& [name, apply] : techniques) {
      Lattice lattice = view();
      lattice.projection = scene::Projection::Perspective;
      lattice.optical_depth = depth;
      scene::Scene scene = make_scene(lattice);
      apply(scene.description);
      compare(scene, std::string(name) + ", optical depth " + std::to_string(depth), tally);
    }
  }
  figure("pictures_equal_bit_for_bit", static_cast<double>(tally.pictures), "every one");
  figure("floats_equal_bit_for_bit", static_cast<double>(tally.floats - tally.differing), "every one");
  EXPECT_GT(tally.hidden, 0u);
}

// If a splat emits more than it hides, splats behind could still show at any opacity: none may be omitted.
TEST(PlainAndFast, BrighterThanOpaque) {
  Lattice lattice = view();
  const scene::Scene scene = make_scene(lattice);
  std::vector<scene::Splat> splats = random_splats(scene, 20000, 8.0, 7);
  for (std::size_t i = 0; i < splats.size(); i += 17) splats[i].emission *= 1e12f;
  std::size_t floats = 0;
  for (const auto technique : {westover, axis_aligned, image_aligned}) {
    RenderReport report;
    const Image plain = technique(scene, splats, {.threads = 1, .progress = {}, .report = nullptr, .plain = true});
    const Image fast = technique(scene, splats, {.threads = 1, .progress = {}, .report = &report});
    EXPECT_EQ(plain, fast);
    EXPECT_EQ(report.hidden_footprints, 0u);
    EXPECT_GT(report.footprints, 20000u);
    floats += plain.data.size();
  }
  figure("floats_equal_bit_for_bit", static_cast<double>(floats), "every one");
}

TEST(PlainAndFast, RaysThinAndOpaque) {
  Tally tally;
  for (const double depth : {0.02, 0.9, 6.0, 400.0}) {
    for (const auto projection : {scene::Projection::Orthographic, scene::Projection::Perspective}) {
      for (const auto& [a, radius] : std::initializer_list<std::pair<double, double>>{{2, 2}, {1.02, 3}, {6, 0.6}}) {
        for (const double end : {0.0, 1e-6, 0.3}) {
          Lattice lattice = view();
          lattice.dims = {14, 11, 30};
          lattice.width = 31, lattice.height = 27;
          lattice.pixels_per_mm = 1.3;
          lattice.optical_depth = depth, lattice.projection = projection;
          lattice.a = a, lattice.radius = radius;
          scene::Scene scene = make_scene(lattice);
          scene.description.method = Method::RayCast;
          scene.description.ray_end = end;
          compare(scene, name_of(scene, depth) + ", rays' end " + std::to_string(end), tally);
        }
      }
    }
  }
  figure("pictures_equal_bit_for_bit", static_cast<double>(tally.pictures), "every one");
  figure("floats_equal_bit_for_bit", static_cast<double>(tally.floats - tally.differing), "every one");
}

// A ray that ends when its transmittance is below e misses at most e of any channel.
TEST(PlainAndFast, ARayEndsByNoMoreThanItsEnd) {
  Lattice lattice = view();
  lattice.width = 41, lattice.height = 37, lattice.pixels_per_mm = 1.5;
  lattice.optical_depth = 1.5;
  scene::Scene scene = make_scene(lattice);
  const Image whole = ray_cast(scene, {});
  double before = 0.0;
  for (const double end : {1e-6, 1e-3, 0.1, 0.5}) {
    scene.description.ray_end = end;
    const double error = max_difference(whole, ray_cast(scene, {}));
    std::printf("rays end at %g: ", end);
    figure("largest_error", error, "at most their end, and a float's last bit");
    EXPECT_LE(error, end + 0x1p-24);
    EXPECT_GE(error, before);
    before = error;
  }
  EXPECT_GT(before, 0.01);
}

TEST(PlainAndFast, SplatsAreCollectedInTheirOrder) {
  std::size_t compared = 0;
  for (const double azimuth : {0.0, 100.0, 250.0}) {
    Lattice lattice = view();
    lattice.dims = {70, 9, 80};  // more slices than pieces
    lattice.azimuth = azimuth;
    const scene::Scene scene = make_scene(lattice);
    const std::vector<scene::Splat> expected = scene::collect_splats(scene);
    for (const int threads : {1, 2, 3}) {
      const std::vector<scene::Splat> splats = collect_splats(scene, threads);
      ASSERT_EQ(splats.size(), expected.size());
      for (std::size_t i = 0; i < splats.size(); ++i) {
        ASSERT_EQ(splats[i].position, expected[i].position);
        ASSERT_EQ(splats[i].emission, expected[i].emission);
        ASSERT_EQ(splats[i].extinction, expected[i].extinction);
        ASSERT_EQ(splats[i].sheet, expected[i].sheet);
      }
      compared += splats.size();
    }
  }
  EXPECT_TRUE(collect_splats(make_empty_scene(view()), 2).empty());
  figure("splats_in_their_order", static_cast<double>(compared), "every one");
}

}  // namespace
}  // namespace fastsplat::golden::testing
