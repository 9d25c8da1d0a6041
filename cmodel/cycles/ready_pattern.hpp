// SPDX-License-Identifier: Apache-2.0
// Ready pattern: when one side of a ready/valid channel is ready, as a pure function of the clock cycle.
#pragma once

#include <cstdint>

namespace fastsplat::cmodel {

class ReadyPattern {
 public:
  virtual ~ReadyPattern() = default;
  /// The first ready cycle at or after `cycle`. There must be one.
  virtual std::uint64_t next(std::uint64_t cycle) const = 0;
};

}  // namespace fastsplat::cmodel
