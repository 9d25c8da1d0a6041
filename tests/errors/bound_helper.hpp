// SPDX-License-Identifier: Apache-2.0
// Compares the bounds of frames with their errors, value by value.
#pragma once

#include <cstdint>
#include <string>

#include "analysis/errors/bound.hpp"

namespace fastsplat::test {

/// The result of many bounds.
struct BoundTotals {
  std::uint64_t frames = 0, values = 0, over = 0;
  double worst = 0.0;
  void add(const analysis::BoundCheck& one);
  void print(const std::string& what) const;  ///< as a line "[figure] ..."
};

/// Expects that no error of the device exceeds its bound, at any level from `least` on.
void hold(const stages::Chain& chain, BoundTotals& totals, analysis::Known least = analysis::Known::Scene);
/// The same of the device's steps alone.
void hold(const stages::Chain& chain, const stages::Mixture& device, BoundTotals& totals);

}  // namespace fastsplat::test
