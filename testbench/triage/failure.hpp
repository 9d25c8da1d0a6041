// SPDX-License-Identifier: Apache-2.0
// Report on a failing stream: the divergence in words with its operands, the stream made small, a waveform of the
// cycles around the divergence.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "testbench/check/verify.hpp"
#include "testbench/triage/pixel_words.hpp"
#include "testbench/triage/rtl_place.hpp"
#include "testbench/triage/shrink.hpp"

namespace fastsplat::testbench {

struct FailureReport {
  std::string original;    ///< first divergence of the original stream
  std::string divergence;  ///< of the small stream: stage, place, both values, bit difference; or the device's behaviour
  std::string operands;    ///< the model's operands; may be empty
  std::optional<RtlPlace> place;  ///< the module and instance that make the diverging word
  std::optional<TilePixel> pixel;  ///< of the small stream, whose word diverged
  ShrinkReport shrink;
  std::uint64_t wave_from = 0, wave_to = 0;  ///< cycles of the waveform
  std::string no_waveform;                   ///< why the requested waveform is missing
  VerifyOptions options;                     ///< of the replay: they fail with the small stream
  StreamDocument document;
  /// What ended the run behind a mismatch, such as an assertion that failed; empty: nothing.
  std::string stopped_by;
};

/// The first difference of a run that failed, as text: stage, place, both values; or the device's behaviour.
std::string first_divergence(const VerifyResult& result, const cmodel::Config& config);

/// Runs a failing stream again, smaller and smaller (at most `most_runs` times), and reports the smallest. Writes the
/// waveform if it has a path; writing the stream is the caller's.
FailureReport investigate(const BeatSource& source, const VerifyOptions& options, const VerifyResult& failed,
                          const std::filesystem::path& waveform, int most_runs);

}  // namespace fastsplat::testbench
