// SPDX-License-Identifier: Apache-2.0
#include "testbench/capi/guard.hpp"

#include <algorithm>
#include <cstring>

namespace fastsplat::capi {
namespace {

constexpr std::size_t kLongest = 4096;
thread_local char last_error[kLongest] = "";

}  // namespace

fastsplat_status fail(fastsplat_status status, const char* text) noexcept {
  const std::size_t length = std::min(std::strlen(text), kLongest - 1);
  std::memmove(last_error, text, length);
  last_error[length] = '\0';
  return status;
}

extern "C" FASTSPLAT_API const char* fastsplat_last_error(void) { return last_error; }

}  // namespace fastsplat::capi
