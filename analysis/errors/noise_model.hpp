// As if the noises of single keys added: says what is worth simulating, never what is good enough.
#pragma once

#include <map>
#include <vector>

#include "analysis/errors/knobs.hpp"

namespace fastsplat::analysis {

class NoiseModel {
 public:
  NoiseModel() = default;
  /// `begin` has the excess `excess` (error over the error allowed).
  NoiseModel(Steps begin, double excess);

  /// Measured: with `knob` alone at `step`, lower than it began, the excess was that.
  void learn(std::size_t knob, int step, double excess);
  /// Squared excess that the knob adds there: as measured, or four times less for each step back from the nearest lower
  /// step that was.
  double added(std::size_t knob, int step) const;
  /// Squared excess of all together.
  double square(const Steps& steps) const;

 private:
  Steps begin_;
  double begin_square_ = 0.0;
  std::vector<std::map<int, double>> measured_;
};

}  // namespace fastsplat::analysis
