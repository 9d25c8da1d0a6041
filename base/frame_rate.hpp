// SPDX-License-Identifier: Apache-2.0
// Time and rate of frames of so many cycles. Only these are printed and compared, so that equal ones are equal.
#pragma once

#include <cstdint>

namespace fastsplat {

inline double frames_per_second(std::uint64_t cycles, double clock_mhz) {
  return 1e6 * clock_mhz / static_cast<double>(cycles);
}
inline double frame_milliseconds(std::uint64_t cycles, double clock_mhz) {
  return static_cast<double>(cycles) / (1e3 * clock_mhz);
}

}  // namespace fastsplat
