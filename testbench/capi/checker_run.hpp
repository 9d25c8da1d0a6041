// SPDX-License-Identifier: Apache-2.0
// One stream through the checker, until reset, behind a handle of the C interface. Checks the order of the calls.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "testbench/capi/fastsplat.h"
#include "testbench/check/checker.hpp"
#include "testbench/device/pattern.hpp"

namespace fastsplat::capi {

struct CheckerSetup {
  cmodel::Config config;
  cmodel::StreamScope scope = cmodel::StreamScope::Whole;
  std::uint64_t stop_after = 1000;
  testbench::Patterns patterns;
  bool verdicts = false;
};

/// Number of 32-bit words of the port's vector; 0 if it has none. `port` is one of FASTSPLAT_PORT_...
std::size_t port_words(const cmodel::Config& config, std::uint32_t port);
[[noreturn]] void unknown_port(const char* call, std::uint32_t port);

/// Throws UserError (Usage) for a call out of order or a wrong size; `call` names the C function in it.
class CheckerRun {
 public:
  explicit CheckerRun(CheckerSetup setup);
  CheckerRun(const CheckerRun&) = delete;
  CheckerRun& operator=(const CheckerRun&) = delete;

  void start(const char* call, std::uint64_t first_beat);
  void took(const char* call, const std::uint32_t* words, std::size_t beats);
  void showed(const char* call, const fastsplat_shown& shown);
  void finish(const char* call, std::span<const std::uint64_t> counters);

  bool stopped() const { return checker_.stopped(); }
  testbench::CheckReport report() const { return checker_.report(); }
  std::int32_t verdict() const;  ///< FASTSPLAT_VERDICT_...
  std::string first_mismatch() const;
  std::string summary() const;

 private:
  void require_open(const char* call) const;

  const CheckerSetup setup_;  ///< outlives the checker, which reads its patterns
  cmodel::NullPixels pixels_;
  testbench::Checker checker_;
  bool fed_ = false, finished_ = false;
  std::uint64_t cycle_ = 0;  ///< of the last event shown
  std::string broken_;       ///< the stream's error; empty: none
};

}  // namespace fastsplat::capi
