// SPDX-License-Identifier: Apache-2.0
// The same beats through the cycle model and the Verilated device: each event's cycle, the cycle counters, and the
// account of them.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "cmodel/cycles/cycle_model.hpp"
#include "testbench/device/pattern.hpp"
#include "testbench/device/rtl_device.hpp"

namespace fastsplat::test {

struct CycleComparison {
  std::array<std::uint64_t, cmodel::kTapCount> by_tap{};
  std::uint64_t comparisons = 0, mismatches = 0;
  std::string first;  ///< the first mismatch as text
  std::uint64_t rtl_cycles = 0;
  cmodel::CycleAccount account;
  cmodel::StallCounters stalls;
  cmodel::Counters counters;

  CycleComparison& operator+=(const CycleComparison& other);
};

/// Prints the figures; fails the test if anything differs or no event of a tap was compared.
void judge(const std::string& name, const CycleComparison& comparison);

using MakeRtl = std::function<std::unique_ptr<testbench::RtlDevice>(const cmodel::Config&, cmodel::PixelSink&,
                                                                    const testbench::RtlOptions&)>;
CycleComparison compare_cycles(const cmodel::Config& config, std::span<const cmodel::Beat> beats,
                               const testbench::Pattern& input, const testbench::Pattern& output,
                               const MakeRtl& make = testbench::make_rtl_device);

}  // namespace fastsplat::test
