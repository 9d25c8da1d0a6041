// SPDX-License-Identifier: Apache-2.0
#include "scene/kernel.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "base/suggest.hpp"

namespace fastsplat::scene {
namespace {

void require(bool ok, const char* what, const char* expected, double got, const char* fix) {
  if (!ok) throw_usage({.where = {}, .what = what, .expected = expected, .got = fmt::format("{}", got), .fix = fix});
}

}  // namespace

Kernel::Kernel(double a, double radius) : a_(a), radius_(radius) {
  require(a >= 0.1 && a <= 20.0, "kernel sharpness a is out of range", "0.1..20", a,
          "gauss2 uses a = 2, smooth a = 1.35");
  require(radius >= 0.5 && radius <= 8.0, "kernel radius is out of range", "0.5..8 kernel units", radius,
          "both named kernels have radius 2");
  const double root = std::sqrt(a);
  erf_edge_ = std::erf(root * radius);
  const double line = std::sqrt(std::numbers::pi / a) * erf_edge_;               // along the axis
  const double disc = std::numbers::pi / a * -std::expm1(-a * radius * radius);  // across it
  norm_ = 1.0 / (line * disc);
  peak_ = 1.0 / disc;  // norm * line
}

double Kernel::value(double rho2, double z) const {
  if (rho2 >= radius_ * radius_ || std::abs(z) >= radius_) return 0.0;
  return norm_ * std::exp(-a_ * (rho2 + z * z));
}

// Half of the mean squared radius, Int rho^2 exp(-a rho^2) over the disc by parts.
double Kernel::variance() const {
  const double edge = a_ * radius_ * radius_;
  return (1.0 - edge * std::exp(-edge) / -std::expm1(-edge)) / (2.0 * a_);
}

double Kernel::cumulative(double z) const {
  if (z <= -radius_) return 0.0;
  if (z >= radius_) return 1.0;
  return 0.5 * (1.0 + std::erf(std::sqrt(a_) * z) / erf_edge_);
}

double Kernel::profile(double z) const {
  if (std::abs(z) >= radius_) return 0.0;
  return std::sqrt(a_ / std::numbers::pi) / erf_edge_ * std::exp(-a_ * z * z);
}

Kernel kernel_by_name(const std::string& name) {
  if (name == "gauss2") return Kernel(2.0, 2.0);
  if (name == "smooth") return Kernel(1.35, 2.0);
  throw_usage({.where = {},
               .what = "unknown kernel '" + name + "'",
               .expected = {},
               .got = {},
               .fix = suggestion(name, kernel_names())});
}

std::vector<std::string> kernel_names() { return {"gauss2", "smooth"}; }

}  // namespace fastsplat::scene
