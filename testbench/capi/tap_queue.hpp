// SPDX-License-Identifier: Apache-2.0
// Tap records that wait to be taken, in order, in one flat array: no allocation per record.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cmodel/stream/taps.hpp"
#include "testbench/capi/fastsplat.h"

namespace fastsplat::capi {

class TapQueue {
 public:
  void push(const cmodel::TapRecord& record);
  /// False if the queue is empty. `out`'s payload lies in the queue until the next push or sweep.
  bool pop(fastsplat_tap& out);
  /// Drops the taken records.
  void sweep();

 private:
  std::vector<std::uint32_t> data_;
  std::size_t head_ = 0;
};

}  // namespace fastsplat::capi
