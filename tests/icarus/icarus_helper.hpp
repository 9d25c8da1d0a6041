// SPDX-License-Identifier: Apache-2.0
// Icarus Verilog as a second simulator: compiles rtl/ unchanged, plays streams to it and reads back its output.
// Four-state: an unset bit is X, and stays X wherever it matters.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"
#include "testbench/device/pattern.hpp"

namespace fastsplat::test {

/// Reset for `reset` cycles, then `beats` beats; then until the device is at rest, or, if `linger` is not negative, for
/// so many cycles: the next play's reset cuts it off.
struct Play {
  int reset = 4;
  std::size_t beats = 0;
  int linger = -1;
  std::size_t input = 0, ready = 0;  ///< of `Played::patterns`
};

struct Played {
  std::vector<cmodel::Beat> beats;
  std::vector<testbench::Pattern> patterns;  ///< at most 16
  std::vector<Play> plays;
};

/// A beat of pixels as written: a word's text holds an X where the device's word does.
struct PixelBeat {
  std::string last, keep, data;
};

/// The output of one play. For a play that was cut off: the pixels taken before.
struct PlayResult {
  std::vector<PixelBeat> pixels;
  std::vector<std::uint64_t> counters;  ///< all registers, in their order; of a play to rest
  std::uint64_t cycles = 0;
};

struct Transcript {
  std::string power_up;            ///< the outputs before the first reset
  std::vector<std::string> wrong;  ///< unknown values where none may be, unrequested answers, hangs
  std::map<int, PlayResult> plays;
  bool ended = false;  ///< all plays were played
};

/// How always_comb is read. Icarus 11 gives all such blocks one common event, so that each runs whenever any of them
/// does. Two blocks that pass on an intermediate value (a default, then the final one) wake each other for ever, in the
/// same time step (its issue 508, fixed after 11.0). As `always @*` each waits only for the signals that it reads.
enum class Combinational { AsWritten, AlwaysStar };

class Icarus {
 public:
  /// Empty if both iverilog and vvp can be run; otherwise the reason.
  static std::string missing();
  static std::string version();

  /// Compiles the device of `config`. `edits`: texts of rtl/ that are replaced, each found exactly once.
  Icarus(const cmodel::Config& config, const std::string& name,
         const std::vector<std::pair<std::string, std::string>>& edits = {},
         Combinational combinational = Combinational::AsWritten);

  Transcript play(const Played& played) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace fastsplat::test
