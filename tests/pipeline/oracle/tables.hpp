// SPDX-License-Identifier: Apache-2.0
// The tables and radius sets of a frame written again, for the oracle of the mixtures: docs/numerics.md, sections 4, 6,
// 8.
#pragma once

#include <map>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"
#include "tests/pipeline/oracle/rounding.hpp"

namespace fastsplat::stages::oracle {

/// The fraction bits Kl of the grid that centres lie on, section 3.
int grid_bits(const cmodel::Config& config);

/// v as c / 2^h, sections 4.1 and 4.2.
struct Scale {
  double c = 0.0;
  int h = 0;
};
Scale scale_of(double v);

/// The value of RADIAL[t] if it is interpolated.
double line_end(double a, double kernel_radius, const cmodel::Config& config, int t);
/// RADIAL[t], as values.
std::vector<double> radial_table(double a, double kernel_radius, const cmodel::Config& config);

/// FACTOR[j], as values.
std::vector<double> factor_table(const cmodel::Config& config);
/// Section 6, between the entries of FACTOR; `tau` need not be a word.
double interpolated(const std::vector<double>& factor, double tau, const cmodel::Config& config, Closeness& closeness);

/// shown(V): the sheets' average of a word.
class Shown {
 public:
  Shown(std::vector<double> radial, const cmodel::Config& config) : radial_(std::move(radial)), config_(config) {}
  double operator()(double word);

 private:
  std::vector<double> radial_;  ///< the table's entries, and with linear each an area of 2t+1
  const cmodel::Config& config_;
  std::map<double, double> known_;
};

/// The radius sets of a frame that the device can draw.
class RadiusSets {
 public:
  RadiusSets(const scene::Scene& scene, const cmodel::Config& config);
  /// r_set of the bin that a splat of radius `r` lies in.
  double of(double r, Closeness& closeness) const;

 private:
  double least_ = 0.0, b_ = 0.0;
  std::vector<double> radii_;
};

}  // namespace fastsplat::stages::oracle
