// SPDX-License-Identifier: Apache-2.0
// Every splatting technique against its definition (docs/golden.md, docs/techniques/), written a second time without
// bands, rings, spans or buckets. It uses the kernel's closed forms instead of scene::Kernel, and a measured derivative
// of the projection instead of a derived one. Its cameras turn, and its lens has a focal length.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/sheet_plan.hpp"
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
    for (const scene::Splat& splat : splats) placed_.push_back(place(splat));
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

  double variance() const {
    const double edge = a() * r() * r();
    return (1 / (2 * a())) * (1 - edge * std::exp(-edge) / (1 - std::exp(-edge)));
  }

  glm::dvec2 on_screen(const glm::dvec3& world, double azimuth_more = 0.0) const {
    scene::CameraParams params = scene_.description.camera;
    params.azimuth += azimuth_more;
    const scene::Camera camera(params, *scene_.volume, r() * unit_, scene_.camera.width(), scene_.camera.height());
    const scene::ScreenPoint at = camera.project(world);
    return {at.x, at.y};
  }

  /// J J^T of the projection at `world`, pixels^2 per kernel unit^2, by central differences of second order.
  glm::dmat2 sphere_on_screen(const glm::dvec3& world) const {
    const double h = 1e-4;
    glm::dmat2 shape(0.0);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 step(0.0);
      step[axis] = h;
      const glm::dvec2 slope = (on_screen(world + step) - on_screen(world - step)) * (unit_ / (2 * h));
      shape += glm::outerProduct(slope, slope);
    }
    return shape;
  }

  double circle_of_confusion(double from_eye) const {  // pixels
    const scene::Lens& lens = scene_.description.lens;
    const double f = 7.0;  // mm; the picture must not depend on it
    const double focus = scene_.camera.eye_distance() + lens.focus;
    const double on_film = lens.aperture * f * std::abs(from_eye - focus) / (from_eye * (focus - f));
    const double film_distance = 1 / (1 / f - 1 / focus);
    return on_film * pixels_at_unit_distance() / film_distance;
  }

  double pixels_at_unit_distance() const { return scene_.camera.scale_at(0) * scene_.camera.eye_distance(); }

  /// A splat's footprint: offsets d with d^T inverse d < R^2.
  struct Placed {
    glm::dvec2 centre{};
    glm::dmat2 inverse{};
    double depth = 0.0, growth = 1.0, energy_kept = 1.0;
  };

  /// N-8-40; N-8-41: motion; N-8-42: the preserved energy.
  Placed place(const scene::Splat& splat) const {
    const scene::SceneDescription& techniques = scene_.description;
    const glm::dvec3 world(splat.position);
    const scene::ScreenPoint at = scene_.camera.project(world);
    const double scale = at.scale * unit_;
    const double from_eye = scene_.camera.eye_distance() + at.depth;

    glm::dmat2 shape(scale * scale);
    if (techniques.footprint.shape == scene::FootprintShape::Ellipse) shape = sphere_on_screen(world);
    double growth = 1.0;
    if (techniques.footprint.antialias) {
      const bool flat = scene_.camera.projection() == scene::Projection::Orthographic;
      const double crossover = unit_ * pixels_at_unit_distance();
      growth = std::max(1.0, flat ? 1 / scale : from_eye / crossover);
      shape *= growth * growth;
    }
    const scene::Motion& motion = techniques.motion;
    if (!motion.none()) {
      const glm::dvec2 way = on_screen(world + 0.5 * motion.translate, 0.5 * motion.orbit) -
                             on_screen(world - 0.5 * motion.translate, -0.5 * motion.orbit);
      shape += glm::outerProduct(way, way) / (12 * variance());
    }
    if (techniques.lens.depth_of_field == scene::DepthOfField::Splats) {
      const double c = circle_of_confusion(from_eye);
      shape += glm::dmat2(c * c / 16 / variance());
    }

    return {.centre = {at.x, at.y},
            .inverse = glm::inverse(shape),
            .depth = at.depth / unit_,
            .growth = growth,
            .energy_kept = scale * scale / std::sqrt(glm::determinant(shape))};
  }

  void add_splat(std::size_t i, int x, int y, double z0, double z1, Sum& sum) const {
    const scene::Splat& splat = splats_[i];
    const Placed& at = placed_[i];
    const glm::dvec2 d = glm::dvec2(x, y) - at.centre;
    const double rho2 = glm::dot(d, at.inverse * d);
    if (!(rho2 < r() * r())) return;
    const double share = in_front((z1 - at.depth) / at.growth) - in_front((z0 - at.depth) / at.growth);
    const double weight = amplitude_ * at.energy_kept * std::exp(-a() * rho2) * share;
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
      for (std::size_t i = 0; i < splats_.size(); ++i) add_splat(i, x, y, -kFar, kFar, sum);
      for (int c = 0; c < 3; ++c) rgba[c] = static_cast<float>(sum.c[c]);
      rgba[3] = static_cast<float>(sum.tau);
      return;
    }
    if (method == Method::Westover) {
      for (std::size_t i = 0; i < splats_.size(); ++i) {
        Sum sum;
        add_splat(i, x, y, -kFar, kFar, sum);
        composite(sum);
      }
    }
    if (method == Method::AxisAligned) {
      for (int sheet = 0; sheet < scene::axis_sheet_count(scene_); ++sheet) {
        Sum sum;
        for (std::size_t i = 0; i < splats_.size(); ++i) {
          if (splats_[i].sheet == sheet) add_splat(i, x, y, -kFar, kFar, sum);
        }
        composite(sum);
      }
    }
    if (method == Method::ImageAligned) {
      const scene::SlabGrid grid = scene::slab_grid(scene_);
      const int more = scene_.description.footprint.antialias ? 40 : 0;  // for grown kernels
      for (int slab = -more; slab < grid.count + more; ++slab) {
        const double z0 = grid.first + slab * grid.width;
        Sum sum;
        for (std::size_t i = 0; i < splats_.size(); ++i) add_splat(i, x, y, z0, z0 + grid.width, sum);
        composite(sum);
      }
    }
    for (int c = 0; c < 3; ++c) rgba[c] = static_cast<float>(colour[c]);
    rgba[3] = static_cast<float>(1.0 - transmittance);
  }

  const scene::Scene& scene_;
  const std::vector<scene::Splat>& splats_;
  std::vector<Placed> placed_;
  double unit_ = 1.0, amplitude_ = 0.0;
};

// Both sides round a double to float once, and their doubles differ by far less than a float's last place. At most the
// two round differently, by one unit in the last place, relative to the largest value.
void expect_as_defined(const scene::Scene& scene, Method method, const std::string& name) {
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

void expect_as_defined(const Lattice& lattice, Method method, const std::string& name) {
  expect_as_defined(make_scene(lattice), method, name);
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

// Techniques that shape footprints, one by one and together. Voxels are seen at 0.8 to 1.6 pixels, so that some kernels
// grow.
Lattice minified() {
  Lattice lattice = cropped();
  lattice.projection = scene::Projection::Perspective;
  lattice.fov = 70;
  lattice.pixels_per_mm = 1.0;
  return lattice;
}

/// The same for a scene whose techniques must show.
void expect_shaped_as_defined(const scene::Scene& scene, Method method, const std::string& name) {
  scene::Scene plain = scene;
  plain.description.footprint = {};
  plain.description.motion = {};
  plain.description.lens = {};
  const std::vector<scene::Splat> splats = random_splats(scene, 60, 3.0, 7);
  ASSERT_GT(max_difference(render_splats(method, plain, splats), render_splats(method, scene, splats)), 1e-3) << name;
  expect_as_defined(scene, method, name);
}

TEST(Definition, EllipticalFootprints) {
  scene::Scene scene = make_scene(minified());
  scene.description.footprint.shape = scene::FootprintShape::Ellipse;
  expect_shaped_as_defined(scene, Method::ImageAligned, "image_ellipse_vs_definition");
  expect_shaped_as_defined(scene, Method::Westover, "westover_ellipse_vs_definition");
}

TEST(Definition, Antialiased) {
  for (const double slab_width : {0.7, 1.0}) {
    Lattice lattice = minified();
    lattice.slab_width = slab_width;
    lattice.xray_sheets = 9;
    scene::Scene scene = make_scene(lattice);
    scene.description.footprint.antialias = true;
    expect_shaped_as_defined(scene, Method::ImageAligned, "image_antialias_vs_definition");
    expect_shaped_as_defined(scene, Method::XRay, "xray_antialias_vs_definition");
  }
}

TEST(Definition, AntialiasedOrthographic) {
  Lattice lattice = cropped();
  lattice.pixels_per_mm = 0.3;  // all kernels grow more than threefold, in depth too
  scene::Scene scene = make_scene(lattice);
  scene.description.footprint.antialias = true;
  expect_shaped_as_defined(scene, Method::ImageAligned, "image_antialias_orthographic_vs_definition");
}

TEST(Definition, MotionBlur) {
  for (const auto projection : {scene::Projection::Orthographic, scene::Projection::Perspective}) {
    Lattice lattice = minified();
    lattice.projection = projection;
    scene::Scene scene = make_scene(lattice);
    scene.description.motion = {{2.0, -1.0, 3.0}, 20.0};
    expect_shaped_as_defined(scene, Method::ImageAligned, "image_motion_vs_definition");
    expect_shaped_as_defined(scene, Method::AxisAligned, "axis_motion_vs_definition");
  }
}

TEST(Definition, DepthOfFieldOnSplats) {
  scene::Scene scene = make_scene(minified());
  scene.description.lens = {scene::DepthOfField::Splats, 8.0, 2.0};
  expect_shaped_as_defined(scene, Method::ImageAligned, "image_depth_of_field_vs_definition");
  expect_shaped_as_defined(scene, Method::Westover, "westover_depth_of_field_vs_definition");
}

TEST(Definition, AllFootprintTechniquesTogether) {
  Lattice lattice = minified();
  lattice.spacing = {1.0, 1.5, 2.0};
  lattice.a = 1.35;
  lattice.pixels_per_mm = 0.5;
  scene::Scene scene = make_scene(lattice);
  scene.description.footprint = {scene::FootprintShape::Ellipse, true};
  scene.description.motion = {{2.0, -1.0, 3.0}, -15.0};
  scene.description.lens = {scene::DepthOfField::Splats, 6.0, -3.0};
  expect_shaped_as_defined(scene, Method::ImageAligned, "image_all_techniques_vs_definition");
  expect_shaped_as_defined(scene, Method::XRay, "xray_all_techniques_vs_definition");
}

}  // namespace
}  // namespace fastsplat::golden::testing
