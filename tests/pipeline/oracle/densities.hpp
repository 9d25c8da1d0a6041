// SPDX-License-Identifier: Apache-2.0
// A pixel of a sheet of densities written again, for the oracle of the mixtures: docs/errors.md, section 1,
// "Densities", and docs/numerics.md, sections 6.2 and 8.
#pragma once

#include <array>
#include <vector>

#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"
#include "scene/transfer_function.hpp"
#include "tests/pipeline/oracle/rounding.hpp"

namespace fastsplat::stages::oracle {

class Densities {
 public:
  Densities(const scene::Scene& scene, const cmodel::Config& config, const Mixture& mixture, int sheets);

  /// R, G, B and optical depth of pixel (x, y) of sheet `sheet`: its density, and the page's dx, dy, dz.
  std::array<double, 4> operator()(double density, const std::array<double, 3>& d, int x, int y, int sheet,
                                   Closeness& closeness) const;

 private:
  using Vector = std::array<double, 3>;
  /// n(v, F) of F = `least`..`most` with f fraction bits.
  static double n(double value, int f, double least, double most, Closeness& closeness);
  /// Between two entries of f fraction bits.
  static double line(double entry, double next, double rest, int f, Closeness& closeness);
  double between(const std::vector<double>& table, double at, int f, Closeness& closeness) const;

  void visible(double density, Vector& e, double& tau, Closeness& closeness) const;
  Vector slope(const Vector& d, int x, int y, int sheet, Closeness& closeness) const;

  const scene::Scene& scene_;
  const cmodel::Config& config_;
  const Mixture& mixture_;
  scene::Classifier classify_;
  double least_, range_, width_, depth_, nearest_;
  std::array<std::vector<double>, 4> transfer_;  ///< CLASSIFY: R, G, B, tau
  std::vector<double> root_, glint_;
  Vector light_{}, half_{};
};

}  // namespace fastsplat::stages::oracle
