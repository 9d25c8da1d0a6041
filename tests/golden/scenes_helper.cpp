// SPDX-License-Identifier: Apache-2.0
#include "scenes_helper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace fastsplat::golden::testing {

namespace {

std::shared_ptr<const volume::Volume> graded_volume(const Lattice& lattice) {
  auto volume = std::make_shared<volume::Volume>();
  volume->name = volume->source = "test lattice";
  volume->dims = lattice.dims;
  volume->spacing = lattice.spacing;
  volume->min = 0.0f;
  volume->max = 1.0f;
  volume->voxels.resize(static_cast<std::size_t>(lattice.dims.x) * lattice.dims.y * lattice.dims.z);
  for (int k = 0; k < lattice.dims.z; ++k) {
    for (int j = 0; j < lattice.dims.y; ++j) {
      for (int i = 0; i < lattice.dims.x; ++i) {
        volume->voxels[volume->index(i, j, k)] =
            lattice.dims.x > 1 ? static_cast<float>(i) / (lattice.dims.x - 1) : 1.0f;
      }
    }
  }
  return volume;
}

scene::TransferFunction graded_colour(double optical_depth) {
  const double opacity = -std::expm1(-optical_depth);
  scene::TransferFunction tf;
  tf.name = "test grade";
  tf.domain = scene::Domain::Value;
  tf.points = {{0.0, {0.2, 0.5, 1.0}, opacity}, {1.0, {1.0, 0.4, 0.1}, opacity}};
  return tf;
}

}  // namespace

scene::Scene make_scene(const Lattice& lattice) {
  scene::SceneDescription description;
  description.volume = "test lattice";
  description.kernel = "";
  description.kernel_a = lattice.a;
  description.kernel_radius = lattice.radius;
  description.camera.projection = lattice.projection;
  description.camera.azimuth = lattice.azimuth;
  description.camera.elevation = lattice.elevation;
  description.camera.roll = lattice.roll;
  description.camera.fov = lattice.fov;
  description.width = lattice.width;
  description.height = lattice.height;
  description.slab_width = lattice.slab_width;
  description.slab_opacity = lattice.slab_opacity;
  description.xray_sheets = lattice.xray_sheets;
  description.xray_exposure = 1.0;
  description.shading = 0;

  const auto volume = graded_volume(lattice);
  const double fit = scene::build_scene(description, volume).camera.project(glm::dvec3(0.0)).scale;
  description.camera.zoom = lattice.pixels_per_mm / fit;
  scene::Scene scene = scene::build_scene(description, volume);
  scene.transfer_function = graded_colour(lattice.optical_depth);
  scene.shading.on = false;
  return scene;
}

scene::Scene make_empty_scene(const Lattice& lattice) {
  scene::Scene scene = make_scene(lattice);
  for (scene::ControlPoint& point : scene.transfer_function.points) point.opacity = 0.0;
  return scene;
}

std::vector<scene::Splat> random_splats(const scene::Scene& scene, int count, double optical_depth, unsigned seed) {
  std::mt19937 random(seed);
  const auto uniform = [&random] { return static_cast<float>(random() / 4294967296.0); };
  const glm::vec3 half(0.5 * glm::dvec3(scene.volume->dims - 1) * scene.volume->spacing);
  const int sheets = scene::axis_sheet_count(scene);
  std::vector<scene::Splat> splats(count);
  for (scene::Splat& splat : splats) {
    for (int c = 0; c < 3; ++c) splat.position[c] = half[c] * (2.0f * uniform() - 1.0f);
    splat.extinction = static_cast<float>(optical_depth) * (0.05f + 0.95f * uniform());
    for (int c = 0; c < 3; ++c) splat.emission[c] = splat.extinction * uniform();
    splat.sheet = static_cast<std::uint16_t>(random() % static_cast<unsigned>(sheets));
  }
  return splats;
}

Image render_splats(scene::Method method, const scene::Scene& scene, const std::vector<scene::Splat>& splats,
                    int threads) {
  RenderOptions options;
  options.threads = threads;
  switch (method) {
    case scene::Method::XRay:
      return xray(scene, splats, options);
    case scene::Method::Westover:
      return westover(scene, splats, options);
    case scene::Method::AxisAligned:
      return axis_aligned(scene, splats, options);
    case scene::Method::ImageAligned:
      return image_aligned(scene, splats, options);
    case scene::Method::RayCast:
      break;
  }
  ADD_FAILURE() << "the ray caster takes a scene, not splats";
  return {};
}

double max_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.data.size(), b.data.size());
  EXPECT_FALSE(a.data.empty());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.data.size(); ++i) {
    largest = std::max(largest, std::abs(static_cast<double>(a.data[i]) - b.data[i]));
  }
  return largest;
}

double rms_difference(const Image& a, const Image& b) {
  EXPECT_EQ(a.data.size(), b.data.size());
  double sum = 0.0;
  std::size_t values = 0;
  for (std::size_t i = 0; i < a.data.size(); i += 4) {
    if (a.data[i + 3] == 0.0f && b.data[i + 3] == 0.0f) continue;
    for (std::size_t c = 0; c < 4; ++c) {
      const double d = static_cast<double>(a.data[i + c]) - b.data[i + c];
      sum += d * d;
    }
    values += 4;
  }
  EXPECT_GT(values, 0u) << "no pixel shows the object";
  return std::sqrt(sum / static_cast<double>(values));
}

double channel_sum(const Image& image, int channel) {
  double sum = 0.0;
  for (std::size_t i = static_cast<std::size_t>(channel); i < image.data.size(); i += 4) sum += image.data[i];
  return sum;
}

Moments moments(const Image& image, int channel) {
  Moments m;
  const auto for_each = [&](const auto& visit) {
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) visit(x, y, static_cast<double>(image.pixel(x, y)[channel]));
    }
  };
  for_each([&](int x, int y, double value) { m.sum += value, m.x += value * x, m.y += value * y; });
  m.x /= m.sum, m.y /= m.sum;
  for_each([&](int x, int y, double value) {
    m.xx += value * (x - m.x) * (x - m.x), m.xy += value * (x - m.x) * (y - m.y), m.yy += value * (y - m.y) * (y - m.y);
  });
  m.xx /= m.sum, m.xy /= m.sum, m.yy /= m.sum;
  return m;
}

double sampling_bound(double a, double radius, double pixels_per_unit) {
  const double s = pixels_per_unit;
  const double ripple = 2.0 * std::exp(-std::numbers::pi * std::numbers::pi * s * s / a);
  const double rim =
      a / std::numbers::pi * std::exp(-a * radius * radius) * 2 * std::numbers::pi * radius * std::sqrt(2.0) / s;
  return (1 + ripple) * (1 + ripple) - 1 + rim;
}

double max_opacity(const Image& image) {
  double largest = 0.0;
  for (std::size_t i = 3; i < image.data.size(); i += 4) largest = std::max<double>(largest, image.data[i]);
  return largest;
}

double fitted_order(const std::vector<double>& widths, const std::vector<double>& errors) {
  const auto n = static_cast<double>(widths.size());
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    const double x = std::log(widths[i]);
    const double y = std::log(errors[i]);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void figure(const std::string& name, double value, const char* limit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.9g", value);
  std::printf("[figure] %s = %s (%s)\n", name.c_str(), text, limit);
  ::testing::Test::RecordProperty(name, text);
}

}  // namespace fastsplat::golden::testing
