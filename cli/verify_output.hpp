// SPDX-License-Identifier: Apache-2.0
// Output of `verify`: the result as text and JSON, and a failure with the files that reproduce it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/verify_run.hpp"
#include "testbench/triage/failure.hpp"

namespace fastsplat::cli {

/// A failure as text, with the files that reproduce it.
struct Failure {
  testbench::FailureReport report;
  std::string stream, waveform, replay, follow;  ///< empty if absent; the last two are commands
  std::vector<std::string> unwritten;    ///< errors of files that could not be written
};

/// Shrinks a failure and writes its files; write errors go to Failure::unwritten. Writes no files if `prefix` is empty.
Failure investigate(const Checked& checked, const VerifyArguments& arguments, const ConfigFlags& config,
                    const std::string& prefix);

/// Coverage of the configuration: this run's added to the file's.
struct Gain {
  std::string path;
  std::size_t bins = 0, hit = 0;
};

/// A saved random stream, and the command that replays it.
struct SavedStream {
  std::string file, replay;
};

/// Everything reported about a run.
struct VerifyReport {
  const VerifyArguments& arguments;
  cmodel::Config config;
  std::uint64_t streams = 0, resets_late = 0;
  testbench::VerifyResult run;
  std::vector<testbench::SeedResult> by_seed;
  std::vector<testbench::StreamResult> by_stream;
  std::vector<testbench::StreamDivergence> kept;  ///< for --all-mismatches
  std::optional<Failure> failure;
  std::optional<Gain> coverage;
  std::vector<SavedStream> saved;
  Wave wave;
  std::vector<std::string> unwritten;  ///< errors of coverage or streams that could not be written
  double seconds = 0.0;
};

std::string to_text(const Failure& failure);
/// Verdict, first divergence, files and replay command in one line. `fault`: the planted fault; empty for none.
std::string in_short(testbench::Verdict verdict, const Failure& failure, const std::string& fault);
std::string to_text(const Gain& gain);
/// The planted fault as text; empty for none.
std::string planted_text(const VerifyArguments& arguments);
/// Verdict and counts.
std::string to_text(const VerifyReport& report);
/// How many of `streams` were saved, and the replay command of the last.
std::string saved_text(const std::vector<SavedStream>& saved, std::size_t streams);
/// The rows of --all-mismatches; empty without it.
std::string mismatches_text(const VerifyReport& report);
nlohmann::ordered_json to_json(const VerifyReport& report);

/// All faults that can be planted, one per line.
std::string fault_list_text();
nlohmann::ordered_json fault_list_json();

}  // namespace fastsplat::cli
