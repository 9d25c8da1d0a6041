// SPDX-License-Identifier: Apache-2.0
// The shape of a footprint: circles as they always were, ellipses as the sphere's silhouette, energy kept.
#include "golden/splat/footprint.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "golden/splat/projection.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::Method;

/// The circular footprint of earlier versions, pixel by pixel in row order.
struct CircularFootprint {
  std::vector<Footprint::Span> spans;
  std::vector<double> weights;

  CircularFootprint(const scene::Kernel& kernel, double centre_x, double centre_y, double pixels_per_unit, Rows rows,
                    int image_width) {
    const double radius = kernel.radius() * pixels_per_unit;
    const double radius2 = radius * radius;
    const double to_units2 = 1.0 / (pixels_per_unit * pixels_per_unit);
    const double top = std::max(std::ceil(centre_y - radius), static_cast<double>(rows.first));
    const double bottom = std::min(std::floor(centre_y + radius), static_cast<double>(rows.end - 1));
    for (double y = top; y <= bottom; y += 1.0) {
      const double dy = y - centre_y;
      const double half = std::sqrt(std::max(0.0, radius2 - dy * dy));
      const double left = std::max(std::ceil(centre_x - half), 0.0);
      const double right = std::min(std::floor(centre_x + half), static_cast<double>(image_width - 1));
      if (left > right) continue;
      spans.push_back(
          {static_cast<int>(y), static_cast<int>(left), static_cast<int>(right - left) + 1, weights.size()});
      for (double x = left; x <= right; x += 1.0) {
        const double dx = x - centre_x;
        weights.push_back(kernel.footprint((dx * dx + dy * dy) * to_units2));
      }
    }
  }
};

ProjectedSplat shaped(const scene::Kernel& kernel, double x, double y, const scene::ScreenShape& shape) {
  ProjectedSplat splat;
  splat.x = x, splat.y = y;
  splat.shape = shape;
  splat.reach_x = kernel.radius() * std::sqrt(shape.xx);
  splat.reach_y = kernel.radius() * std::sqrt(shape.yy);
  return splat;
}

TEST(Footprint, CircleKeepsEveryBit) {
  const scene::Kernel kernel(2.0, 2.0);
  std::mt19937 random(3);
  const auto uniform = [&random](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  constexpr int kWidth = 40;
  const Rows rows{8, 24};
  std::size_t compared = 0;
  Footprint footprint;
  for (int i = 0; i < 20000; ++i) {
    const double x = uniform(-5, kWidth + 5), y = uniform(0, 32), scale = std::exp2(uniform(-3, 3));
    const CircularFootprint expected(kernel, x, y, scale, rows, kWidth);
    footprint.rasterise(kernel, shaped(kernel, x, y, {scale * scale, 0.0, scale * scale}), rows, kWidth);
    ASSERT_EQ(footprint.spans().size(), expected.spans.size());
    for (std::size_t s = 0; s < expected.spans.size(); ++s) {
      const Footprint::Span &want = expected.spans[s], &got = footprint.spans()[s];
      ASSERT_EQ(std::tie(got.x, got.y, got.width), std::tie(want.x, want.y, want.width));
      for (int p = 0; p < want.width; ++p) {
        ASSERT_EQ(footprint.weights(got)[p], expected.weights[want.weights + static_cast<std::size_t>(p)]);
        ++compared;
      }
    }
  }
  figure("circle_weights_bit_for_bit", static_cast<double>(compared), "more than 100000, every one");
  EXPECT_GT(compared, 100000u);
}

// No pixel of an ellipse is missed or repeated: against the canonical form at every pixel.
TEST(Footprint, EllipseIsItsCanonicalForm) {
  const scene::Kernel kernel(2.0, 2.0);
  std::mt19937 random(5);
  const auto uniform = [&random](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  constexpr int kSide = 64;
  double worst = 0;
  std::size_t inside = 0;
  Footprint footprint;
  for (int i = 0; i < 300; ++i) {
    const double x = uniform(0, kSide), y = uniform(0, kSide), angle = uniform(0, std::numbers::pi);
    const double along = std::exp2(uniform(0, 7)), across = std::exp2(uniform(-1, 5));  // pixels^2 per unit^2
    const double c = std::cos(angle), s = std::sin(angle);
    const scene::ScreenShape shape{along * c * c + across * s * s, (along - across) * c * s,
                                   along * s * s + across * c * c};
    const double a = shape.yy / shape.determinant(), b = -2 * shape.xy / shape.determinant(),
                 d = shape.xx / shape.determinant();
    Image image(kSide, kSide, 1);
    footprint.rasterise(kernel, shaped(kernel, x, y, shape), {0, kSide}, kSide);
    for (const Footprint::Span& span : footprint.spans()) {
      for (int p = 0; p < span.width; ++p) {
        *image.pixel(span.x + p, span.y) += static_cast<float>(footprint.weights(span)[p]);
      }
    }
    for (int py = 0; py < kSide; ++py) {
      for (int px = 0; px < kSide; ++px) {
        const double dx = px - x, dy = py - y;
        const double q = a * dx * dx + b * dx * dy + d * dy * dy;
        if (std::abs(q - 4) < 1e-9) continue;  // on the rim itself either result is right
        const double expected = q < 4 ? kernel.peak() * std::exp(-2 * q) : 0.0;
        worst = std::max(worst, std::abs(*image.pixel(px, py) - expected) / kernel.peak());
        inside += q < 4;
      }
    }
  }
  figure("ellipse_weight_error", worst, "limit 1.2e-7: one float rounding");
  EXPECT_LE(worst, std::ldexp(1.0, -23));
  EXPECT_GT(inside, 10000u);
}

/// A wide view, so that the edge of the picture is 40 degrees off its centre.
Lattice wide_view() {
  Lattice lattice;
  lattice.dims = {24, 4, 24};
  lattice.projection = scene::Projection::Perspective;
  lattice.fov = 80;
  lattice.pixels_per_mm = 5;
  lattice.width = lattice.height = 192;
  return lattice;
}

scene::Scene elliptic(scene::Scene scene) {
  scene.description.footprint.shape = scene::FootprintShape::Ellipse;
  return scene;
}

// The ball of radius r about the splat is seen within a cone that touches it in a circle around the line of sight. The
// affine projection is exact to first order, so its rim differs from the silhouette by O(r^2) pixels, the circle's by
// O(r).
TEST(Footprint, EllipseRimIsTheSilhouetteToSecondOrder) {
  const scene::Scene scene = elliptic(make_scene(wide_view()));
  const glm::dvec3 world(10.5, 1.5, 7.5);
  const ProjectedSplat splat = Projector(scene)({glm::vec3(world), glm::vec3(1), 1.0f, 0});
  const double circle = std::pow(scene.camera.project(world).scale * scene.volume->kernel_unit(), 2);
  const glm::dvec3 eye = -scene.camera.eye_distance() * scene.camera.direction();
  const glm::dvec3 sight = world - eye;
  const double distance = glm::length(sight);
  const glm::dvec3 u = glm::normalize(glm::cross(sight, glm::dvec3(0, 0, 1)));
  const glm::dvec3 v = glm::cross(sight, u) / distance;

  std::vector<double> radii = {2.0, 1.0, 0.5, 0.25}, ellipse_errors, circle_errors;
  for (const double r : radii) {
    const double shrink = 1 - r * r / (distance * distance);
    double ellipse_error = 0, circle_error = 0;
    for (int i = 0; i < 64; ++i) {
      const double angle = i * std::numbers::pi / 32;
      const glm::dvec3 touch =
          eye + shrink * sight + r * std::sqrt(shrink) * (std::cos(angle) * u + std::sin(angle) * v);
      const scene::ScreenPoint at = scene.camera.project(touch);
      const double dx = at.x - splat.x, dy = at.y - splat.y, from_centre = std::hypot(dx, dy);
      const scene::ScreenShape& s = splat.shape;
      const double q = (s.yy * dx * dx - 2 * s.xy * dx * dy + s.xx * dy * dy) / s.determinant();
      ellipse_error = std::max(ellipse_error, std::abs(from_centre * (1 - r / std::sqrt(q))));
      circle_error = std::max(circle_error, std::abs(from_centre - r * std::sqrt(circle)));
    }
    std::printf("radius %g: ellipse misses the silhouette by %.4f px, circle by %.4f px\n", r, ellipse_error,
                circle_error);
    ellipse_errors.push_back(ellipse_error);
    circle_errors.push_back(circle_error);
  }
  const double order = fitted_order(radii, ellipse_errors), circle_order = fitted_order(radii, circle_errors);
  figure("ellipse_rim_order", order, "2 +- 0.1");
  figure("circle_rim_order", circle_order, "1 +- 0.2");
  EXPECT_NEAR(order, 2.0, 0.1);
  EXPECT_NEAR(circle_order, 1.0, 0.2);
}

// sqrt(det S) is the area of the unit disc's image over pi: the weights' sum, for the kernel integrates to 1.
TEST(Footprint, AreaRatioIsTheRootOfTheDeterminant) {
  const Lattice lattice = wide_view();
  const scene::Scene round = make_scene(lattice);
  const scene::Splat splat{glm::vec3(10.5, 1.5, 7.5), glm::vec3(1), 1.0f, 0};
  double sums[2];
  ProjectedSplat splats[2];
  for (int i = 0; i < 2; ++i) {
    const scene::Scene scene = i == 0 ? round : elliptic(round);
    splats[i] = Projector(scene)(splat);
    Footprint footprint;
    footprint.rasterise(scene.kernel, splats[i], {0, lattice.height}, lattice.width);
    sums[i] = 0;
    for (const Footprint::Span& span : footprint.spans()) {
      for (int p = 0; p < span.width; ++p) sums[i] += footprint.weights(span)[p];
    }
  }
  const double expected = std::sqrt(splats[1].shape.determinant() / splats[0].shape.determinant());
  const double bound = 2 * sampling_bound(2, 2, std::sqrt(splats[0].shape.xx));
  figure("ellipse_area_ratio", sums[1] / sums[0], ("sqrt(det) = " + std::to_string(expected)).c_str());
  EXPECT_GT(expected, 1.1);
  EXPECT_NEAR(sums[1] / sums[0], expected, expected * bound);
  // Its total equals that of the circle.
  EXPECT_NEAR(splats[1].value[3] * sums[1], splats[0].value[3] * sums[0], bound * splats[0].value[3] * sums[0]);
}

// A plate of constant extinction has, along the view axis, the same optical depth everywhere in the picture.
TEST(Footprint, PlateIsAsDeepAtTheEdgeOfThePicture) {
  const Lattice lattice = wide_view();
  const scene::Scene scene = elliptic(make_scene(lattice));
  const Image image = xray(scene, scene::collect_splats(scene), {});
  double sum = 0;
  int pixels = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const scene::Ray ray = scene.camera.ray(x, y);
      const double depth_at_back = 1.5;  // of the plate's last layer
      const glm::dvec3 at = ray.origin + ray.direction * (depth_at_back / ray.depth_per_mm);
      if (std::max(std::abs(at.x), std::abs(at.z)) > 11.5 - 3 || std::hypot(at.x, at.z) < 9) continue;
      sum += image.pixel(x, y)[3];
      ++pixels;
    }
  }
  ASSERT_GT(pixels, 500);
  const double mean = sum / pixels / (4 * lattice.optical_depth);
  std::printf("%d pixels, ", pixels);
  figure("plate_depth_at_the_edge", mean, "1 +- 0.01: ripple of the kernel, averaged");
  EXPECT_NEAR(mean, 1.0, 0.01);
}

TEST(Footprint, OrthographicEllipseIsTheCircleBitForBit) {
  Lattice lattice;
  lattice.azimuth = 31;
  lattice.elevation = 20;
  const scene::Scene round = make_scene(lattice);
  const std::vector<scene::Splat> splats = random_splats(round, 500, 3.0, 17);
  for (const Method method : {Method::XRay, Method::Westover, Method::AxisAligned, Method::ImageAligned}) {
    const Image circles = render_splats(method, round, splats);
    ASSERT_GT(max_opacity(circles), 0.1);
    EXPECT_EQ(circles, render_splats(method, elliptic(round), splats)) << scene::to_string(method);
  }
}

}  // namespace
}  // namespace fastsplat::golden::testing
