// --wave and --cycles: a waveform of the cycles of one's choice, of any run that simulates RTL.
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

/// The simulators that a run needs: one that writes waveforms beside the fast one where a waveform is wanted.
std::vector<testbench::RtlAbilities> wanted_abilities(const WaveFlags& flags);

/// Cycles after reset: [from, to).
struct WaveRange {
  std::uint64_t from = 0, to = 0;
};
/// UserError (Usage) for what is no range, for a range without a file and for a name that does not end in .fst.
WaveRange range_of(const WaveFlags& flags);

/// A waveform that was written, or why not; `file` is empty where none was asked for.
struct Wave {
  std::string file;
  std::uint64_t from = 0, to = 0;  ///< [from, to), those that the run had
  std::string unwritten;           ///< why there is none, one line
  ExitCode code = ExitCode::Pass;  ///< that it then has
};

/// Runs the RTL once more for its waveform. `last_cycle`: where the run ended; a range that lies behind it has none.
Wave write_wave(const WaveFlags& flags, const testbench::BeatSource& source, testbench::VerifyOptions options,
                std::uint64_t last_cycle);

/// What became of it: its name and cycles to stdout. Why there is none is an error after a run that passed, whose exit
/// code this returns; else a warning, for the failure comes first.
ExitCode tell(const Wave& wave, ExitCode run, const Output& output);
/// Empty where there is none.
std::string to_text(const Wave& wave);
nlohmann::ordered_json to_json(const Wave& wave);

}  // namespace fastsplat::cli
