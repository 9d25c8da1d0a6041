// SPDX-License-Identifier: Apache-2.0
// One stream through the checked RTL: verdict, numbers, first divergence.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "testbench/check/checked_device.hpp"
#include "testbench/coverage/coverage.hpp"
#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {

using cmodel::BeatSink;
using cmodel::BeatSource;
BeatSource source_of(std::vector<cmodel::Beat> beats);

struct VerifyOptions {
  cmodel::Config config;
  cmodel::StreamScope scope = cmodel::StreamScope::Whole;
  std::string ready = "always";  ///< pattern of the pixel output
  std::string input = "always";  ///< pattern of the stream input
  ResetFill fill = ResetFill::Random;
  std::uint64_t seed = 1;           ///< of patterns and fill
  std::uint64_t reset_after = 0;    ///< beats before a warm reset, after which the whole stream is fed; 0: none; more
                                    ///< than the stream has: UserError (Usage)
  int reset_wait = 0;               ///< about so many cycles between the last of those beats and the reset
  int reset_cycles = kResetCycles;  ///< length of that reset
  std::uint64_t timeout = 1u << 20;
  std::uint64_t stop_after = 1000;           ///< mismatches
  std::size_t keep = 0;                      ///< number of divergences listed in CheckReport::kept
  std::filesystem::path wave;                ///< waveform of the cycles [wave_from, wave_to)
  std::uint64_t wave_from = 0, wave_to = 0;  ///< after the warm reset, if there is one
  bool coverage = false;  ///< samples functional coverage (testbench/coverage/coverage_collector.hpp)
  /// Replaces the RTL, to test the checker with a faulty device; empty: the Verilated device of `config`.
  std::function<std::unique_ptr<RtlDevice>(cmodel::PixelSink&, const RtlOptions&)> device;
};

enum class Verdict {
  Pass,
  Mismatch,
  NothingCompared,
  Simulation,
  FaultUnseen,  ///< nothing differs although a fault was planted; verify() never returns it
};
const char* to_string(Verdict verdict);
ExitCode exit_code(Verdict verdict);

struct VerifyResult {
  Verdict verdict = Verdict::NothingCompared;
  CheckReport check;
  cmodel::Counters counters;                 ///< the RTL's; if the run was stopped, the model's so far
  std::uint64_t last_cycle = 0;              ///< after reset, at the end of the run
  std::string error;                         ///< of Verdict::Simulation: the device's behaviour, place and cycle
  std::string fault;                         ///< the same without where and when
  std::shared_ptr<const Coverage> coverage;  ///< of a run that passed, if asked for
};

/// Options of the device that verify() makes.
RtlOptions rtl_options(const VerifyOptions& options);

/// `pixels` receives the RTL's tiles; may be null. Throws UserError (Input) for an illegal stream.
VerifyResult verify(const BeatSource& source, const VerifyOptions& options, cmodel::PixelSink* pixels = nullptr);

}  // namespace fastsplat::testbench
