// SPDX-License-Identifier: Apache-2.0
#include "testbench/check/verdict_check.hpp"

namespace fastsplat::testbench {
namespace {

std::string words(const cmodel::VerdictCycles& verdict) {
  return "tag " + std::to_string(verdict.tag) + (verdict.hidden ? " hidden" : " visible") + " in cycle " +
         std::to_string(verdict.reported);
}

}  // namespace

std::optional<std::string> VerdictCheck::compare(const RawTap& tap) {
  const cmodel::VerdictCycles got{.tag = tap.tag, .hidden = tap.hidden, .reported = tap.cycle};
  if (expected_.empty()) return "verdict: expected none, RTL " + words(got);
  const cmodel::VerdictCycles expected = expected_.front();
  expected_.pop_front();
  if (got == expected) return std::nullopt;
  return "verdict: expected " + words(expected) + ", RTL " + words(got);
}

std::optional<std::string> VerdictCheck::missing() {
  if (expected_.empty()) return std::nullopt;
  const cmodel::VerdictCycles expected = expected_.front();
  expected_.pop_front();
  return "verdict: expected " + words(expected) + ", RTL none";
}

}  // namespace fastsplat::testbench
