// SPDX-License-Identifier: Apache-2.0
// A run's timeline in the Trace Event format (chrome://tracing, ui.perfetto.dev): one track per unit, one slice per
// sheet.
#pragma once

#include <string>

#include "cmodel/cycles/cycle_model.hpp"

namespace fastsplat::cli {

class CycleTrace final : public cmodel::CycleSink {
 public:
  CycleTrace();
  void on_sheet(const cmodel::SheetCycles& sheet) override;
  void on_tile(const cmodel::TileCycles& tile) override;
  /// The complete file. One microsecond stands for one cycle.
  std::string text() const;

 private:
  void slice(int track, const std::string& name, std::uint64_t from, std::uint64_t to, const std::string& arguments);
  std::string events_;
};

}  // namespace fastsplat::cli
