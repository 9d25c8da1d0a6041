// SPDX-License-Identifier: Apache-2.0
#include "analysis/index_kinds/ellipses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/index_kinds/family_table.hpp"
#include "cmodel/splat/squared_unit.hpp"
#include "driver/tables/ellipse_set.hpp"
#include "driver/tables/index_tables.hpp"
#include "driver/tables/radius_sets.hpp"
#include "driver/tables/tables.hpp"
#include "golden/splat/footprint.hpp"
#include "golden/splat/projection.hpp"
#include "scene/real_splat.hpp"

namespace fastsplat::analysis {
namespace {

constexpr int kEllipseEntries = 1024, kEllipseGrid = 64;
constexpr int kSide = 160;            // pixels of the square that a splat is drawn in, its centre near the middle
constexpr int kVoxels = 32;           // per side of the volume
constexpr int kEllipsePicture = 128;  // pixels
constexpr int kSplats = 500;          // per row, about
constexpr double kWidest = 64;        // pixels: base's rlut.columns / 2

/// The i-th number of a Kronecker sequence, which fills 0..1 evenly at any length; each `line` has its own sequence.
double spread(int i, double line) { return (i + 1) * std::sqrt(line) - std::floor((i + 1) * std::sqrt(line)); }

cmodel::Config config_of(cmodel::IndexKind kind) {
  return family_config(kind, kEllipseGrid, static_cast<int>(kWidest), kEllipseEntries);
}

/// The model's unit, loaded with one set at a time.
class Unit {
 public:
  Unit(const cmodel::Config& config, const scene::Kernel& kernel) : config_(config), snap_(config), unit_(config) {
    unit_.load_radial(driver::radial_table(config, kernel).words);
  }
  /// Weights, 1.0 at the peak, of every pixel of the square.
  void draw(const cmodel::LoadTable& table, std::int32_t x, std::int32_t y, std::vector<double>& square) {
    unit_.load(table);
    cmodel::Nothing nobody;
    const auto rho = unit_.rho(table.radius.set), lanes = static_cast<std::uint32_t>(config_.lanes);
    const auto across = snap_(x, rho, nobody), down = snap_(y, rho, nobody);
    unit_.place(table.radius.set, across, down);
    std::vector<std::uint32_t> weights(static_cast<std::size_t>(lanes) * lanes);
    square.assign(static_cast<std::size_t>(kSide) * kSide, 0.0);
    for (std::uint32_t row = 0; row < unit_.extent(0); row += lanes) {
      for (std::uint32_t column = 0; column < unit_.extent(0); column += lanes) {
        unit_.window(column, row, weights, nobody);
        for (std::size_t lane = 0; lane < weights.size(); ++lane) {
          const auto px = across.origin + static_cast<int>(column + lane % lanes);
          const auto py = down.origin + static_cast<int>(row + lane / lanes);
          if (px >= 0 && py >= 0 && px < kSide && py < kSide)
            square[static_cast<std::size_t>(py * kSide + px)] =
                std::ldexp(static_cast<double>(weights[lane]), -config_.radial_frac_bits);
        }
      }
    }
  }

 private:
  cmodel::Config config_;
  cmodel::Snap snap_;
  cmodel::SquaredUnit unit_;
};

/// Accumulates a FieldError.
struct Sum {
  double largest = 0.0, squares = 0.0, all = 0.0;
  void add(double apart) {
    largest = std::max(largest, std::abs(apart));
    squares += apart * apart;
    all += apart;
  }
  FieldError over(std::uint64_t pixels) const {
    const auto n = static_cast<double>(std::max<std::uint64_t>(pixels, 1));
    return {.largest = 255.0 * largest, .rms = 255.0 * std::sqrt(squares / n), .bias = 255.0 * all / n};
  }
};

/// Compares splat after splat. `circle_radius`: the radius set's, pixels; 0: none. `energy`: factor on a circle's
/// weights that gives them the ellipse's total.
class Comparison {
 public:
  Comparison()
      : kernel_(scene::kernel_by_name("gauss2")),
        elliptic_(config_of(cmodel::IndexKind::SquaredElliptic)),
        round_(config_of(cmodel::IndexKind::Squared)),
        ellipses_(elliptic_, kernel_),
        circles_(round_, kernel_) {
    out_.least_q = std::numeric_limits<std::int64_t>::max();
  }

  void add(const scene::ScreenShape& shape, double circle_radius, double energy) {
    const int i = static_cast<int>(out_.splats++);
    const auto x = static_cast<std::int32_t>(kSide / 2 * kEllipseGrid + spread(i, 2.0) * kEllipseGrid);
    const auto y = static_cast<std::int32_t>(kSide / 2 * kEllipseGrid + spread(i, 3.0) * kEllipseGrid);
    draw_exact(shape, x, y);
    const double R2 = kernel_.radius() * kernel_.radius();
    const auto table = driver::ellipse_table(elliptic_, 0, {R2 * shape.xx, R2 * shape.xy, R2 * shape.yy});
    ellipses_.draw(table, x, y, drawn_);
    if (circle_radius > 0.0)
      circles_.draw(driver::set_table(round_, kernel_, 0, circle_radius, 0), x, y, circle_);
    else
      circle_.assign(exact_.size(), 0.0);
    for (std::size_t at = 0; at < exact_.size(); ++at) {
      if (exact_[at] == 0.0 && drawn_[at] == 0.0 && circle_[at] == 0.0) continue;
      ++out_.pixels;
      ellipse_sum_.add(drawn_[at] - exact_[at]);
      if (circle_radius > 0.0) circle_sum_.add(energy * circle_[at] - exact_[at]);
    }
    follow_q(shape, table, x, y);
    // middle +- apart are the eigenvalues of S.
    const double middle = (shape.xx + shape.yy) / 2.0, apart = std::hypot((shape.xx - shape.yy) / 2.0, shape.xy);
    const double aspect = std::sqrt((middle + apart) / (middle - apart));
    out_.aspect = std::max(out_.aspect, aspect);
    out_.longest = std::max(out_.longest, kernel_.radius() * std::sqrt(middle + apart));
    out_.entries_bound = std::max(out_.entries_bound, 1.5 * kEllipseEntries * aspect * aspect * 0x1p-23);
  }
  EllipseErrors result() {
    out_.ellipse = ellipse_sum_.over(out_.pixels);
    out_.circle = circle_sum_.over(out_.pixels);
    return out_;
  }
  const scene::Kernel& kernel() const { return kernel_; }
  const cmodel::Config& round() const { return round_; }

 private:
  /// Golden's own weights.
  void draw_exact(const scene::ScreenShape& shape, std::int32_t x, std::int32_t y) {
    golden::ProjectedSplat splat;
    splat.x = static_cast<double>(x) / kEllipseGrid;
    splat.y = static_cast<double>(y) / kEllipseGrid;
    splat.shape = shape;
    splat.reach_x = kernel_.radius() * std::sqrt(shape.xx);
    splat.reach_y = kernel_.radius() * std::sqrt(shape.yy);
    footprint_.rasterise(kernel_, splat, {.first = 0, .end = kSide}, kSide);
    exact_.assign(static_cast<std::size_t>(kSide) * kSide, 0.0);
    for (const auto& span : footprint_.spans()) {
      const double* weights = footprint_.weights(span);
      for (int n = 0; n < span.width; ++n)
        exact_[static_cast<std::size_t>(span.y * kSide + span.x + n)] = weights[n] / kernel_.peak();
    }
  }
  /// Compares q by the words with q by the shape, at the pixels of the square that holds the ellipse.
  void follow_q(const scene::ScreenShape& shape, const cmodel::LoadTable& table, std::int32_t x, std::int32_t y) {
    const cmodel::Quadric f = cmodel::quadric_of(table.words);
    const double R2 = kernel_.radius() * kernel_.radius(), determinant = shape.determinant();
    const int reach = static_cast<int>(table.radius.rho / kEllipseGrid) + 1;
    for (int py = kSide / 2 - reach; py <= kSide / 2 + reach; ++py) {
      for (int px = kSide / 2 - reach; px <= kSide / 2 + reach; ++px) {
        const std::int64_t dx = std::int64_t{px} * kEllipseGrid - x, dy = std::int64_t{py} * kEllipseGrid - y;
        const std::int64_t q = cmodel::quadric(f, dx, dy);
        out_.least_q = std::min(out_.least_q, q);
        const double ux = static_cast<double>(dx) / kEllipseGrid, uy = static_cast<double>(dy) / kEllipseGrid;
        const double exact = (shape.yy * ux * ux - 2.0 * shape.xy * ux * uy + shape.xx * uy * uy) / (determinant * R2);
        if (exact >= 1.0) continue;
        out_.entries_off = std::max(out_.entries_off,
                                    std::abs(std::ldexp(static_cast<double>(q), -f.shift) - exact * kEllipseEntries));
      }
    }
  }

  scene::Kernel kernel_;
  cmodel::Config elliptic_, round_;
  Unit ellipses_, circles_;
  golden::Footprint footprint_;
  std::vector<double> exact_, drawn_, circle_;
  Sum ellipse_sum_, circle_sum_;
  EllipseErrors out_;
};

}  // namespace

EllipseErrors perspective_ellipses(double fov) {
  scene::SceneDescription description;
  description.volume = "shells:" + std::to_string(kVoxels);
  description.width = description.height = kEllipsePicture;
  description.camera.projection = scene::Projection::Perspective;
  description.camera.fov = fov;
  description.footprint.shape = scene::FootprintShape::Ellipse;
  const scene::Scene scene = scene::build_scene(description);
  const golden::Projector project(scene);
  const auto splats = scene::collect_splats(scene);
  Comparison comparison;
  const double unit = scene.volume->kernel_unit() * comparison.kernel().radius();
  const auto radius = [&](const scene::Splat& splat) { return scene::real_splat(scene, splat).at.scale * unit; };
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (const auto& splat : splats) {
    smallest = std::min(smallest, radius(splat));
    largest = std::max(largest, radius(splat));
  }
  const driver::RadiusSets sets(comparison.round(), smallest, largest);
  const std::size_t step = std::max<std::size_t>(splats.size() / kSplats, 1);
  for (std::size_t i = 0; i < splats.size(); i += step) {
    const auto shape = project(splats[i]).shape;
    const double own = radius(splats[i]), set = sets.radius(sets.nearest(own));
    // Area of the ellipse over pi.
    const double area = std::sqrt(shape.determinant()) * comparison.kernel().radius() * comparison.kernel().radius();
    comparison.add(shape, set, area / (set * set));
  }
  return comparison.result();
}

EllipseErrors spread_ellipses(double aspect) {
  Comparison comparison;
  for (int i = 0; i < kSplats; ++i) {
    const double longer = 32.0 * std::pow(16.0, -spread(i, 5.0)), ratio = std::pow(aspect, spread(i, 7.0));
    const double angle = 2.0 * std::numbers::pi * spread(i, 11.0), c = std::cos(angle), s = std::sin(angle);
    const double l = std::pow(longer / comparison.kernel().radius(), 2), m = l / (ratio * ratio);
    comparison.add({.xx = l * c * c + m * s * s, .xy = (l - m) * c * s, .yy = l * s * s + m * c * c}, 0.0, 0.0);
  }
  return comparison.result();
}

}  // namespace fastsplat::analysis
