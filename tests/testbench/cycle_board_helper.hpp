// The same beats through the cycle model and the Verilated device: each event's cycle, the cycle counters, and the
// account of them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "cmodel/cycle_model.hpp"
#include "testbench/device/pattern.hpp"

namespace fastsplat::test {

struct CycleComparison {
  std::array<std::uint64_t, cmodel::kTapCount> by_tap{};
  std::uint64_t comparisons = 0, mismatches = 0;
  std::string first;  ///< the first mismatch in words
  std::uint64_t rtl_cycles = 0;
  cmodel::CycleAccount account;
  cmodel::StallCounters stalls;
  cmodel::Counters counters;

  CycleComparison& operator+=(const CycleComparison& other);
};

/// Prints the figures; fails the test where something differs or nothing of a tap was compared.
void judge(const std::string& name, const CycleComparison& comparison);

CycleComparison compare_cycles(const cmodel::Config& config, std::span<const cmodel::Beat> beats,
                               const testbench::Pattern& input, const testbench::Pattern& output);

}  // namespace fastsplat::test
