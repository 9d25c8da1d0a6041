// SPDX-License-Identifier: Apache-2.0
// A failing stream made small: delta debugging over tiles, sheets, splats and tables.
#pragma once

#include <functional>

#include "testbench/stimulus/stream_document.hpp"

namespace fastsplat::testbench {

struct ShrinkReport {
  int runs = 0;           ///< of `fails`
  bool finished = false;  ///< nothing more can be left out, one at a time
  std::uint64_t splats_before = 0, splats_after = 0;
};

/// The smallest part of `document` found that still fails, with at most `most_runs` runs of `fails`. Every candidate is
/// legal; `fails(document)` must be true.
StreamDocument shrink(StreamDocument document, const std::function<bool(const StreamDocument&)>& fails, int most_runs,
                      ShrinkReport& report);

}  // namespace fastsplat::testbench
