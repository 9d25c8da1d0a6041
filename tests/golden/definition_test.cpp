// Every splatting technique against its definition (docs/golden.md), written out a second time without bands, rings,
// spans or buckets, with the kernel's closed forms instead of scene::Kernel.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::Method;
using scene::SlabOpacity;

struct Sum {
  double c[3] = {0, 0, 0};
  double tau = 0;
};

class Definition {
 public:
  Definition(const scene::Scene& scene, const std::vector<scene::Splat>& splats) : scene_(scene), splats_(splats) {
    unit_ = scene.volume->kernel_unit();
    const glm::dvec3 spacing = scene.volume->spacing;
    const double cell = spacing.x * spacing.y * spacing.z / (unit_ * unit_ * unit_);
    amplitude_ = cell * a() / std::numbers::pi / -std::expm1(-a() * r() * r());
  }

  Image render(Method method) const {
    Image image(scene_.camera.width(), scene_.camera.height());
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) pixel(method, x, y, image.pixel(x, y));
    }
    return image;
  }

 private:
  double a() const { return scene_.kernel.a(); }
  double r() const { return scene_.kernel.radius(); }

  double in_front(double z) const {
    if (z <= -r()) return 0.0;
    if (z >= r()) return 1.0;
    return 0.5 + 0.5 * std::erf(std::sqrt(a()) * z) / std::erf(std::sqrt(a()) * r());
  }

  void add_splat(const scene::Splat& splat, int x, int y, double z0, double z1, Sum& sum) const {
    const scene::ScreenPoint at = scene_.camera.project(glm::dvec3(splat.position));
    const double d = std::hypot(x - at.x, y - at.y);
    if (!(d < r() * at.scale * unit_)) return;
    const double zc = at.depth / unit_;
    const double rho = d / (at.scale * unit_);
    const double weight = amplitude_ * std::exp(-a() * rho * rho) * (in_front(z1 - zc) - in_front(z0 - zc));
    for (int c = 0; c < 3; ++c) sum.c[c] += weight * splat.emission[c];
    sum.tau += weight * splat.extinction;
  }

  void pixel(Method method, int x, int y, float* rgba) const {
    constexpr double kFar = 1e9;
    double colour[3] = {0, 0, 0};
    double transmittance = 1.0;
    const auto composite = [&](const Sum& sum) {
      const bool additive = scene_.description.slab_opacity == SlabOpacity::Additive;
      const double alpha = additive ? std::min(1.0, sum.tau) : 1.0 - std::exp(-sum.tau);
      for (int c = 0; c < 3; ++c) {
        const double own = additive ? std::min(1.0, sum.c[c]) : (sum.tau > 0 ? sum.c[c] * alpha / sum.tau : 0.0);
        colour[c] += transmittance * own;
      }
      transmittance *= 1.0 - alpha;
    };

    if (method == Method::XRay) {
      Sum sum;
      for (const scene::Splat& splat : splats_) add_splat(splat, x, y, -kFar, kFar, sum);
      for (int c = 0; c < 3; ++c) rgba[c] = static_cast<float>(sum.c[c]);
      rgba[3] = static_cast<float>(sum.tau);
      return;
    }
    if (method == Method::Westover) {
      for (const scene::Splat& splat : splats_) {
        Sum sum;
        add_splat(splat, x, y, -kFar, kFar, sum);
        composite(sum);
      }
    }
    if (method == Method::AxisAligned) {
      for (int sheet = 0; sheet < scene::axis_sheet_count(scene_); ++sheet) {
        Sum sum;
        for (const scene::Splat& splat : splats_) {
          if (splat.sheet == sheet) add_splat(splat, x, y, -kFar, kFar, sum);
        }
        composite(sum);
      }
    }
    if (method == Method::ImageAligned) {
      const scene::SlabGrid grid = scene::slab_grid(scene_);
      for (int slab = 0; slab < grid.count; ++slab) {
        const double z0 = grid.first + slab * grid.width;
        Sum sum;
        for (const scene::Splat& splat : splats_) add_splat(splat, x, y, z0, z0 + grid.width, sum);
        composite(sum);
      }
    }
    for (int c = 0; c < 3; ++c) rgba[c] = static_cast<float>(colour[c]);
    rgba[3] = static_cast<float>(1.0 - transmittance);
  }

  const scene::Scene& scene_;
  const std::vector<scene::Splat>& splats_;
  double unit_ = 1.0, amplitude_ = 0.0;
};

// Both sides round a double to float once, and their doubles differ by far less than a float's last place: at most the
// two round differently, one unit in the last place, relative to the largest value.
void expect_as_defined(Lattice lattice, Method method, const std::string& name) {
  const scene::Scene scene = make_scene(lattice);
  const std::vector<scene::Splat> splats = random_splats(scene, 60, 3.0, 7);
  const Image expected = Definition(scene, splats).render(method);
  const Image got = render_splats(method, scene, splats);
  double largest = 0.0;
  for (const float value : expected.data) largest = std::max<double>(largest, value);
  ASSERT_GT(max_opacity(expected), 0.1) << "the scene must show something";
  const double difference = max_difference(expected, got) / largest;
  figure(name, difference, "limit 1.2e-7: one float rounding");
  EXPECT_LE(difference, std::ldexp(1.0, -23));
}

// A picture smaller than the volume, so that splats straddle and lie outside every edge; odd sizes; two heights of
// band.
Lattice cropped() {
  Lattice lattice;
  lattice.dims = {10, 8, 9};
  lattice.azimuth = 31;
  lattice.elevation = 20;
  lattice.roll = 10;
  lattice.pixels_per_mm = 3.3;
  lattice.width = 29;
  lattice.height = 21;
  return lattice;
}

TEST(Definition, XRay) { expect_as_defined(cropped(), Method::XRay, "xray_vs_definition"); }
TEST(Definition, WestoverExponential) { expect_as_defined(cropped(), Method::Westover, "westover_vs_definition"); }
TEST(Definition, AxisAlignedExponential) { expect_as_defined(cropped(), Method::AxisAligned, "axis_vs_definition"); }
TEST(Definition, ImageAlignedExponential) { expect_as_defined(cropped(), Method::ImageAligned, "image_vs_definition"); }

TEST(Definition, AdditiveSlabOpacity) {
  Lattice lattice = cropped();
  lattice.slab_opacity = SlabOpacity::Additive;
  expect_as_defined(lattice, Method::Westover, "westover_additive_vs_definition");
  expect_as_defined(lattice, Method::AxisAligned, "axis_additive_vs_definition");
  expect_as_defined(lattice, Method::ImageAligned, "image_additive_vs_definition");
}

TEST(Definition, SlabWidths) {
  for (const double width : {0.25, 0.7, 2.0, 5.0}) {
    Lattice lattice = cropped();
    lattice.slab_width = width;
    expect_as_defined(lattice, Method::ImageAligned,
                      "image_slab_width_" + std::to_string(width).substr(0, 4) + "_vs_definition");
  }
}

TEST(Definition, AnisotropicGridAndSmoothKernel) {
  Lattice lattice = cropped();
  lattice.spacing = {1.0, 1.5, 2.0};
  lattice.a = 1.35;
  expect_as_defined(lattice, Method::ImageAligned, "image_anisotropic_vs_definition");
  expect_as_defined(lattice, Method::XRay, "xray_anisotropic_vs_definition");
}

TEST(Definition, Perspective) {
  Lattice lattice = cropped();
  lattice.projection = scene::Projection::Perspective;
  lattice.fov = 50;
  lattice.pixels_per_mm = 2.0;
  expect_as_defined(lattice, Method::ImageAligned, "image_perspective_vs_definition");
  expect_as_defined(lattice, Method::AxisAligned, "axis_perspective_vs_definition");
  expect_as_defined(lattice, Method::Westover, "westover_perspective_vs_definition");
}

}  // namespace
}  // namespace fastsplat::golden::testing
