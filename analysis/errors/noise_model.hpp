// SPDX-License-Identifier: Apache-2.0
// Assumes that the noises of single keys add. Selects candidates for simulation; never decides that one is good enough.
#pragma once

#include <map>
#include <vector>

#include "analysis/errors/knobs.hpp"

namespace fastsplat::analysis {

class NoiseModel {
 public:
  NoiseModel() = default;
  /// `begin` has the excess `excess` (error / allowed error).
  NoiseModel(Steps begin, double excess);

  /// Records a measurement: the excess with `knob` alone at `step`, below its start.
  void learn(std::size_t knob, int step, double excess);
  /// Squared excess that the knob adds at `step`: as measured, or from the nearest measured step below it, four times
  /// less for each step up.
  double added(std::size_t knob, int step) const;
  /// Squared excess of all knobs together.
  double square(const Steps& steps) const;

 private:
  Steps begin_;
  double begin_square_ = 0.0;
  std::vector<std::map<int, double>> measured_;
};

}  // namespace fastsplat::analysis
