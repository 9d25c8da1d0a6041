// SPDX-License-Identifier: Apache-2.0
// The last bit of a double does not decide any word of an anti-aliased stream. A kernel that has grown is one pixel a
// voxel, so its A and C would otherwise lie exactly on a step of their rounding.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>
#include <utility>

#include "base/fnv1a.hpp"
#include "driver/config/config_file.hpp"
#include "driver/splats/ellipse_shape.hpp"
#include "driver/tiles/compile.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

/// `value` and its neighbours up to `bits` last bits away.
double moved(double value, int bits) {
  const double end = std::copysign(std::numeric_limits<double>::infinity(), bits);
  for (int i = 0; i < std::abs(bits); ++i) value = std::nextafter(value, end);
  return value;
}

// N-8-47: the factor 1 - 2^-40.
TEST(LastBit, GrownKernelsHaveTheSameWords) {
  int words = 0, different = 0;
  for (const auto& name : config_names()) {
    const cmodel::Config config = load_config(name);
    if (!config.has_ellipses()) continue;
    // Radii whose squares are powers of two, and others; half axes of the thinnest footprint.
    for (const double radius : {kThinnest, 0.5, 1.0, 1.5, std::sqrt(2.0), 2.0, 2.5, 3.0, 4.0}) {
      const auto shape_of = [&](int across, int down) {
        const double square = radius * radius;
        const auto shape = ellipse_words(config, {.xx = moved(square, across), .xy = 0.0, .yy = moved(square, down)});
        return std::tuple(shape.a, shape.c, shape.b, shape.shift);
      };
      const auto exact = shape_of(0, 0);
      for (int across = -4; across <= 4; ++across)
        for (int down = -4; down <= 4; ++down, ++words) different += shape_of(across, down) == exact ? 0 : 1;
    }
  }
  figure("ellipses with other last bits", words);
  figure("of them with other words", different);
  EXPECT_GT(words, 500);
  EXPECT_EQ(different, 0);
}

/// The floor of the gallery: most of its kernels grow. The picture is turned a little, so that no symmetry puts a
/// position between two words.
scene::SceneDescription floor_of(scene::Projection projection, scene::Method method) {
  auto description = view_of("checkerboard-floor:48", 72);
  description.method = method;
  description.camera.projection = projection;
  if (projection == scene::Projection::Perspective) description.camera.fov = 100.0;
  description.camera.zoom = projection == scene::Projection::Perspective ? 1.28 : 0.63;
  description.camera.azimuth = 37.3, description.camera.elevation = 11.9;
  description.footprint.antialias = true;
  return description;
}
scene::SceneDescription with_ellipses(scene::SceneDescription description) {
  description.footprint.shape = scene::FootprintShape::Ellipse;
  return description;
}

std::vector<cmodel::Beat> beats_of(const scene::SceneDescription& description) {
  const CompiledFrame compiled(scene::build_scene(description), load_config("ellipse"));
  std::vector<cmodel::Beat> out;
  compiled.emit([&](std::span<const cmodel::Beat> beats) { out.insert(out.end(), beats.begin(), beats.end()); });
  return out;
}

// N-8-1, N-8-47.
TEST(LastBit, DoesNotChangeAnAntiAliasedStream) {
  using scene::Method, scene::Projection;
  std::vector<scene::SceneDescription> views;
  for (const Method method : {Method::ImageAligned, Method::AxisAligned, Method::XRay}) {
    views.push_back(floor_of(Projection::Perspective, method));
    views.push_back(with_ellipses(floor_of(Projection::Perspective, method)));
    views.push_back(floor_of(Projection::Orthographic, method));
  }
  std::size_t compared = 0, different = 0;
  for (const auto& view : views) {
    const auto exact = beats_of(view);
    for (const int bits : {-2, -1, 1, 2}) {
      auto description = view;
      description.camera.zoom = moved(view.camera.zoom, bits);
      const auto other = beats_of(description);
      ASSERT_EQ(other.size(), exact.size());
      for (std::size_t i = 0; i < exact.size(); ++i) different += other[i] == exact[i] ? 0 : 1;
      compared += exact.size();
    }
  }
  figure("beats, zoom moved by last bits", static_cast<double>(compared));
  figure("of them different", static_cast<double>(different));
  EXPECT_GT(compared, 100'000U);
  EXPECT_EQ(different, 0U);
}

// N-8-1: recorded with GCC 12, and checked with every compiler that builds the tests.
TEST(LastBit, AnAntiAliasedStreamIsTheSameUnderEveryCompiler) {
  using scene::Method, scene::Projection;
  const auto floor = floor_of(Projection::Perspective, Method::ImageAligned);
  for (const auto& [view, recorded] : {std::pair{floor, std::uint64_t{0x467dc13e2880acfa}},
                                       std::pair{with_ellipses(floor), std::uint64_t{0x9cf43e3bea61f663}}}) {
    std::uint64_t hash = kFnv1aStart;
    for (const auto& beat : beats_of(view))
      for (const std::uint32_t word : beat) hash = fnv1a(hash, std::uint64_t{word});
    std::printf("[figure] words of the floor = 0x%016llx\n", static_cast<unsigned long long>(hash));
    EXPECT_EQ(hash, recorded);
  }
}

}  // namespace
}  // namespace fastsplat::driver
