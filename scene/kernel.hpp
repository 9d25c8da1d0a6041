// SPDX-License-Identifier: Apache-2.0
// The reconstruction kernel h(x) = N exp(-a |x|^2) and its integrals (splatting.md 1.6, 2).
#pragma once

#include <cmath>
#include <string>
#include <vector>

namespace fastsplat::scene {

/// Gaussian, lengths in kernel units (Volume::kernel_unit). Support: |depth| < R and footprint radius < R, that is a
/// cylinder along the view axis, so a kernel slice is exactly a scalar times one radial footprint.
/// N makes the mean of sum_k h(x-k) over the sampling lattice 1 (N = 1 / integral of exp(-a r^2) over the support).
class Kernel {
 public:
  /// Throws UserError (Usage) unless 0.1 <= a <= 20 and 0.5 <= radius <= 8.
  Kernel(double a, double radius);

  double a() const { return a_; }
  double radius() const { return radius_; }

  /// h at squared distance `rho2` from the view-axis line and offset z along it; 0 outside the support.
  double value(double rho2, double z) const;
  /// Integral of h over all z: F(rho) = peak() exp(-a rho^2), strict support rho < R.
  double footprint(double rho2) const { return rho2 < radius_ * radius_ ? peak_ * std::exp(-a_ * rho2) : 0.0; }
  double peak() const { return peak_; }
  /// Second moment of the footprint along x (or y): the footprint integrates to 1. Kernel units squared; a little less
  /// than the endless Gaussian's 1/(2a), since the footprint ends at R.
  double variance() const;
  /// Share of the footprint lying in front of z: 0 for z <= -R, 1 for z >= R, exactly.
  double cumulative(double z) const;
  /// Its derivative: the share per unit of depth at z; 0 for |z| >= R.
  double profile(double z) const;

 private:
  double a_, radius_, peak_, norm_, erf_edge_;
};

/// `gauss2` (a=2, R=2: the papers' usual assumption), `smooth` (a=1.35, R=2: flattest at R=2).
Kernel kernel_by_name(const std::string& name);
std::vector<std::string> kernel_names();

}  // namespace fastsplat::scene
