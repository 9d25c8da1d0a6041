// SPDX-License-Identifier: Apache-2.0
#include "testbench/capi/tap_queue.hpp"

namespace fastsplat::capi {
namespace {

/// tap, tile, sheet, tag, x, y, words of the payload, which follow.
constexpr std::size_t kHeader = 7;

}  // namespace

void TapQueue::push(const cmodel::TapRecord& record) {
  data_.insert(data_.end(), {static_cast<std::uint32_t>(record.tap), record.tile, record.sheet, record.tag,
                             static_cast<std::uint32_t>(record.x), static_cast<std::uint32_t>(record.y),
                             static_cast<std::uint32_t>(record.payload.size())});
  data_.insert(data_.end(), record.payload.begin(), record.payload.end());
}

bool TapQueue::pop(fastsplat_tap& out) {
  if (head_ == data_.size()) return false;
  const std::uint32_t* record = data_.data() + head_;
  out = {.struct_size = sizeof(fastsplat_tap),
         .tap = record[0],
         .tile = record[1],
         .sheet = record[2],
         .tag = record[3],
         .x = static_cast<std::int32_t>(record[4]),
         .y = static_cast<std::int32_t>(record[5]),
         .words = record[6],
         .payload = record + kHeader};
  head_ += kHeader + record[6];
  return true;
}

void TapQueue::sweep() {
  // Amortised: no more is moved than was taken.
  if (head_ * 2 < data_.size()) return;
  data_.erase(data_.begin(), data_.begin() + static_cast<std::ptrdiff_t>(head_));
  head_ = 0;
}

}  // namespace fastsplat::capi
