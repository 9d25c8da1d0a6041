// SPDX-License-Identifier: Apache-2.0
#include "tests/pipeline/oracle/render.hpp"

#include <algorithm>
#include <cmath>

#include "tests/pipeline/oracle/densities.hpp"
#include "tests/pipeline/oracle/rounding.hpp"
#include "tests/pipeline/oracle/splats.hpp"
#include "tests/pipeline/oracle/tables.hpp"

namespace fastsplat::stages::oracle {

namespace {

struct Pixel {
  Values colour{};  ///< R, G, B; an X-ray's sums
  double t = 1.0;
  Closeness closeness;
};

class Frame {
 public:
  Frame(const scene::Scene& scene, const cmodel::Config& config, const Mixture& mixture)
      : scene_(scene),
        config_(config),
        mixture_(mixture),
        xray_(scene.description.method == scene::Method::XRay),
        additive_(scene.description.slab_opacity == scene::SlabOpacity::Additive),
        radial_(radial_table(scene.kernel.a(), scene.kernel.radius(), config)),
        factor_(factor_table(config)) {}

  /// Steps distance, index and weight of a pixel in the box of a splat.
  double weight(const Splat& splat, int x, int y, Closeness& closeness) const {
    using cmodel::IndexKind;
    const IndexKind kind = config_.index();
    const double dx = x - splat.x, dy = y - splat.y, radius = splat.radius;
    const bool of_offsets = kind == IndexKind::Blit2d || kind == IndexKind::Separable;
    const bool in_tile = mixture_.floats(Step::Position) && mixture_.tile_centres();
    if (!mixture_.device(Step::Distance) && (mixture_.floats(Step::Distance) || in_tile) &&
        !(of_offsets && mixture_.device(Step::Weight)))
      return of_floats(splat, x, y, in_tile, closeness);
    if (kind == IndexKind::Blit2d || kind == IndexKind::Separable) return read(dx, dy, radius, closeness);
    const int n = config_.radial_entries, g = config_.rlut_guard_bits;
    const double q = kind == IndexKind::Rlut ? distance(dx, radius, closeness) + distance(dy, radius, closeness)
                                             : computed(dx, dy, radius, closeness);
    compare(q, n, g, closeness);
    if (q >= n) return 0.0;
    return of_entries(q, closeness);
  }

  double of_entries(double q, Closeness& closeness) const {
    const int n = config_.radial_entries;
    const bool linear = config_.index() == cmodel::IndexKind::Linear;
    const auto footprint = [&](double part) { return this->footprint(linear ? part * part : part); };
    const auto rounded = [&](double w) { return narrow(mixture_, Step::Weight, w, closeness); };
    if (!mixture_.device(Step::Index) && !mixture_.device(Step::Weight)) return rounded(footprint(q / n));
    const double t = trn(q, 0, closeness);
    if (config_.interpolates()) return on_line(q, t, closeness);
    const double at = mixture_.device(Step::Index) ? t + 0.5 : q;
    if (!mixture_.device(Step::Weight)) return rounded(footprint(at / n));
    // In this order: if `at` is the entry's own place, only the entry remains.
    return std::max(0.0, footprint(at / n) - footprint((t + 0.5) / n) + radial_[static_cast<std::size_t>(t)]);
  }

  /// How far beyond the radius, along an axis, a pixel can have weight.
  double beyond() const {
    return config_.index() == cmodel::IndexKind::Linear ? std::ldexp(1.0, -grid_bits(config_)) : 0.0;
  }

  double product(double v, double w, Closeness& closeness) const {
    if (!mixture_.device(Step::Product)) return narrow(mixture_, Step::Product, v * w, closeness);
    const double rounded = round_by(config_.rounding_product, v * w, config_.sheet_frac_bits, closeness);
    return cut(rounded, 0.0, largest(config_.sheet_int_bits, config_.sheet_frac_bits));
  }

  /// Every sample is composited, without sums.
  bool samples() const { return scene_.description.method == scene::Method::Westover; }

  void cut_sum(Values& sums) const {
    if (!mixture_.device(Step::Sheet)) return;
    for (double& sum : sums) sum = cut(sum, 0.0, largest(config_.sheet_int_bits, config_.sheet_frac_bits));
  }

  /// Of a sheet, and of an X-ray.
  double sum(double before, double more, Closeness& closeness) const {
    return narrow(mixture_, Step::Sheet, before + more, closeness, true);
  }

  bool densities() const { return scene_.description.classify == scene::ClassifyOrder::Post; }

  /// Of a slab's colour, and of what is seen of it.
  double colour_word(int rounding, double value, Closeness& closeness) const {
    const int ci = config_.colour_int_bits, tf = config_.composite_frac_bits;
    return ci == 0 ? to_unit(rounding, value, tf, closeness) : to_unsigned(rounding, value, ci, tf, closeness);
  }

  /// Steps sheet to freeze, at the end of a sheet; for one sample, and for a former density, from factor on.
  void composite(Values s, Pixel& pixel) const {
    if (!samples() && !densities()) cut_sum(s);
    if (s == Values{}) return;
    if (xray_) {
      for (std::size_t c = 0; c < 4; ++c) pixel.colour[c] = sum(pixel.colour[c], s[c], pixel.closeness);
      cut_sum(pixel.colour);
      return;
    }
    const Values slab = slab_of(s, pixel.closeness);
    const double least = mixture_.device(Step::Freeze) ? std::ldexp(config_.freeze_below, -config_.composite_frac_bits)
                                                       : scene_.description.culling.freeze;
    compare(pixel.t, least, config_.composite_frac_bits, pixel.closeness);
    if (pixel.t < least || pixel.t < 1e-20) return;
    const double before = pixel.t;
    if (!mixture_.device(Step::Composite)) {
      const auto rounded = [&](double v) { return narrow(mixture_, Step::Composite, v, pixel.closeness); };
      for (std::size_t c = 0; c < 3; ++c)
        pixel.colour[c] =
            narrow(mixture_, Step::Composite, pixel.colour[c] + rounded(before * slab[c]), pixel.closeness, true);
      pixel.t = rounded(before * rounded(1.0 - slab[3]));
      return;
    }
    const int tf = config_.composite_frac_bits;
    for (std::size_t c = 0; c < 3; ++c) {
      const double light = colour_word(config_.rounding_light, before * slab[c], pixel.closeness);
      pixel.colour[c] = std::min(pixel.colour[c] + light, largest(1 + config_.colour_int_bits, tf));
    }
    pixel.t = before - to_unit(config_.rounding_light, before * slab[3], tf, pixel.closeness);
  }

  Values out(Pixel& pixel) const {
    Values values = pixel.colour;
    if (!xray_) values[3] = 1.0 - pixel.t;
    for (double& value : values) value = narrow(mixture_, Step::Pixel, value, pixel.closeness);
    if (!mixture_.device(Step::Pixel)) return values;
    for (double& value : values) {
      value =
          to_unsigned(config_.rounding_pixel, value, config_.pixel_int_bits, config_.pixel_frac_bits, pixel.closeness);
    }
    return values;
  }

 private:
  /// The weight where steps position or distance are floats.
  double of_floats(const Splat& splat, int x, int y, bool in_tile, Closeness& closeness) const {
    const auto rounded = [&](double v) { return narrow(mixture_, Step::Distance, v, closeness); };
    const auto along = [&](int pixel, double centre, int tile) {
      const int corner = in_tile ? pixel - pixel % tile : 0;
      const double from = in_tile ? narrow(mixture_, Step::Position, centre - corner, closeness) : centre;
      const double d = rounded(pixel - corner - from);
      return rounded(d * d);
    };
    const double square = rounded(along(x, splat.x, config_.tile_width) + along(y, splat.y, config_.tile_height));
    const double u = rounded(square * narrow(mixture_, Step::Radius, 1.0 / (splat.radius * splat.radius), closeness));
    compare(u, 1.0, 0, closeness);
    if (!(u < 1.0)) return 0.0;
    if (!mixture_.device(Step::Index) && !mixture_.device(Step::Weight))
      return narrow(mixture_, Step::Weight, footprint(u), closeness);
    return of_entries(config_.radial_entries * (config_.index() == cmodel::IndexKind::Linear ? std::sqrt(u) : u),
                      closeness);
  }

  double footprint(double u) const {
    return std::exp(-scene_.kernel.a() * scene_.kernel.radius() * scene_.kernel.radius() * u);
  }

  /// Steps index and weight of an interpolated table, of which at least one is the device's.
  double on_line(double q, double t, Closeness& closeness) const {
    const double kernel_radius = scene_.kernel.radius(), part = trn(q, config_.rlut_guard_bits, closeness) - t;
    const auto end = [&](double at) {
      return line_end(scene_.kernel.a(), kernel_radius, config_, static_cast<int>(at));
    };
    const double line = end(t) - (end(t) - end(t + 1)) * part;
    if (!mixture_.device(Step::Weight)) return narrow(mixture_, Step::Weight, line, closeness);
    const auto i = static_cast<std::size_t>(t);
    const double word = radial_[i] - rnd((radial_[i] - radial_[i + 1]) * part, config_.radial_frac_bits, closeness);
    if (mixture_.device(Step::Index)) return word;
    return std::max(0.0, footprint(q / config_.radial_entries) + (word - line));
  }

  double distance(double d, double radius, Closeness& closeness) const {
    const int n = config_.radial_entries, g = config_.rlut_guard_bits;
    const double q = d * d * n / (radius * radius);
    return mixture_.device(Step::Distance) ? rnd(q, g, closeness) : q;
  }

  /// Step distance of linear, squared and squared_elliptic.
  double computed(double dx, double dy, double radius, Closeness& closeness) const {
    const int n = config_.radial_entries, g = config_.rlut_guard_bits;
    const bool linear = config_.index() == cmodel::IndexKind::Linear;
    const double squared = dx * dx + dy * dy;
    if (!mixture_.device(Step::Distance))
      return linear ? std::sqrt(squared) * n / radius : squared * n / (radius * radius);
    const double grid = std::ldexp(1.0, grid_bits(config_)), rim = radius * grid;
    const long double d = static_cast<long double>(squared * grid * grid);
    const Scale scale = scale_of(linear ? n / std::ldexp(rim, g) : n / (rim * rim));
    long double steps = d;
    if (linear) {
      const long double root = std::sqrt(d * std::pow(4.0L, g));
      steps = std::floor(root);
      compare(static_cast<double>(root), std::round(static_cast<double>(root)), 0, closeness);
      // The largest s with s^2 <= D 4^g, independent of the root's own last bit.
      while (steps * steps > d * std::pow(4.0L, g)) steps -= 1.0L;
      while ((steps + 1.0L) * (steps + 1.0L) <= d * std::pow(4.0L, g)) steps += 1.0L;
    }
    const long double q = steps * static_cast<long double>(scale.c) * std::pow(2.0L, -scale.h);
    const auto near = static_cast<double>(q);
    return near >= std::floor(static_cast<double>(std::floor(q))) + 1.0 ? std::nextafter(near, 0.0) : near;
  }

  /// Steps distance to weight of blit2d and separable: only the last has an effect.
  double read(double dx, double dy, double radius, Closeness& closeness) const {
    const double u = (dx * dx + dy * dy) / (radius * radius);
    compare(u, 1.0, 0, closeness);
    if (!mixture_.device(Step::Weight)) return u < 1.0 ? narrow(mixture_, Step::Weight, footprint(u), closeness) : 0.0;
    const int wi = config_.radial_int_bits, wf = config_.radial_frac_bits, g = config_.rlut_guard_bits;
    if (config_.index() == cmodel::IndexKind::Blit2d)
      return u < 1.0 ? std::min(rnd(footprint(u), wf, closeness), largest(wi, wf)) : 0.0;
    const double most = std::min(1.0, largest(wi, wf));
    const auto along = [&](double d) {
      return std::min(rnd(footprint(d * d / (radius * radius)), wf + g, closeness), most);
    };
    return static_cast<double>(std::floor(static_cast<long double>(along(dx)) * along(dy) * std::pow(2.0L, wf) + 0.5L) *
                               std::pow(2.0L, -wf));
  }

  /// Steps factor and slab: colour, and last the opacity.
  Values slab_of(const Values& s, Closeness& closeness) const {
    const double tau = s[3];
    const bool real_factor = !mixture_.device(Step::Factor), device_slab = mixture_.device(Step::Slab);
    double f = 1.0;
    if (!additive_ && !real_factor) {
      f = interpolated(factor_, tau, config_, closeness);
    } else if (!additive_ && tau != 0.0) {
      f = narrow(mixture_, Step::Factor, -std::expm1(-tau) / tau, closeness);
    }
    Values slab{};
    for (std::size_t c = 0; c < 4; ++c) {
      slab[c] = s[c] * f;
      if (device_slab) {
        slab[c] = c < 3 ? colour_word(config_.rounding_slab, slab[c], closeness)
                        : to_unit(config_.rounding_slab, slab[c], config_.composite_frac_bits, closeness);
      } else {
        slab[c] = narrow(mixture_, Step::Slab, additive_ ? std::min(1.0, slab[c]) : slab[c], closeness);
      }
    }
    const bool floats = mixture_.floats(Step::Factor) || mixture_.floats(Step::Slab);
    if (!device_slab && !additive_ && real_factor && !floats) slab[3] = -std::expm1(-tau);
    return slab;
  }

  const scene::Scene& scene_;
  const cmodel::Config& config_;
  const Mixture& mixture_;
  bool xray_, additive_;
  std::vector<double> radial_, factor_;
};

/// All sheets of all pixels first: a pixel depends on its neighbours.
std::vector<std::array<double, 4>> of_densities(const scene::Scene& scene, const cmodel::Config& config,
                                                const Mixture& mixture, const Frame& frame,
                                                const std::vector<Splat>& splats, std::size_t sheets,
                                                std::vector<bool>* close) {
  const int width = scene.description.width, height = scene.description.height;
  const auto at = [width](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  };
  std::vector<std::vector<Values>> sums(sheets, std::vector<Values>(at(0, height), Values{}));
  std::vector<Closeness> doubts(at(0, height));
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (const Splat& splat : splats) {
        const double dx = x - splat.x, dy = y - splat.y, reach = splat.radius + frame.beyond();
        if (std::abs(dx) >= reach || std::abs(dy) >= reach) continue;
        Closeness& doubt = doubts[at(x, y)];
        doubt |= splat.closeness;
        const double w = frame.weight(splat, x, y, doubt);
        for (std::size_t s = 0; s < sheets; ++s) {
          double& sum = sums[s][at(x, y)][3];
          if (splat.shares[s][3] != 0.0) sum = frame.sum(sum, frame.product(splat.shares[s][3], w, doubt), doubt);
        }
      }
      for (std::size_t s = 0; s < sheets; ++s) frame.cut_sum(sums[s][at(x, y)]);
    }
  }
  const Densities colours(scene, config, mixture, static_cast<int>(sheets));
  std::vector<std::array<double, 4>> picture;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Pixel pixel;
      const auto d = [&](std::size_t s, int i, int j) { return s < sheets ? sums[s][at(i, j)][3] : 0.0; };
      // Beyond the picture a pixel stands for its neighbour, and the remaining difference counts twice.
      const int left = x == 0 ? 0 : x - 1, right = x + 1 == width ? x : x + 1, above = y == 0 ? 0 : y - 1,
                below = y + 1 == height ? y : y + 1;
      for (const std::size_t i : {at(x, y), at(left, y), at(right, y), at(x, above), at(x, below)})
        pixel.closeness |= doubts[i];
      for (std::size_t s = 0; s < sheets; ++s) {
        const double across = (d(s, right, y) - d(s, left, y)) * (right - left == 2 ? 1.0 : 2.0);
        const double down = (d(s, x, below) - d(s, x, above)) * (below - above == 2 ? 1.0 : 2.0);
        const double along = d(s + 1, x, y) - (s == 0 ? 0.0 : d(s - 1, x, y));
        frame.composite(colours(d(s, x, y), {across, down, along}, x, y, static_cast<int>(s), pixel.closeness), pixel);
      }
      picture.push_back(frame.out(pixel));
      if (close != nullptr) close->push_back(pixel.closeness.close);
    }
  }
  return picture;
}

}  // namespace

std::vector<std::array<double, 4>> render(const scene::Scene& scene, const cmodel::Config& config,
                                          const Mixture& mixture, std::vector<bool>* close) {
  const int width = scene.description.width, height = scene.description.height;
  const Frame frame(scene, config, mixture);
  const std::vector<Splat> splats = splats_of(scene, config, mixture);
  const std::size_t sheets = splats.empty() ? 0 : splats.front().shares.size();
  std::vector<std::array<double, 4>> picture;
  if (close != nullptr) close->clear();
  if (frame.densities()) return of_densities(scene, config, mixture, frame, splats, sheets, close);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Pixel pixel;
      std::vector<Values> sums(sheets, Values{});
      for (const Splat& splat : splats) {
        const double dx = x - splat.x, dy = y - splat.y;
        const double reach = splat.radius + frame.beyond();
        if (std::abs(dx) >= reach || std::abs(dy) >= reach) continue;
        pixel.closeness |= splat.closeness;
        const double w = frame.weight(splat, x, y, pixel.closeness);
        for (std::size_t s = 0; s < sheets; ++s) {
          for (std::size_t c = 0; c < 4; ++c) {
            if (splat.shares[s][c] == 0.0) continue;
            const double product = frame.product(splat.shares[s][c], w, pixel.closeness);
            sums[s][c] = frame.samples() ? product : frame.sum(sums[s][c], product, pixel.closeness);
          }
        }
        if (frame.samples()) {
          frame.composite(sums[0], pixel);
          sums[0] = {};
        }
      }
      for (std::size_t s = 0; s < sheets; ++s) frame.composite(sums[s], pixel);
      picture.push_back(frame.out(pixel));
      if (close != nullptr) close->push_back(pixel.closeness.close);
    }
  }
  return picture;
}

}  // namespace fastsplat::stages::oracle
