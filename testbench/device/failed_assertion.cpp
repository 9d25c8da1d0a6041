// SPDX-License-Identifier: Apache-2.0
#include "testbench/device/failed_assertion.hpp"

#include <cstring>

namespace fastsplat::testbench {

FailedAssertion first_failed_assertion(const std::string& output) {
  constexpr const char* kError = "%Error: ";
  constexpr const char* kFailed = ": Assertion failed in ";
  const auto failed = output.find(kFailed);
  if (failed == std::string::npos) return {};
  const auto error = output.rfind(kError, failed), place = error + std::strlen(kError);
  const auto path = failed + std::strlen(kFailed), end = output.find_first_of(":\n", path);
  FailedAssertion out;
  if (error != std::string::npos) out.place = output.substr(place, failed - place);
  out.path = output.substr(path, end - path);
  const auto dot = out.path.rfind('.');
  out.name = out.path.substr(dot + 1);
  if (dot != std::string::npos) out.path.resize(dot);
  if (out.path.starts_with("TOP.")) out.path.erase(0, 4);
  return out;
}

}  // namespace fastsplat::testbench
