// SPDX-License-Identifier: Apache-2.0
// Motion blur against film: the mean of many frames with the shutter open for an instant each.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::Method;

constexpr int kFrames = 32;
constexpr Method kMethods[] = {Method::XRay, Method::Westover, Method::AxisAligned, Method::ImageAligned};

Lattice turned_view() {
  Lattice lattice;
  lattice.dims = glm::ivec3(8);
  lattice.azimuth = 31;
  lattice.elevation = 20;
  lattice.width = lattice.height = 80;
  return lattice;
}

scene::Scene moving(scene::Scene scene, const glm::dvec3& translate, double orbit = 0.0) {
  scene.description.motion = {translate, orbit};
  return scene;
}

double shutter_time(int frame) { return (frame + 0.5) / kFrames - 0.5; }

Image mean(const std::vector<Image>& frames) {
  Image out(frames[0].width, frames[0].height);
  for (std::size_t i = 0; i < out.data.size(); ++i) {
    double sum = 0;
    for (const Image& frame : frames) sum += frame.data[i];
    out.data[i] = static_cast<float>(sum / static_cast<double>(frames.size()));
  }
  return out;
}

std::vector<scene::Splat> moved(std::vector<scene::Splat> splats, const glm::dvec3& way) {
  for (scene::Splat& splat : splats) splat.position = glm::vec3(glm::dvec3(splat.position) + way);
  return splats;
}

TEST(MotionBlur, NoMotionOnTheScreenKeepsEveryBit) {
  const scene::Scene still = make_scene(turned_view());
  const std::vector<scene::Splat> splats = random_splats(still, 300, 3.0, 3);
  Lattice front = turned_view();
  front.azimuth = front.elevation = 0;  // the view axis is exactly -y
  const scene::Scene front_still = make_scene(front);
  for (const Method method : kMethods) {
    const Image expected = render_splats(method, still, splats);
    ASSERT_GT(max_opacity(expected), 0.1);
    EXPECT_EQ(expected, render_splats(method, moving(still, glm::dvec3(0)), splats)) << scene::to_string(method);
    // Towards an orthographic camera: motion exists, but not on the screen.
    EXPECT_EQ(render_splats(method, front_still, splats), render_splats(method, moving(front_still, {0, 3, 0}), splats))
        << scene::to_string(method);
  }
}

TEST(MotionBlur, EnergyAndSecondMoment) {
  Lattice lattice = turned_view();
  lattice.pixels_per_mm = 6;
  lattice.width = lattice.height = 128;
  const scene::Scene still = make_scene(lattice);
  const std::vector<scene::Splat> one = {{glm::vec3(0.3f, 0.2f, -0.4f), glm::vec3(1), 1.0f, 0}};
  const glm::dvec3 way(2.0, -1.0, 3.0);
  const glm::dvec2 u =
      lattice.pixels_per_mm * glm::dvec2(glm::dot(way, still.camera.right()), glm::dot(way, still.camera.down()));
  const Moments before = moments(xray(still, one, {}), 3), after = moments(xray(moving(still, way), one, {}), 3);

  // The rim's step weighs (R s)^2 in a second moment, which is 1/(2a) s^2 without the cut; each side may err so.
  const double bound = 2 * sampling_bound(lattice.a, lattice.radius, lattice.pixels_per_mm);
  const double energy = after.sum / before.sum - 1;
  figure("motion_energy_error", energy, "sampling ripple and rim, 1.3e-3");
  EXPECT_LE(std::abs(energy), bound);
  const double moment_bound = bound * lattice.radius * lattice.radius * 2 * lattice.a * after.yy;
  const double errors[] = {after.xx - before.xx - u.x * u.x / 12, after.xy - before.xy - u.x * u.y / 12,
                           after.yy - before.yy - u.y * u.y / 12};
  for (const double error : errors) {
    figure("motion_second_moment_error", error / glm::dot(u, u) * 12, "of u^2/12");
    EXPECT_LE(std::abs(error), moment_bound);
  }
  EXPECT_NEAR(after.x, before.x, 0.01);
  EXPECT_NEAR(after.y, before.y, 0.01);
}

/// What |mean of the frames - stretched footprints| may be at a pixel, X-ray of an orthographic view. A splat of screen
/// deviation s (1/sqrt(2a) kernel units) moving by u differs, in units of its peak, along its way by
/// - a box of width u against a Gaussian of variance u^2/12. Transforms: |sin(y)/y - exp(-y^2/6)| <= y^4/180 for every
/// y;
///   over the splat's own spectrum that makes (u/s)^4/960.
/// - N frames in place of all: the midpoint rule's (h^2/24) max|f''| with h = u/N, (u/s)^2/(24 N^2).
/// - Kernel::variance() is less than s^2 by the share d that the cut takes: a variance that is off by d u^2/12 moves a
///   Gaussian by (u/s)^2 d/24.
/// across its way it falls off as its Gaussian does. Where either ends at its rim, exp(-aR^2) is missing.
Image bound_for(const scene::Scene& scene, const std::vector<scene::Splat>& splats, const glm::dvec2& u) {
  const double a = scene.kernel.a(), r = scene.kernel.radius();
  const double unit = scene.camera.scale_at(0) * scene.volume->kernel_unit();
  const double along2 = glm::dot(u, u) * 2 * a / (unit * unit);  // (u/s)^2
  const double edge = a * r * r;
  const double cut = edge * std::exp(-edge) / -std::expm1(-edge);
  const double relative = along2 * along2 / 960 + along2 / (24.0 * kFrames * kFrames) + along2 * cut / 24;
  const glm::dvec2 across = glm::normalize(glm::dvec2(-u.y, u.x));
  const double reach = r * std::sqrt(unit * unit + glm::dot(u, u) / 12 / scene.kernel.variance()) + glm::length(u);
  Image bound(scene.camera.width(), scene.camera.height(), 1);
  for (const scene::Splat& splat : splats) {
    const scene::ScreenPoint at = scene.camera.project(glm::dvec3(splat.position));
    for (int y = 0; y < bound.height; ++y) {
      for (int x = 0; x < bound.width; ++x) {
        const glm::dvec2 d(x - at.x, y - at.y);
        if (glm::length(d) > reach) continue;
        const double off = glm::dot(d, across) / unit;
        *bound.pixel(x, y) += static_cast<float>(scene.kernel.peak() * static_cast<double>(splat.extinction) *
                                                 (relative * std::exp(-a * off * off) + std::exp(-edge)));
      }
    }
  }
  return bound;
}

TEST(MotionBlur, XRayIsTheMeanOfTheFrames) {
  const scene::Scene still = make_scene(turned_view());
  const std::vector<scene::Splat> splats = random_splats(still, 60, 1.0, 9);
  for (const double pixels : {1.0, 2.0, 4.0}) {
    const glm::dvec3 way = (0.8 * still.camera.right() + 0.6 * still.camera.down()) * (pixels / 4.0);
    std::vector<Image> frames;
    for (int i = 0; i < kFrames; ++i) frames.push_back(xray(still, moved(splats, shutter_time(i) * way), {}));
    const Image film = mean(frames);
    const Image blurred = xray(moving(still, way), splats, {});
    const Image bound = bound_for(still, splats, pixels * glm::dvec2(0.8, 0.6));
    double worst = 0, worst_of_bound = 0;
    for (int y = 0; y < film.height; ++y) {
      for (int x = 0; x < film.width; ++x) {
        const double apart = std::abs(static_cast<double>(film.pixel(x, y)[3]) - blurred.pixel(x, y)[3]);
        worst = std::max(worst, apart);
        // Positions are float: 1e-5 of what is there.
        const double limit = *bound.pixel(x, y) + 1e-5 * film.pixel(x, y)[3];
        if (apart > 0) worst_of_bound = std::max(worst_of_bound, apart / limit);
      }
    }
    const std::string name = "xray_motion_" + std::to_string(static_cast<int>(pixels)) + "px";
    figure(name + "_vs_32_frames", worst / max_opacity(film), "of the brightest pixel");
    figure(name + "_unblurred_vs_32_frames", max_difference(film, xray(still, splats, {})) / max_opacity(film), "");
    figure(name + "_of_bound", worst_of_bound, "at most 1");
    EXPECT_LE(worst_of_bound, 1.0);
    EXPECT_GT(worst_of_bound, 1e-3);
  }
}

/// Composited pictures: a stretched kernel puts the material of its whole path into one slab at once, film never does.
/// They agree for thin material and differ at opaque edges, by the figures that the test prints.
void compare_with_film(double opacity_scale, double rms_limit) {
  scene::SceneDescription d;
  d.volume = "binary-cube:32";
  d.opacity_scale = opacity_scale;
  d.width = d.height = 96;
  const scene::Scene still = scene::build_scene(d);
  const double orbit = 8.0;
  std::vector<Image> frames;
  for (int i = 0; i < kFrames; ++i) {
    scene::SceneDescription at = d;
    at.camera.azimuth += shutter_time(i) * orbit;
    at.shading = 0;
    frames.push_back(render(scene::build_scene(at, still.volume)));
  }
  scene::SceneDescription shuttered = d;
  shuttered.shading = 0;
  const Image sharp = render(scene::build_scene(shuttered, still.volume));
  shuttered.motion.orbit = orbit;
  const Image blurred = render(scene::build_scene(shuttered, still.volume));
  const Image film = mean(frames);
  const std::string name = "composited_motion_opacity_" + std::to_string(opacity_scale).substr(0, 4);
  const double rms = rms_difference(film, blurred), unblurred = rms_difference(film, sharp);
  figure(name + "_rms_lsb8", 255 * rms, ("at most " + std::to_string(255 * rms_limit)).c_str());
  figure(name + "_max_lsb8", 255 * max_difference(film, blurred), "");
  figure(name + "_unblurred_rms_lsb8", 255 * unblurred, "more than the blurred");
  EXPECT_LE(rms, rms_limit);
  EXPECT_LT(rms, unblurred);
}

TEST(MotionBlur, CompositedFramesOfThinMaterial) { compare_with_film(0.05, 0.002); }
TEST(MotionBlur, CompositedFrames) { compare_with_film(1.0, 0.01); }

}  // namespace
}  // namespace fastsplat::golden::testing
