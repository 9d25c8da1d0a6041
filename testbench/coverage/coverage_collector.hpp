// SPDX-License-Identifier: Apache-2.0
// Samples the coverage of one run of the checked device. The run's beats go through the model for its taps and through
// the cycle model for its cycles. A run that passes proves the RTL equal to both; the coverage of a run that fails is
// discarded. Knows no simulator type.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/model.hpp"
#include "testbench/coverage/coverage.hpp"
#include "testbench/coverage/coverage_composite.hpp"
#include "testbench/coverage/coverage_cull.hpp"
#include "testbench/coverage/coverage_cycles.hpp"
#include "testbench/coverage/coverage_splat.hpp"
#include "testbench/coverage/coverage_stream.hpp"

namespace fastsplat::testbench {

/// How the run's device was driven.
struct CoverageRun {
  const cmodel::ReadyPattern* source = nullptr;
  const cmodel::ReadyPattern* sink = nullptr;
  bool sliced = false;  ///< RtlDevice::sliced()
};

class CoverageCollector {
 public:
  /// Every bin of the configuration, none hit.
  static Coverage declare(const cmodel::Config& config);

  CoverageCollector(const cmodel::Config& config, cmodel::StreamScope scope, CoverageRun run);

  /// The first beats of a stream, fed from `first_beat` on and cut off by a reset in `cycle`.
  void interrupted(std::span<const cmodel::Beat> beats, std::uint64_t first_beat, std::uint64_t cycle);
  /// Cycle since reset from which the source has a beat; before the first beat.
  void start(std::uint64_t first_beat);
  void consume(std::span<const cmodel::Beat> beats);
  void finish();

  const cmodel::StallCounters& stalls() const { return cycles_->stalls(); }  ///< after finish()
  const Coverage& coverage() const { return coverage_; }

 private:
  struct ModelTaps final : cmodel::TapSink {
    explicit ModelTaps(CoverageCollector* collector) : owner(collector) {}
    CoverageCollector* owner;
    // Densities, and pictures made of them, have words of other shapes and no bins.
    void on_tap(const cmodel::TapRecord& record) override {
      if (cmodel::holds_densities(owner->mode_)) return;
      owner->splats_.on_tap(record);
      owner->composite_.on_tap(record);
    }
  };
  void before(const cmodel::Record& record);
  void counter_bins();

  cmodel::Config config_;
  cmodel::StreamScope scope_;
  CoverageRun run_;
  Coverage coverage_;
  cmodel::StreamDecode decode_;
  cmodel::Mode mode_ = cmodel::Mode::Exponential;  ///< of the tile
  StreamCoverage stream_;
  SplatCoverage splats_;
  CompositeCoverage composite_;
  CycleCoverage times_;
  ResetCoverage resets_;
  std::optional<CullCoverage> cull_;
  ModelTaps taps_{this};
  cmodel::NullPixels pixels_;
  cmodel::Model model_;
  cmodel::CullLog culls_;
  std::optional<cmodel::CycleModel> cycles_;
};

}  // namespace fastsplat::testbench
