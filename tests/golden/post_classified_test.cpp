// SPDX-License-Identifier: Apache-2.0
// Classification after splatting: its definition, edges that stay sharp under zoom, normals of a ball, voxels that need
// no splat.
#include "golden/post_classified.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>

#include "density_helper.hpp"
#include "golden/gradient_splats.hpp"
#include "scene/ripple.hpp"
#include "scene/sheet_plan.hpp"
#include "scenes_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

using scene::ClassifyOrder;
using scene::GradientKind;

constexpr double kOneRounding = 1.1920928955078125e-7;  // 2^-23

/// A ball of soft colours seen from an odd side.
DensityScene soft_ball() {
  DensityScene what;
  what.dims = glm::ivec3(14);
  what.density = ball(4.0, 5.0);
  what.points = {{0.2, {0.2, 0.5, 1.0}, 0.0}, {0.6, {1.0, 0.6, 0.2}, 0.3}, {1.0, {1.0, 0.2, 0.1}, 0.6}};
  what.width = 61;
  what.height = 53;
  what.description.camera.azimuth = 31;
  what.description.camera.elevation = 20;
  what.description.classify = ClassifyOrder::Post;
  return what;
}

/// docs/techniques/post-classified.md written pixel by pixel.
Image defined(const scene::Scene& scene) {
  const double a = scene.kernel.a(), r = scene.kernel.radius(), unit = scene.volume->kernel_unit();
  const double peak = a / std::numbers::pi / -std::expm1(-a * r * r);
  const auto cumulative = [&](double z) {
    return 0.5 * (1.0 + std::erf(std::sqrt(a) * std::clamp(z, -r, r)) / std::erf(std::sqrt(a) * r));
  };
  const scene::SlabGrid grid = scene::slab_grid(scene);
  const scene::Classifier classify(scene.transfer_function, *scene.volume);
  const volume::Volume& volume = *scene.volume;
  Image image(scene.camera.width(), scene.camera.height());
  std::vector<double> density(image.data.size() / 4 * grid.count, 0.0);
  for (int k = 0; k < volume.dims.z; ++k) {
    for (int j = 0; j < volume.dims.y; ++j) {
      for (int i = 0; i < volume.dims.x; ++i) {
        const scene::ScreenPoint at = scene.camera.project(volume.position(i, j, k));
        std::vector<double> shares(grid.count);
        for (int s = 0; s < grid.count; ++s) {
          const double z = grid.first + s * grid.width - at.depth / unit;
          shares[s] = cumulative(z + grid.width) - cumulative(z);
        }
        for (int y = 0; y < image.height; ++y) {
          for (int x = 0; x < image.width; ++x) {
            const double d = std::hypot(x - at.x, y - at.y) / (at.scale * unit);
            if (d >= r) continue;
            const double value = (volume.at(i, j, k) - volume.min) * peak * std::exp(-a * d * d);
            for (int s = 0; s < grid.count; ++s) density[(y * image.width + x) * grid.count + s] += value * shares[s];
          }
        }
      }
    }
  }
  for (std::size_t pixel = 0; pixel < image.data.size() / 4; ++pixel) {
    double red = 0, green = 0, blue = 0, t = 1;
    for (int s = 0; s < grid.count; ++s) {
      const scene::Material m = classify.evaluate(volume.min + density[pixel * grid.count + s] / grid.width);
      const double alpha = -std::expm1(-m.extinction * grid.width);
      red += t * alpha * m.colour.r, green += t * alpha * m.colour.g, blue += t * alpha * m.colour.b;
      t *= 1.0 - alpha;
    }
    float* out = &image.data[4 * pixel];
    out[0] = static_cast<float>(red), out[1] = static_cast<float>(green), out[2] = static_cast<float>(blue);
    out[3] = static_cast<float>(1.0 - t);
  }
  return image;
}

TEST(PostClassified, IsItsDefinition) {
  double worst = 0.0;
  for (const double width : {0.4, 1.0, 1.7}) {
    for (const auto projection : {scene::Projection::Orthographic, scene::Projection::Perspective}) {
      DensityScene what = soft_ball();
      what.pixels_per_mm = 2.5;
      what.width = 31, what.height = 27;
      what.description.slab_width = width;
      what.description.camera.projection = projection;
      const scene::Scene scene = make_scene(what);
      const Image image = render(scene);
      ASSERT_GT(max_opacity(image), 0.5);
      worst = std::max(worst, max_difference(image, defined(scene)));
    }
  }
  figure("post_classified_vs_definition", worst, "limit 1.2e-7: one float rounding");
  EXPECT_LE(worst, kOneRounding);
}

/// Distance along the middle row from opacity 90 % to opacity 10 %, pixels.
double edge_width(const Image& image) {
  const int y = image.height / 2;
  const auto passes = [&](double level) {
    for (int x = image.width / 2; x + 1 < image.width; ++x) {
      const double here = image.pixel(x, y)[3], next = image.pixel(x + 1, y)[3];
      if (here >= level && next < level) return x + (here - level) / (here - next);
    }
    ADD_FAILURE() << "no edge";
    return 0.0;
  };
  return passes(0.1) - passes(0.9);
}

TEST(PostClassified, EdgesStaySharpUnderZoom) {
  std::vector<double> zooms, pre, post;
  for (const double zoom : {1.0, 2.0, 4.0, 8.0}) {
    DensityScene what;
    what.density = ball(7.3, 1.0);
    what.points = step_at(0.5);
    what.pixels_per_mm = 4 * zoom;
    what.width = static_cast<int>(80 * zoom);
    what.height = 5;
    what.description.camera.azimuth = 31;
    what.description.camera.elevation = 20;
    zooms.push_back(zoom);
    pre.push_back(edge_width(render(make_scene(what))));
    what.description.classify = ClassifyOrder::Post;
    post.push_back(edge_width(render(make_scene(what))));
    std::printf("zoom %g: 10-90 %% edge %.2f pixels pre-classified, %.2f post-classified\n", zoom, pre.back(),
                post.back());
  }
  figure("edge_width_at_8x_pre", pre.back(), "grows with the zoom");
  figure("edge_width_at_8x_post", post.back(), "one pixel: 0.8 of the step between two");
  figure("edge_width_growth_order_pre", fitted_order(zooms, pre), "1.0 +- 0.1");
  EXPECT_NEAR(fitted_order(zooms, pre), 1.0, 0.1);
  for (const double width : post) EXPECT_LE(width, 1.0);
}

/// Angles between the gradients and the rays of a ball, degrees, where the density is near 1/2.
class Normals final : public SheetStage {
 public:
  Normals(const PostClassified& classified, const SheetGeometry& geometry, bool neighbours)
      : classified_(classified), geometry_(geometry), neighbours_(neighbours) {}
  bool needs_neighbours() const override { return neighbours_; }
  void row(const SheetWindow& window, int y, int begin, std::span<Sums> pixels) const override {
    for (int i = 0; i < static_cast<int>(pixels.size()); ++i) {
      const int x = begin + i;
      const double density = window.here.row(y)[x][3] / geometry_.width();
      if (std::abs(density - 0.5) > 0.1) continue;
      const glm::dvec3 inwards = -glm::normalize(geometry_.position(x, y, window.number));
      const glm::dvec3 gradient = classified_.gradient(window, x, y, geometry_.pixels_per_unit(window.number));
      const double cosine = glm::dot(inwards, gradient) / glm::length(gradient);
      const double angle = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
      const std::lock_guard lock(mutex_);
      sum += angle, most = std::max(most, angle), ++count;
    }
  }
  mutable double sum = 0.0, most = 0.0;
  mutable int count = 0;

 private:
  const PostClassified& classified_;
  const SheetGeometry& geometry_;
  bool neighbours_;
  mutable std::mutex mutex_;
};

// Limit: the reconstruction of a flat density d ripples by d eps cos(2 pi x) (docs/golden.md, "Kernels"), which tilts
// the slope 1/8 of this ball by asin(2 pi d eps / slope). Differences over a voxel in depth add W^2/6 of the third
// derivative, at most 1/(6 * 8^2) rad where the ball's radius is above 8. A leaning ray meets the lattice sheared,
// which ripples more: twice is allowed at 60 degrees.
TEST(PostClassified, NormalsOfABall) {
  struct Flatness {
    const char* name;
    double a, radius, ripple;
  };
  for (const Flatness& kernel : {Flatness{"smooth", 1.35, 2.0, 0.0055}, Flatness{"flat", 1.02, 3.0, 0.0003}}) {
    for (const auto projection : {scene::Projection::Orthographic, scene::Projection::Perspective}) {
      for (const auto kind : {GradientKind::Central, GradientKind::Splats}) {
        DensityScene what;
        what.dims = glm::ivec3(32);
        what.density = ball(10.0, 8.0);
        what.points = step_at(0.5);
        what.a = kernel.a;
        what.radius = kernel.radius;
        what.pixels_per_mm = 3;
        what.width = what.height = 128;
        what.shading = true;
        what.description.camera.azimuth = 31;
        what.description.camera.elevation = 20;
        what.description.camera.projection = projection;
        what.description.camera.fov = 60;
        what.description.classify = ClassifyOrder::Post;
        what.description.gradients = kind;
        const scene::Scene scene = make_scene(what);
        const SheetGeometry geometry(scene);
        const DensityField field = collect_densities(scene, false);
        const PostClassified classified(scene, geometry, field.base, {});
        const bool central = kind == GradientKind::Central;
        const Normals normals(classified, geometry, central);
        const GradientSplats gradients(scene.kernel, geometry);
        sweep_frame(scene, field.splats, {}, image_slabs(scene),
                    {.deposit = central ? nullptr : &gradients, .sheet_stages = {&normals}});
        ASSERT_GT(normals.count, 10000);
        const double slope = 1.0 / 8.0;
        const double limit = (projection == scene::Projection::Perspective ? 2.0 : 1.0) * 180.0 / std::numbers::pi *
                             (std::asin(2.0 * std::numbers::pi * 0.6 * kernel.ripple / slope) + 1.0 / (6.0 * 64.0));
        const std::string name = std::string("normals_") + (central ? "central_" : "splatted_") + kernel.name +
                                 (projection == scene::Projection::Perspective ? "_perspective" : "");
        std::printf("%d normals, limit %.2f degrees: ", normals.count, limit);
        figure(name + "_mean_degrees", normals.sum / normals.count, "below 3: a few degrees");
        figure(name + "_max_degrees", normals.most, "limit: ripple and difference");
        EXPECT_LT(normals.most, limit);
        EXPECT_LT(normals.sum / normals.count, 3.0);
      }
    }
  }
}

// A peak of opacity in the middle of the range: values above it are clear but must be splatted, or their neighbours'
// partial sums would pass through the peak.
TEST(PostClassified, VoxelsThatCannotMatterAreNotSplatted) {
  for (const auto& [kind, projection] : {std::pair(GradientKind::Central, scene::Projection::Orthographic),
                                         std::pair(GradientKind::Splats, scene::Projection::Perspective)}) {
    DensityScene what = soft_ball();
    what.dims = glm::ivec3(52);
    what.width = what.height = 60;
    what.pixels_per_mm = 1.0;
    // A wide flat kernel, a hard edge, and around it values just too thin to be visible: there the whole reach is used.
    what.a = 1.02;
    what.radius = 3.0;
    what.description.slab_width = projection == scene::Projection::Orthographic ? 2.0 : 1.0;
    const auto core = ball(5.0, 0.01);
    what.density = [core](const glm::dvec3& mm) { return std::max(core(mm), 0.25 + 0.05 * std::sin(mm.x)); };
    what.points = {{0.4, {1, 0.5, 0.2}, 0.0}, {0.5, {1, 0.5, 0.2}, 0.9}, {0.6, {1, 0.5, 0.2}, 0.0}};
    what.shading = true;
    what.description.gradients = kind;
    what.description.camera.projection = projection;
    const scene::Scene scene = make_scene(what);
    const SheetGeometry geometry(scene);
    const auto picture = [&, kind = kind](const DensityField& field) {
      const PostClassified classified(scene, geometry, field.base, {});
      const GradientSplats gradients(scene.kernel, geometry);
      return sweep_frame(
          scene, field.splats, {}, image_slabs(scene),
          {.deposit = kind == GradientKind::Splats ? &gradients : nullptr, .sheet_stages = {&classified}});
    };
    const DensityField all = collect_densities(scene, false), some = collect_densities(scene);
    const Image image = picture(all);
    ASSERT_GT(max_opacity(image), 0.9);
    ASSERT_EQ(all.skipped, 0u);
    figure("voxels_skipped_share", static_cast<double>(some.skipped) / all.splats.size(), "more than 0.3");
    EXPECT_GT(some.skipped, all.splats.size() * 3 / 10);
    EXPECT_EQ(image, picture(some));
  }
}

TEST(PostClassified, NoVoxelIsLeftOutWhereFootprintsAreNotPlain) {
  DensityScene what = soft_ball();
  what.dims = glm::ivec3(40);
  what.points = step_at(0.5);
  what.density = [](const glm::dvec3& mm) { return std::max(ball(2.0, 1.0)(mm), 0.1 + 0.001 * mm.x); };
  ASSERT_GT(collect_densities(make_scene(what)).skipped, 0u);
  what.description.footprint.antialias = true;
  EXPECT_EQ(collect_densities(make_scene(what)).skipped, 0u);
  what.description.footprint = {};
  what.description.footprint.shape = scene::FootprintShape::Ellipse;
  EXPECT_EQ(collect_densities(make_scene(what)).skipped, 0u);
  what.description.footprint = {};
  what.description.footprint.texture.amplitude = 0.5;
  EXPECT_EQ(collect_densities(make_scene(what)).skipped, 0u);
}

TEST(PostClassified, TheRippleBoundHolds) {
  for (const double a : {1.0, 1.35, 2.0}) {
    DensityScene what;
    what.dims = glm::ivec3(17);
    what.density = [](const glm::dvec3& mm) { return glm::length(mm) < 13.0 ? 1.0 : 0.0; };
    what.points = step_at(2.0);
    what.a = a;
    what.description.camera.projection = scene::Projection::Perspective;
    what.description.camera.fov = 90;
    what.description.camera.azimuth = 17;
    what.description.slab_width = 0.25;
    what.width = what.height = 96;
    what.pixels_per_mm = 1.5;
    const scene::Scene scene = make_scene(what);
    const SheetGeometry geometry(scene);
    class Largest final : public SheetStage {
     public:
      bool needs_neighbours() const override { return false; }
      void row(const SheetWindow& window, int y, int begin, std::span<Sums> pixels) const override {
        for (std::size_t i = 0; i < pixels.size(); ++i) {
          most = std::max(most, window.here.row(y)[begin + static_cast<int>(i)][3]);
        }
      }
      mutable double most = 0.0;
    } largest;
    sweep_frame(scene, collect_densities(scene, false).splats, {1, {}}, image_slabs(scene),
                {.sheet_stages = {&largest}});
    const double bound = scene::ripple_bound(scene.kernel, glm::length(geometry.tilt(0, 0)));
    std::printf("a = %g: bound %.4f, ", a, bound);
    figure("ripple_above_the_mean", largest.most / 0.25 - 1.0, "below the bound, above 0");
    EXPECT_LE(largest.most / 0.25 - 1.0, bound);
    EXPECT_GT(largest.most / 0.25, 1.0);
  }
}

// If the volume's least value is visible, it is visible inside the volume only.
TEST(PostClassified, AVisibleBackgroundEndsWithTheVolume) {
  DensityScene what = soft_ball();
  what.dims = {10, 6, 8};
  what.density = [](const glm::dvec3&) { return 1.0; };
  what.points = {{0.0, {1, 1, 1}, 0.5}};
  what.description.camera.azimuth = what.description.camera.elevation = 0;
  what.width = 80, what.height = 64;
  const Image image = render(make_scene(what));
  int inside = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      // Seen along y: 10 x 8 voxels of 4 pixels, six voxels deep, each 1/2 opaque.
      const bool seen = std::abs(x - 39.5) < 20.0 && std::abs(y - 31.5) < 16.0;
      ASSERT_NEAR(image.pixel(x, y)[3], seen ? 1.0 - std::pow(0.5, 6) : 0.0, kOneRounding) << x << ' ' << y;
      inside += seen;
    }
  }
  EXPECT_EQ(inside, 40 * 32);
}

TEST(PostClassified, ThreadsDoNotChangeABit) {
  for (const auto kind : {GradientKind::Central, GradientKind::Splats}) {
    DensityScene what = soft_ball();
    what.shading = true;
    what.description.gradients = kind;
    what.description.texture.kind = scene::SolidKind::Marble;
    what.description.texture.scale = 4.0;
    what.description.bump.kind = scene::SolidKind::Noise;
    what.description.bump.scale = 2.0;
    const scene::Scene scene = make_scene(what);
    const Image one = render(scene, {1, {}});
    ASSERT_GT(max_opacity(one), 0.5);
    for (const int threads : {2, 3, 0}) EXPECT_EQ(one, render(scene, {threads, {}})) << threads;
  }
}

}  // namespace
}  // namespace fastsplat::golden::testing
