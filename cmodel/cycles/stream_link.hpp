// SPDX-License-Identifier: Apache-2.0
// The stream link that devices share: B bytes a cycle in all, one beat after the other (docs/scaling.md, "Link").
#pragma once

#include <cstdint>

#include "cmodel/stream/beat.hpp"

namespace fastsplat::cmodel {

class StreamLink {
 public:
  /// `bytes_per_cycle` 0: no limit.
  explicit StreamLink(std::uint64_t bytes_per_cycle) : rate_(bytes_per_cycle) {}

  /// The cycle in which the next beat begins.
  std::uint64_t cycle() const { return rate_ == 0 ? at_ : at_ / rate_; }
  /// Nothing is carried before `from`: the bytes up to there are lost.
  void wait_until(std::uint64_t from) {
    if (from > cycle()) at_ = rate_ == 0 ? from : from * rate_;
  }
  /// Carries a beat; returns the cycle in which it arrives.
  std::uint64_t carry() {
    ++beats_;
    if (rate_ == 0) return at_;
    at_ += kBeatBytes;
    return (at_ - 1) / rate_;
  }
  bool limited() const { return rate_ > 0; }
  /// Counts a beat that need not wait for others.
  void pass() { ++beats_; }
  /// Beats carried so far.
  std::uint64_t beats() const { return beats_; }

 private:
  std::uint64_t rate_;
  std::uint64_t at_ = 0;  ///< number of the next byte, counting lost ones; without a limit, a cycle
  std::uint64_t beats_ = 0;
};

}  // namespace fastsplat::cmodel
