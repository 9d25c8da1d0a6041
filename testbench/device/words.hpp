// SPDX-License-Identifier: Apache-2.0
// Text of the device's words in reports and bins.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace fastsplat::testbench {

/// Names of colours, sums and X-ray sums, in the order of their words.
inline constexpr const char* kChannels[] = {"R", "G", "B", "tau"};

/// "0x1F", "-0x1F".
inline std::string hex(std::int64_t value) {
  char text[24];
  std::snprintf(text, sizeof text, "%s0x%llX", value < 0 ? "-" : "",
                static_cast<unsigned long long>(value < 0 ? -value : value));
  return text;
}

}  // namespace fastsplat::testbench
