// SPDX-License-Identifier: Apache-2.0
// Anti-aliasing: the residue of a checkerboard too fine for the pixels, and pixels that must not change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "golden/sheet_sweep.hpp"
#include "golden/splat/projection.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::Method;

/// Squares of two voxels, seen from just outside the volume's bounding sphere so that depth runs over several k.
scene::Scene checkerboard(const std::string& volume, double azimuth, int size, double elevation = 0) {
  scene::SceneDescription d;
  d.volume = volume;
  d.width = d.height = size;
  d.camera.projection = scene::Projection::Perspective;
  d.camera.fov = 100;
  d.camera.zoom = 0.99 / std::sin(50 * std::acos(-1.0) / 180);
  d.camera.azimuth = azimuth;
  d.camera.elevation = elevation;
  return scene::build_scene(d);
}

scene::Scene antialiased(scene::Scene scene) {
  scene.description.footprint.antialias = true;
  return scene;
}

/// Distance from the eye at which a voxel is one pixel, mm.
double crossover(const scene::Scene& scene) {
  return scene.volume->kernel_unit() * scene.camera.scale_at(0) * scene.camera.eye_distance();
}

double from_eye(const scene::Scene& scene, const glm::dvec3& world) {
  return scene.camera.eye_distance() + glm::dot(world, scene.camera.direction());
}

/// The point where a pixel's ray meets the plane world[axis] = at; infinitely far if it misses.
glm::dvec3 hit(const scene::Ray& ray, const glm::dvec3& eye, int axis, double at) {
  const double t = (at - eye[axis]) / ray.direction[axis];
  return t > 0 ? eye + t * ray.direction : eye + 1e9 * ray.direction;
}

/// Pixels that see the boards past `nearest` crossovers, with every square of their kernels.
std::vector<int> pixels_beyond(const scene::Scene& scene, bool tunnel, double nearest) {
  const double half = 0.5 * (scene.volume->dims.x - 1);
  const double k = crossover(scene);
  const glm::dvec3 eye = -scene.camera.eye_distance() * scene.camera.direction();
  std::vector<int> pixels;
  for (int y = 0; y < scene.camera.height(); ++y) {
    for (int x = 0; x < scene.camera.width(); ++x) {
      const scene::Ray ray = scene.camera.ray(x, y);
      glm::dvec3 at = hit(ray, eye, 2, -half + 0.5);
      if (tunnel) {
        for (const auto& [axis, sign] : {std::pair{2, 1}, {0, 1}, {0, -1}}) {
          const glm::dvec3 wall = hit(ray, eye, axis, sign * (half - 0.5));
          if (from_eye(scene, wall) < from_eye(scene, at)) at = wall;
        }
      }
      const double lambda = from_eye(scene, at) / k;
      const double margin = scene.kernel.radius() * lambda + 1;
      const bool inside = std::abs(at.y) < half - margin && (tunnel || std::abs(at.x) < half - margin);
      if (lambda > nearest && inside) pixels.push_back(y * scene.camera.width() + x);
    }
  }
  return pixels;
}

/// Colour over opacity, the dark squares' 0 and the light ones' 1.
double tone(const Image& image, int pixel) {
  const float* rgba = &image.data[4 * static_cast<std::size_t>(pixel)];
  return (static_cast<double>(rgba[0]) / rgba[3] - 0.05) / 0.95;
}

/// Variance of the tone. Past 2.6 k a square is 0.77 pixel: all variation is alias. At most 1/4.
double contrast_energy(const Image& image, const std::vector<int>& pixels) {
  double sum = 0, squares = 0;
  for (const int pixel : pixels) {
    EXPECT_GT(image.data[4 * static_cast<std::size_t>(pixel) + 3], 0.5f);
    sum += tone(image, pixel);
    squares += tone(image, pixel) * tone(image, pixel);
  }
  const auto n = static_cast<double>(pixels.size());
  return squares / n - (sum / n) * (sum / n);
}

/// Root mean square change of tone.
double change(const Image& a, const Image& b, const std::vector<int>& pixels) {
  double squares = 0;
  for (const int pixel : pixels) squares += std::pow(tone(a, pixel) - tone(b, pixel), 2);
  return std::sqrt(squares / static_cast<double>(pixels.size()));
}

void expect_fifty_times_less(const scene::Scene& plain, bool tunnel, const std::string& name) {
  const std::vector<int> pixels = pixels_beyond(plain, tunnel, 2.6);
  ASSERT_GT(pixels.size(), 200u);
  const std::vector<scene::Splat> splats = scene::collect_splats(plain);
  const scene::Scene smooth = antialiased(plain);
  const Image before = image_aligned(plain, splats, {});
  const Image after = image_aligned(smooth, splats, {});
  const double aliased = contrast_energy(before, pixels);
  const double left = contrast_energy(after, pixels);
  std::printf("%zu pixels past 2.6 k\n", pixels.size());
  figure(name + "_alias_energy", aliased, "what there is to remove: above 0.002 of 0.25");
  figure(name + "_alias_energy_antialiased", left, "");
  figure(name + "_alias_energy_ratio", aliased / left, "at least 50");
  EXPECT_GT(aliased, 0.002);
  EXPECT_GE(aliased / left, 50.0);

  std::vector<scene::Splat> half_a_step = splats;
  for (scene::Splat& splat : half_a_step) splat.position += glm::vec3(-0.5 * plain.camera.direction());
  const double flicker = change(before, image_aligned(plain, half_a_step, {}), pixels);
  const double flicker_left = change(after, image_aligned(smooth, half_a_step, {}), pixels);
  figure(name + "_half_step_flicker_rms", flicker, "");
  figure(name + "_half_step_flicker_rms_antialiased", flicker_left, "at most a fifth");
  EXPECT_LE(5 * flicker_left, flicker);
}

TEST(Antialias, FloorAliasesFiftyTimesLess) {
  expect_fifty_times_less(checkerboard("checkerboard-floor:128", 45, 106), false, "floor");
}

TEST(Antialias, TunnelAliasesFiftyTimesLess) {
  expect_fifty_times_less(checkerboard("checkerboard-tunnel:128", 0, 134), true, "tunnel");
}

// A pixel that only splats before the crossover reach keeps every bit. A grown kernel may reach further than before, so
// these pixels are found from all footprints.
void expect_near_pixels_kept(const scene::Scene& plain, Method method, const std::string& name) {
  const std::vector<scene::Splat> splats = scene::collect_splats(plain);
  const scene::Scene smooth = antialiased(plain);
  std::vector<scene::Splat> grown;
  const Projector project(smooth);
  std::copy_if(splats.begin(), splats.end(), std::back_inserter(grown),
               [&](const scene::Splat& splat) { return project(splat).depth_growth > 1.0; });
  ASSERT_GT(grown.size(), 100u);
  ASSERT_LT(grown.size() + 100, splats.size());

  const Image before = render_splats(method, plain, splats);
  const Image after = render_splats(method, smooth, splats);
  const Image reached = render_splats(method, smooth, grown);
  std::size_t kept = 0, changed = 0;
  for (std::size_t i = 0; i < before.data.size(); i += 4) {
    const bool near_only = reached.data[i + 3] == 0.0f && before.data[i + 3] > 0.0f;
    const bool same = std::equal(&before.data[i], &before.data[i] + 4, &after.data[i]);
    if (near_only) {
      EXPECT_TRUE(same) << name << " pixel " << i / 4;
      ++kept;
    }
    changed += !same;
  }
  figure(name + "_pixels_of_near_splats_all_bits_kept", static_cast<double>(kept), "at least 500, every one");
  EXPECT_GE(kept, 500u);
  EXPECT_GE(changed, 500u);
}

TEST(Antialias, PixelsBeforeTheCrossoverKeepEveryBit) {
  for (const double slab_width : {1.0, 0.7}) {
    scene::Scene floor = checkerboard("checkerboard-floor:128", 45, 260, 30);
    floor.description.slab_width = slab_width;
    expect_near_pixels_kept(floor, Method::ImageAligned, "floor_W" + std::to_string(slab_width).substr(0, 3));
  }
  expect_near_pixels_kept(checkerboard("checkerboard-floor:128", 45, 260, 30), Method::AxisAligned, "floor_axis");
  expect_near_pixels_kept(checkerboard("checkerboard-tunnel:64", 0, 134), Method::ImageAligned, "tunnel");
}

// The total of a splat in the picture is unchanged, up to the sampling ripple of a kernel whose voxel is one pixel.
TEST(Antialias, EnergyIsKept) {
  Lattice lattice;
  lattice.dims = glm::ivec3(12);
  lattice.pixels_per_mm = 0.3;
  const scene::Scene scene = antialiased(make_scene(lattice));
  const std::vector<scene::Splat> splats = scene::collect_splats(scene);
  double extinction = 0;
  for (const scene::Splat& splat : splats) extinction += splat.extinction;
  const double total = channel_sum(xray(scene, splats, {}), 3) / (0.3 * 0.3);
  figure("antialias_energy_error", total / extinction - 1, "sampling ripple at one pixel a voxel, 2.9e-2");
  EXPECT_NEAR(total / extinction, 1.0, 0.029);
}

// A grown kernel is as deep as it is wide. The variance in depth of its shares is lambda^2 times that of the kernel (a
// Gaussian cut at R), plus 1/12 of the slab's width squared.
TEST(Antialias, KernelsGrowInDepthToo) {
  Lattice lattice;
  lattice.dims = glm::ivec3(5);
  lattice.pixels_per_mm = 0.25;
  const scene::Scene scene = antialiased(make_scene(lattice));
  const scene::Splat centre{glm::vec3(0), glm::vec3(1), 1.0f, 0};
  const ProjectedSplat splat = Projector(scene)(centre);
  EXPECT_NEAR(splat.depth_growth, 4.0, 1e-12);
  const KernelSlices slices = image_slabs(scene);
  std::vector<double> shares;
  slices.shares(splat, shares);
  double mean = 0, square = 0, sum = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const double depth = slices.first(splat) + static_cast<double>(i);
    sum += shares[i], mean += shares[i] * depth, square += shares[i] * depth * depth;
  }
  const double a = lattice.a, r = lattice.radius, root = std::sqrt(a) * r;
  const double cut = 1 - 2 * root * std::exp(-root * root) / (std::sqrt(std::acos(-1.0)) * std::erf(root));
  const double expected = 16 * cut / (2 * a) + 1.0 / 12;
  figure("grown_kernel_depth_variance", square - mean * mean, ("expected " + std::to_string(expected)).c_str());
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_NEAR(square - mean * mean, expected, 0.01 * expected);
}

}  // namespace
}  // namespace fastsplat::golden::testing
