// SPDX-License-Identifier: Apache-2.0
#include "tests/pipeline/oracle/densities.hpp"

#include <algorithm>
#include <cmath>

#include "scene/shading.hpp"

namespace fastsplat::stages::oracle {
namespace {

/// near(v, F): a table's word, as a value.
double near(double value, int f, double least, double most) {
  return cut(std::ldexp(std::floor(std::ldexp(value, f) + 0.5), -f), least, most);
}

}  // namespace

Densities::Densities(const scene::Scene& scene, const cmodel::Config& config, const Mixture& mixture, int sheets)
    : scene_(scene),
      config_(config),
      mixture_(mixture),
      classify_(scene.transfer_function, *scene.volume),
      least_(scene.volume->min),
      range_(static_cast<double>(scene.volume->max) - scene.volume->min),
      width_(scene.description.slab_width),
      depth_(scene.description.opacity_scale * width_),
      nearest_(-0.5 * sheets * width_) {
  const int q = 1 << config.classify_segment_bits;
  const double greatest = largest(config.sheet_int_bits, config.sheet_frac_bits);
  std::vector<scene::Material> materials;
  // N-8-92: CLASSIFY.
  for (int i = 0; i <= q; ++i) materials.push_back(classify_.evaluate(least_ + range_ * i / q));
  for (int i = 0; i <= q; ++i) {
    int from = -1;  // the nearest entry with an extinction; of two the lower one
    for (int j = 0; j <= q; ++j) {
      if (materials[static_cast<std::size_t>(j)].extinction > 0.0F &&
          (from < 0 || std::abs(j - i) < std::abs(from - i)))
        from = j;
    }
    for (int c = 0; c < 3; ++c) {
      const double colour = from < 0 ? 0.0 : static_cast<double>(materials[static_cast<std::size_t>(from)].colour[c]);
      transfer_[static_cast<std::size_t>(c)].push_back(near(colour, 14, 0.0, 1.0));
    }
    transfer_[3].push_back(near(static_cast<double>(materials[static_cast<std::size_t>(i)].extinction) * depth_,
                                config.sheet_frac_bits, 0.0, greatest));
  }
  // N-8-93: ROOT and GLINT.
  for (int i = 0; i <= 96; ++i) root_.push_back(near(1.0 / std::sqrt(1.0 + i / 32.0), 14, 0.0, 1.0));
  for (int i = 0; i <= 128; ++i) glint_.push_back(near(std::pow(i / 128.0, scene.shading.shininess), 12, 0.0, 1.0));
  const scene::Shader shader(scene.shading, scene.camera, *scene.volume);
  const auto in_view = [&](const glm::dvec3& v) {
    return Vector{glm::dot(v, scene.camera.right()), glm::dot(v, scene.camera.down()),
                  glm::dot(v, scene.camera.direction())};
  };
  light_ = in_view(glm::dvec3(shader.light()));
  half_ = in_view(glm::dvec3(shader.half()));
}

double Densities::n(double value, int f, double least, double most, Closeness& closeness) {
  return cut(rnd(value, f, closeness), least, most);
}

double Densities::line(double entry, double next, double rest, int f, Closeness& closeness) {
  return rest == 0.0 ? entry : entry - rnd((entry - next) * rest, f, closeness);
}

double Densities::between(const std::vector<double>& table, double at, int f, Closeness& closeness) const {
  const double i = std::min(trn(at, 0, closeness), static_cast<double>(table.size()) - 1.0);
  const double rest = std::max(at - i, 0.0);
  const auto here = static_cast<std::size_t>(i);
  return here + 1 == table.size() ? table.back() : line(table[here], table[here + 1], rest, f, closeness);
}

void Densities::visible(double density, Vector& e, double& tau, Closeness& closeness) const {
  if (mixture_.device(Step::Transfer)) {
    const double at = std::min(density, 1.0) * (1 << config_.classify_segment_bits);
    for (std::size_t c = 0; c < 3; ++c) e[c] = between(transfer_[c], at, 14, closeness);
    tau = between(transfer_[3], at, config_.sheet_frac_bits, closeness);
    return;
  }
  // A material is floats, so a density's last bit can show.
  const double value = least_ + range_ * density, doubt = std::ldexp(range_, -43);
  const scene::Material here = classify_.evaluate(value);
  for (const double beside : {value - doubt, value + doubt}) {
    const scene::Material other = classify_.evaluate(beside);
    closeness.close = closeness.close || other.colour != here.colour || other.extinction != here.extinction;
  }
  const auto rounded = [&](double v) { return narrow(mixture_, Step::Transfer, v, closeness); };
  for (int c = 0; c < 3; ++c) e[static_cast<std::size_t>(c)] = rounded(static_cast<double>(here.colour[c]));
  tau = rounded(static_cast<double>(here.extinction) * depth_);
}

Densities::Vector Densities::slope(const Vector& d, int x, int y, int sheet, Closeness& closeness) const {
  const double unit = scene_.volume->kernel_unit();
  const double middle = (nearest_ + (sheet + 0.5) * width_) * unit;
  const double p = scene_.camera.project(scene_.camera.direction() * middle).scale * unit;
  const double m = std::max(p / 2.0, 1.0 / (2.0 * width_));
  double sxy = p / 2.0 / m, sz = 1.0 / (2.0 * width_) / m;
  const auto lean = [&](double column, double row, const glm::dvec3& axis) {
    const scene::Ray ray = scene_.camera.ray(column, row);
    return glm::dot(ray.direction, axis) / ray.depth_per_mm;
  };
  const glm::dvec3 right = scene_.camera.right(), down = scene_.camera.down();
  double tx = lean(x, y, right), ty = lean(x, y, down);
  if (mixture_.floats(Step::Slope)) {
    const auto f = [&](double v) { return narrow(mixture_, Step::Slope, v, closeness); };
    const double across = f(f(d[0]) * f(sxy)), along_y = f(f(d[1]) * f(sxy)), ahead = f(f(d[2]) * f(sz));
    return {across, along_y, f(f(ahead - f(f(tx) * across)) - f(f(ty) * along_y))};
  }
  if (!mixture_.device(Step::Slope)) return {d[0] * sxy, d[1] * sxy, d[2] * sz - tx * d[0] * sxy - ty * d[1] * sxy};
  // N-8-95: SHEETS. N-8-94: LIGHTING, the ways of rays.
  sxy = near(sxy, 12, 0.0, 1.0);
  sz = near(sz, 12, 0.0, 1.0);
  const double x0 = lean(0, 0, right), y0 = lean(0, 0, down);
  const auto word = [](double v) { return near(v, 28, -8.0, 8.0 - std::ldexp(1.0, -28)); };
  tx = n(word(x0) + x * word(lean(1, 0, right) - x0), 12, -8.0, 8.0 - std::ldexp(1.0, -12), closeness);
  ty = n(word(y0) + y * word(lean(0, 1, down) - y0), 12, -8.0, 8.0 - std::ldexp(1.0, -12), closeness);
  const double most = 8.0 - std::ldexp(1.0, -16);
  const double gx = n(d[0] * sxy, 16, -8.0, most, closeness), gy = n(d[1] * sxy, 16, -8.0, most, closeness);
  return {gx, gy, n(d[2] * sz - tx * gx - ty * gy, 16, -8.0, most, closeness)};
}

std::array<double, 4> Densities::operator()(double density, const Vector& d, int x, int y, int sheet,
                                            Closeness& closeness) const {
  Vector e{};
  double tau = 0.0;
  visible(density, e, tau, closeness);
  if (tau == 0.0) return {};
  const scene::Shading& shading = scene_.shading;
  const Vector g = slope(d, x, y, sheet, closeness);
  const auto dot = [&](const Vector& a, const Vector& b, Step step) {
    const auto f = [&](double v) { return narrow(mixture_, step, v, closeness); };
    return f(f(f(a[0] * b[0]) + f(a[1] * b[1])) + f(a[2] * b[2]));
  };
  const double square = dot(g, g, Step::Normal);
  double h = 0.0, matt = 0.0, glint = 0.0;
  if (square != 0.0) {
    const auto normal = [&](double v) { return narrow(mixture_, Step::Normal, v, closeness); };
    double length = normal(std::sqrt(square)), inverse = normal(1.0 / length);
    if (mixture_.device(Step::Normal)) {
      double m = square, power = 1.0;  // square = m power^2, m in 1..4
      for (; m >= 4.0; m /= 4.0) power *= 2.0;
      for (; m < 1.0; m *= 4.0) power /= 2.0;
      // Between 1 and 4 only m jumps: its own last bit is the part that may differ.
      m = trn(m, 16, closeness);
      const double r = between(root_, (m - 1.0) * 32.0, 14, closeness);
      length = n(m * r * power, 24, 0.0, largest(5, 24), closeness);
      inverse = r / power;
    }
    const auto a = [&](const Vector& v) {
      const bool word = mixture_.device(Step::Facing);  // N-8-94: L and H
      const auto f = [&](double value) { return narrow(mixture_, Step::Facing, value, closeness); };
      Vector to{};
      for (std::size_t i = 0; i < 3; ++i) to[i] = word ? near(v[i], 14, -1.0, 1.0) : f(v[i]);
      const double cosine = f(std::abs(dot(g, to, Step::Facing)) * inverse);
      return word ? n(cosine, 14, 0.0, 1.0, closeness) : cosine;
    };
    const double light = a(light_), half = a(half_);
    if (mixture_.device(Step::Phong)) {
      // N-8-94: ambient, diffuse, specular.
      const auto word = [](double factor) { return near(factor, 12, 0.0, 16.0 - std::ldexp(1.0, -12)); };
      matt = n(word(shading.ambient) + word(shading.diffuse) * light, 12, 0.0, largest(5, 12), closeness);
      glint = word(shading.specular) * between(glint_, std::min(half, 1.0) * 128.0, 12, closeness);
    } else {
      const auto f = [&](double v) { return narrow(mixture_, Step::Phong, v, closeness); };
      matt = f(f(shading.ambient) + f(f(shading.diffuse) * light));
      glint = f(f(shading.specular) * f(std::pow(half, shading.shininess)));
    }
    const double unit = scene_.volume->kernel_unit(), middle = (nearest_ + (sheet + 0.5) * width_) * unit;
    const double p = scene_.camera.project(scene_.camera.direction() * middle).scale * unit;
    const double m = std::max(p / 2.0, 1.0 / (2.0 * width_)), floor = shading.gradient_floor;
    const double most = std::ldexp(1.0, 24) - std::ldexp(1.0, -8);
    if (mixture_.device(Step::Blend)) {  // N-8-95: c
      const double c = !shading.on ? 0.0 : floor > 0.0 ? near(m / floor, 8, 0.0, most) : most;
      h = n(length * c - 1.0, 8, 0.0, 1.0, closeness);
    } else {
      const auto f = [&](double v) { return narrow(mixture_, Step::Blend, v, closeness); };
      const double above = floor > 0.0 ? f(f(length * f(m / floor)) - 1.0) : 1.0;
      h = !shading.on ? 0.0 : cut(above, 0.0, 1.0);
    }
  }
  std::array<double, 4> out{0.0, 0.0, 0.0, tau};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto f = [&](double v) { return narrow(mixture_, Step::Shaded, v, closeness); };
    double k = f(e[c] + f(h * f(f(f(e[c] * matt) + glint) - e[c])));
    k = mixture_.device(Step::Shaded) ? n(k, 16, 0.0, 1.0, closeness) : cut(k, 0.0, 1.0);
    out[c] = narrow(mixture_, Step::Colour, k * tau, closeness);
    if (mixture_.device(Step::Colour))
      out[c] =
          n(out[c], config_.sheet_frac_bits, 0.0, largest(config_.sheet_int_bits, config_.sheet_frac_bits), closeness);
  }
  return out;
}

}  // namespace fastsplat::stages::oracle
