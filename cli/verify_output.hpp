// What `verify` says of a run: its result in words and as JSON, a failure with the files that show it again.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/verify_run.hpp"
#include "testbench/triage/failure.hpp"

namespace fastsplat::cli {

/// A failure in words, with the files that show it again.
struct Failure {
  testbench::FailureReport report;
  std::string stream, waveform, replay;  ///< empty where there is none
  std::vector<std::string> unwritten;    ///< why there is none
};

/// What cannot be written does not take the failure away. No files where the prefix is empty.
Failure investigate(const Checked& checked, const VerifyArguments& arguments, const ConfigFlags& config,
                    const std::string& prefix);

/// How much of the configuration's coverage is hit, this run's added to what the file held.
struct Gain {
  std::string path;
  std::size_t bins = 0, hit = 0;
};

/// A random stream in a file, and the command that runs it.
struct SavedStream {
  std::string file, replay;
};

/// Everything said about a run.
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
  std::vector<std::string> unwritten;  ///< why coverage or streams are not written
  double seconds = 0.0;
};

std::string to_text(const Failure& failure);
/// Verdict, first divergence and what shows it again, in one line. `fault`: that was planted; empty for none.
std::string in_short(testbench::Verdict verdict, const Failure& failure, const std::string& fault);
std::string to_text(const Gain& gain);
/// The fault that was planted; empty for none.
std::string planted_text(const VerifyArguments& arguments);
/// Verdict and counts.
std::string to_text(const VerifyReport& report);
/// How many of `streams` were saved, and the replay of the last.
std::string saved_text(const std::vector<SavedStream>& saved, std::size_t streams);
/// The rows of --all-mismatches; empty without it.
std::string mismatches_text(const VerifyReport& report);
nlohmann::ordered_json to_json(const VerifyReport& report);

/// The faults that can be planted, a line each.
std::string fault_list_text();
nlohmann::ordered_json fault_list_json();

}  // namespace fastsplat::cli
