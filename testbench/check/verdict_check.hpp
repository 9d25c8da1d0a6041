// SPDX-License-Identifier: Apache-2.0
// Checks a device's verdicts on cull_blocks: each once, in order, in its cycle (docs/microarchitecture.md,
// "Culling").
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "cmodel/cycles/cycle_model.hpp"
#include "testbench/device/raw_taps.hpp"

namespace fastsplat::testbench {

/// Observes a cycle model, which computes each verdict before the device can show it. Expects nothing of a device that
/// does not cull.
class VerdictCheck final : public cmodel::CycleSink {
 public:
  void on_verdict(const cmodel::VerdictCycles& verdict) override { expected_.push_back(verdict); }
  void on_sheet(const cmodel::SheetCycles& /*sheet*/) override {}
  void on_tile(const cmodel::TileCycles& /*tile*/) override {}

  /// Compares a verdict that was given; returns the difference as text.
  std::optional<std::string> compare(const RawTap& tap);
  /// Takes the next verdict that was not given; returns it as text.
  std::optional<std::string> missing();

 private:
  std::deque<cmodel::VerdictCycles> expected_;
};

}  // namespace fastsplat::testbench
