// SPDX-License-Identifier: Apache-2.0
#include "cli/wave_flags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "testbench/triage/waveform.hpp"

namespace fastsplat::cli {
namespace {

constexpr std::uint64_t kAll = std::numeric_limits<std::uint64_t>::max();

}  // namespace

void declare(Options& options, WaveFlags& to) {
  options.word("--wave", to.file, "FILE",
               "rtl: write a waveform, .fst, and its GTKWave view, .gtkw; this simulates the run once more");
  options.word("--cycles", to.cycles, "A..B", "cycles of the waveform after reset, both included (all)");
}

std::vector<testbench::RtlAbilities> wanted_abilities(const WaveFlags& flags) {
  std::vector<testbench::RtlAbilities> abilities(1);
  if (!flags.file.empty()) abilities.push_back({.wave = true});
  return abilities;
}

WaveRange range_of(const WaveFlags& flags) {
  if (flags.file.empty()) {
    if (flags.cycles)
      throw_usage(
          {.where = "--cycles", .what = "requires --wave", .expected = {}, .got = {}, .fix = "add --wave FILE.fst"});
    return {};
  }
  if (!flags.file.ends_with(".fst")) {
    throw_usage({.where = "--wave " + flags.file,
                 .what = "the name of a waveform must end in .fst",
                 .expected = {},
                 .got = {},
                 .fix = "for example --wave run.fst; GTKWave's fst2vcd converts it to VCD"});
  }
  if (!flags.cycles) return {.from = 0, .to = kAll};
  const std::string& text = *flags.cycles;
  const auto dots = text.find("..");
  const auto from = integer_from<std::uint64_t>(std::string_view(text).substr(0, dots));
  const auto to =
      dots == std::string::npos ? std::nullopt : integer_from<std::uint64_t>(std::string_view(text).substr(dots + 2));
  if (!from || !to || *to < *from) {
    throw_usage({.where = "--cycles",
                 .what = "not a range of cycles",
                 .expected = "A..B, whole numbers from 0, A no more than B",
                 .got = "'" + text + "'",
                 .fix = "for example --cycles 300..400"});
  }
  return {.from = *from, .to = *to == kAll ? kAll : *to + 1};
}

Wave write_wave(const WaveFlags& flags, const testbench::BeatSource& source, testbench::VerifyOptions options,
                std::uint64_t last_cycle) {
  const WaveRange range = range_of(flags);
  if (flags.file.empty()) return {};
  if (range.from >= last_cycle) {
    return {.file = flags.file,
            .unwritten = one_line({.where = "--cycles",
                                   .what = "the run ends before these cycles; no waveform was written",
                                   .expected = fmt::format("cycles from 0 to {}", last_cycle - 1),
                                   .got = *flags.cycles,
                                   .fix = "use cycles in this range"}),
            .code = ExitCode::Usage};
  }
  Wave wave{.file = flags.file, .from = range.from, .to = std::min(range.to, last_cycle), .unwritten = {}};
  options.wave = flags.file;
  options.wave_from = wave.from;
  options.wave_to = wave.to;
  wave.unwritten = testbench::write_waveform(source, options);
  if (!wave.unwritten.empty()) wave.code = ExitCode::Input;
  return wave;
}

ExitCode print_wave(const Wave& wave, ExitCode run, const Output& output) {
  if (const std::string text = to_text(wave); !text.empty()) output.line(text);
  if (wave.unwritten.empty()) return run;
  if (run != ExitCode::Pass) {
    output.warn(wave.unwritten);
    return run;
  }
  print_error(wave.unwritten);
  return wave.code;
}

std::string to_text(const Wave& wave) {
  if (wave.file.empty() || !wave.unwritten.empty()) return {};
  return fmt::format("waveform: {} (cycles {} to {})\n", wave.file, wave.from, wave.to - 1);
}

nlohmann::ordered_json to_json(const Wave& wave) {
  if (!wave.unwritten.empty()) return {{"file", ""}, {"unwritten", wave.unwritten}};
  return {{"file", wave.file}, {"from", wave.from}, {"to", wave.to - 1}, {"unwritten", ""}};
}

}  // namespace fastsplat::cli
