// SPDX-License-Identifier: Apache-2.0
// When a register slice takes and offers transfers (rtl/io/fastsplat_slice.sv), computed from the transfers alone. It
// holds two: the front one and a spare. Its valid and its ready both come from registers.
#pragma once

#include <algorithm>
#include <cstdint>

namespace fastsplat::cmodel {

class RegisterSlice {
 public:
  /// The earliest cycle in which it takes the next transfer: its spare register is empty.
  std::uint64_t free() const { return free_; }
  /// The first cycle in which it offers a transfer that it took in that one.
  std::uint64_t offers(std::uint64_t taken) const { return std::max(taken, left_) + 1; }
  /// A transfer comes in cycle `taken` and goes in cycle `left`.
  void pass(std::uint64_t taken, std::uint64_t left) {
    free_ = offers(taken);
    left_ = left;
  }

 private:
  std::uint64_t free_ = 1;  ///< ready is low in the first cycle after a reset
  std::uint64_t left_ = 0;  ///< of the transfer before
};

}  // namespace fastsplat::cmodel
