// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/noise_model.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace fastsplat::analysis {

NoiseModel::NoiseModel(Steps begin, double excess)
    : begin_(std::move(begin)), begin_square_(excess * excess), measured_(begin_.size()) {}

void NoiseModel::learn(std::size_t knob, int step, double excess) {
  measured_[knob][step] = std::max(0.0, excess * excess - begin_square_);
}

double NoiseModel::added(std::size_t knob, int step) const {
  const auto& measured = measured_[knob];
  if (step >= begin_[knob] || measured.empty()) return 0.0;
  auto nearest = measured.upper_bound(step);
  if (nearest != measured.begin()) --nearest;
  return nearest->second * std::pow(4.0, nearest->first - step);
}

double NoiseModel::square(const Steps& steps) const {
  double sum = begin_square_;
  for (std::size_t k = 0; k < steps.size(); ++k) sum += added(k, steps[k]);
  return sum;
}

}  // namespace fastsplat::analysis
