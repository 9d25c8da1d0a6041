// SPDX-License-Identifier: Apache-2.0
// Common to all techniques: same bits for any number of threads, an empty picture of an empty scene, progress reports,
// perspective from far away like orthographic.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "base/error.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::Method;

constexpr Method kRendered[] = {Method::RayCast, Method::XRay, Method::Westover, Method::AxisAligned,
                                Method::ImageAligned};

Lattice odd_view() {
  Lattice lattice;
  lattice.dims = {14, 9, 11};
  lattice.azimuth = 200;
  lattice.elevation = -35;
  lattice.projection = scene::Projection::Perspective;
  lattice.pixels_per_mm = 3;
  lattice.width = 71;
  lattice.height = 53;  // not a multiple of the band's rows
  return lattice;
}

TEST(Render, ThreadsDoNotChangeABit) {
  scene::Scene scene = make_scene(odd_view());
  for (const Method method : kRendered) {
    scene.description.method = method;
    const Image one = render(scene, {1, {}});
    ASSERT_GT(max_opacity(one), 0.1) << scene::to_string(method);
    int compared = 0;
    for (const int threads : {2, 3, 0}) {
      EXPECT_EQ(one, render(scene, {threads, {}})) << scene::to_string(method) << " with " << threads << " threads";
      ++compared;
    }
    std::printf("%s: %d comparisons of %zu values, bit for bit\n", scene::to_string(method), compared, one.data.size());
  }
}

TEST(Render, ThreadsDoNotChangeABitOfShapedFootprints) {
  Lattice lattice = odd_view();
  lattice.pixels_per_mm = 0.9;
  scene::Scene scene = make_scene(lattice);
  scene.description.footprint = {scene::FootprintShape::Ellipse, true};
  scene.description.motion = {{3.0, -2.0, 1.0}, 10.0};
  scene.description.lens = {scene::DepthOfField::Splats, 10.0, -4.0};
  for (const Method method : {Method::XRay, Method::Westover, Method::AxisAligned, Method::ImageAligned}) {
    scene.description.method = method;
    const Image one = render(scene, {1, {}});
    ASSERT_GT(max_opacity(one), 0.1) << scene::to_string(method);
    for (const int threads : {2, 3, 0}) {
      EXPECT_EQ(one, render(scene, {threads, {}})) << scene::to_string(method) << " with " << threads << " threads";
    }
  }
}

TEST(Render, RayCasterRefusesShapedFootprints) {
  scene::Scene scene = make_scene(odd_view());
  scene.description.method = Method::RayCast;
  scene.description.motion.orbit = 1.0;
  try {
    render(scene);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    EXPECT_NE(std::string(error.what()).find("motion.orbit"), std::string::npos) << error.what();
  }
}

TEST(Render, NothingIsTransparent) {
  scene::Scene scene = make_empty_scene(odd_view());
  for (const Method method : kRendered) {
    scene.description.method = method;
    const Image image = render(scene);
    ASSERT_EQ(image.data.size(), 71u * 53u * 4u);
    EXPECT_TRUE(std::all_of(image.data.begin(), image.data.end(), [](float v) { return v == 0.0f; }))
        << scene::to_string(method);
  }
}

TEST(Render, ColourNeverExceedsOpacity) {
  scene::Scene scene = make_scene(odd_view());  // colours in 0..1, so emission never exceeds extinction
  for (const Method method : {Method::RayCast, Method::Westover, Method::AxisAligned, Method::ImageAligned}) {
    scene.description.method = method;
    const Image image = render(scene);
    for (std::size_t i = 0; i < image.data.size(); i += 4) {
      const float opacity = image.data[i + 3];
      ASSERT_GE(opacity, 0.0f);
      ASSERT_LE(opacity, 1.0f);
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_GE(image.data[i + c], 0.0f);
        ASSERT_LE(image.data[i + c], opacity + std::ldexp(1.0f, -22));  // roundings of both to float
      }
    }
  }
}

TEST(Render, ProgressReachesTheTotalOnce) {
  scene::Scene scene = make_scene(odd_view());
  for (const Method method : kRendered) {
    scene.description.method = method;
    std::atomic<int> calls = 0, completions = 0;
    RenderOptions options;
    options.progress = [&](std::size_t done, std::size_t total) {
      ++calls;
      if (done == total) ++completions;
      EXPECT_LE(done, total);
    };
    render(scene, options);
    EXPECT_GT(calls, 1);
    EXPECT_EQ(completions, 1) << scene::to_string(method);
  }
}

TEST(Render, ExponentialOpacityDoesNotDependOnTheGrouping) {
  // Exponential opacities multiply to exp(-sum of optical depths) in any grouping; colours differ, opacities cannot.
  Lattice lattice = odd_view();
  const scene::Scene scene = make_scene(lattice);
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  const Image reference = render_splats(Method::ImageAligned, scene, splats);
  for (const Method method : {Method::Westover, Method::AxisAligned}) {
    const Image image = render_splats(method, scene, splats);
    double difference = 0.0;
    for (std::size_t i = 3; i < image.data.size(); i += 4) {
      difference = std::max<double>(difference, std::abs(image.data[i] - reference.data[i]));
    }
    figure(std::string("opacity_difference_image_aligned_and_") + scene::to_string(method), difference,
           "limit 1.2e-7: one float rounding");
    EXPECT_LE(difference, std::ldexp(1.0, -23));
  }
}

TEST(Render, PerspectiveFromAfarIsOrthographic) {
  // Foreshortening across the volume is (its depth)/(eye distance), proportional to the field of view: the difference
  // from the orthographic picture must shrink with order 1.
  Lattice lattice = odd_view();
  lattice.width = lattice.height = 96;
  for (const Method method : {Method::RayCast, Method::ImageAligned}) {
    lattice.projection = scene::Projection::Orthographic;
    scene::Scene flat = make_scene(lattice);
    flat.description.method = method;
    const Image reference = render(flat);
    lattice.projection = scene::Projection::Perspective;
    std::vector<double> angles = {8.0, 4.0, 2.0}, errors;
    for (const double fov : angles) {
      lattice.fov = fov;
      scene::Scene scene = make_scene(lattice);
      scene.description.method = method;
      errors.push_back(rms_difference(reference, render(scene)));
    }
    const double order = fitted_order(angles, errors);
    std::printf("%s: rms difference %.3g, %.3g, %.3g at 8, 4, 2 degrees; ", scene::to_string(method), errors[0],
                errors[1], errors[2]);
    figure(std::string("perspective_far_limit_order_") + scene::to_string(method), order, "1.0 +- 0.15");
    EXPECT_NEAR(order, 1.0, 0.15);
  }
}

}  // namespace
}  // namespace fastsplat::golden::testing
