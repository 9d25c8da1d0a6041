// SPDX-License-Identifier: Apache-2.0
// Coverage of tiles that composite every sample, from the cycle model's Composite taps. Bins are the cycles until a
// pixel is met again, and windows that just overlap the previous one or just miss it (docs/microarchitecture.md, "Every
// sample").
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/taps.hpp"
#include "testbench/coverage/coverage.hpp"

namespace fastsplat::testbench {

class SampleCoverage {
 public:
  SampleCoverage(const cmodel::Config& config, Coverage& coverage);

  void begin_tile(int width, int height);
  /// A window's samples were composited.
  void window(const cmodel::TapRecord& record);

 private:
  using Id = Coverage::Id;
  void neighbour(const cmodel::TapRecord& record);
  void distance(const cmodel::TapRecord& record);

  int lanes_, width_ = 0, height_ = 0;
  Coverage& coverage_;
  std::size_t columns_;
  std::vector<std::uint64_t> written_;  ///< cycle in which a pixel of the tile was composited last; 0: not yet
  std::uint64_t last_ = 0;              ///< of the window before; 0: none
  std::uint32_t tag_ = 0;
  std::int32_t x_ = 0, y_ = 0;
  Id distance_ = 0, whole_ = 0, part_ = 0, beside_ = 0, corner_ = 0;
};

}  // namespace fastsplat::testbench
