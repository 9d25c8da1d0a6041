// SPDX-License-Identifier: Apache-2.0
// --wave and --cycles: waveforms of runs that simulate RTL.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "testbench/check/verify.hpp"

namespace fastsplat::cli {

struct WaveFlags {
  std::string file;                   ///< empty for none
  std::optional<std::string> cycles;  ///< "A..B", both included; absent: all
};

void declare(Options& options, WaveFlags& to);

/// Abilities of the simulators that a run needs: the fast one and, for a waveform, one that writes waveforms.
std::vector<testbench::RtlAbilities> wanted_abilities(const WaveFlags& flags);

/// Cycles after reset: [from, to).
struct WaveRange {
  std::uint64_t from = 0, to = 0;
};
/// UserError (Usage) for an invalid range, a range without a file, or a name that does not end in .fst.
WaveRange range_of(const WaveFlags& flags);

/// A written waveform or why it was not; `file` is empty if none was requested.
struct Wave {
  std::string file;
  std::uint64_t from = 0, to = 0;  ///< [from, to), clipped to the run
  std::string unwritten;           ///< error if not written, one line
  ExitCode code = ExitCode::Pass;  ///< exit code of that error
};

/// Simulates once more for the waveform. `last_cycle`: end of the run; a range after it is reported in Wave::unwritten.
Wave write_wave(const WaveFlags& flags, const testbench::BeatSource& source, testbench::VerifyOptions options,
                std::uint64_t last_cycle);

/// Prints the waveform's name and cycles to stdout. A missing waveform is an error after a run that passed, and its
/// code is returned; else it is a warning, because the failure takes precedence.
ExitCode print_wave(const Wave& wave, ExitCode run, const Output& output);
/// Empty if not written.
std::string to_text(const Wave& wave);
nlohmann::ordered_json to_json(const Wave& wave);

}  // namespace fastsplat::cli
