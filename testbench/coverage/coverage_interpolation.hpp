// SPDX-License-Identifier: Apache-2.0
// Coverage of weights between entries of the radial table (docs/numerics.md, N-4.7-3): of circles and of ellipses, and
// how the fall rounds.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"
#include "testbench/coverage/coverage.hpp"

namespace fastsplat::testbench {

/// For configurations that interpolate.
class InterpolationCoverage {
 public:
  enum Kind : std::size_t { Circle, Ellipse };

  InterpolationCoverage(const cmodel::Config& config, Coverage& coverage);
  void load(const cmodel::LoadTable& table);
  /// Samples a weight at `steps` of 2^-g entries; nothing at and beyond the support's edge.
  void weight(Kind kind, std::uint64_t steps);

 private:
  struct Places {
    Coverage::Id on_entry = 0, between = 0, behind_last = 0;
  };
  Coverage& coverage_;
  int guard_bits_;
  std::size_t entries_;
  std::array<Places, 2> places_{};
  RoundingPoint fall_;
  std::vector<std::uint32_t> radial_;
};

}  // namespace fastsplat::testbench
