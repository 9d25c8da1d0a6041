// SPDX-License-Identifier: Apache-2.0
// Techniques that shape footprints: the lens's circle of confusion, and contradictory settings.
#include "scene/techniques.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/scene.hpp"
#include "tests/scene/scene_testing.hpp"

namespace fastsplat::scene {
namespace {

using ::testing::HasSubstr;

SceneDescription in_perspective() {
  SceneDescription d;
  d.volume = "point:9";
  d.width = d.height = 32;
  d.camera.projection = Projection::Perspective;
  return d;
}

std::string refused(const SceneDescription& d) {
  return refusal([&] { build_scene(d); }, ExitCode::Usage);
}

TEST(Techniques, DepthOfFieldNeedsPerspective) {
  SceneDescription d = in_perspective();
  d.lens = {DepthOfField::Splats, 4.0, 0.0};
  build_scene(d);
  d.camera.projection = Projection::Orthographic;
  EXPECT_THAT(refused(d), HasSubstr("perspective camera"));
}

TEST(Techniques, FocusLiesInFrontOfTheEye) {
  SceneDescription d = in_perspective();
  const double eye = build_scene(d).camera.eye_distance();
  d.lens = {DepthOfField::Splats, 4.0, -0.999 * eye};
  build_scene(d);
  for (const double focus : {-eye, -1.001 * eye}) {
    d.lens.focus = focus;
    EXPECT_THAT(refused(d), HasSubstr("focus is behind the eye"));
  }
  d.lens = {DepthOfField::Splats, -1.0, 0.0};
  EXPECT_THAT(refused(d), HasSubstr("aperture is out of range"));
}

TEST(Techniques, MotionStaysInFrontOfTheEye) {
  SceneDescription d = in_perspective();
  const Scene scene = build_scene(d);
  const double room = scene.camera.eye_distance() - scene.volume->bounding_radius() - scene.kernel.radius();
  d.motion.translate = {0.0, 1.99 * room, 0.0};
  build_scene(d);
  d.motion.translate = {0.0, 2.01 * room, 0.0};
  EXPECT_THAT(refused(d), HasSubstr("past the eye"));
  d.camera.projection = Projection::Orthographic;
  build_scene(d);
  d.motion = {{}, 31.0};
  EXPECT_THAT(refused(d), HasSubstr("orbit is out of range"));
}

// c(z) = A f |z - zf| / (z (zf - f)) on a film that spans the image, at the image's distance zi, 1/zi = 1/f - 1/zf. For
// any f, that is A |s(z) - s(zf)| pixels (N-8-40).
TEST(Techniques, CircleOfConfusionIsTheThinLens) {
  SceneDescription d = in_perspective();
  d.lens = {DepthOfField::Splats, 4.0, 1.5};
  const Scene scene = build_scene(d);
  const double eye = scene.camera.eye_distance();
  const double focus = eye + d.lens.focus;
  int compared = 0;
  for (const double f : {0.1, 3.0, 12.0}) {
    for (const double depth : {-8.0, -1.0, 1.5, 2.0, 9.0}) {
      const double z = eye + depth;
      const double on_film = d.lens.aperture * f * std::abs(z - focus) / (z * (focus - f));
      const double film_distance = 1.0 / (1.0 / f - 1.0 / focus);
      const double pixels_per_mm_of_film = scene.camera.scale_at(0.0) * eye / film_distance;
      const double expected = on_film * pixels_per_mm_of_film;
      EXPECT_NEAR(circle_of_confusion(scene.camera, d.lens, depth), expected, 1e-12 + 1e-12 * expected);
      ++compared;
    }
  }
  EXPECT_EQ(compared, 15);
  EXPECT_EQ(circle_of_confusion(scene.camera, d.lens, 1.5), 0.0);
  EXPECT_GT(circle_of_confusion(scene.camera, d.lens, 9.0), 1.0);
}

}  // namespace
}  // namespace fastsplat::scene
