// SPDX-License-Identifier: Apache-2.0
#include "testbench/check/verify.hpp"

#include <algorithm>

#include "cmodel/io/register_map.hpp"
#include "testbench/coverage/coverage_collector.hpp"

namespace fastsplat::testbench {
namespace {

std::unique_ptr<RtlDevice> make_device(const VerifyOptions& options, cmodel::PixelSink& pixels, RawTapSink& taps) {
  RtlOptions rtl = rtl_options(options);
  rtl.taps = &taps;
  return options.device ? options.device(pixels, rtl) : make_rtl_device(options.config, pixels, rtl);
}

/// Feeds the first beats, then resets in the middle of the work that they started.
void interrupt(CheckedDevice& checked, const BeatSource& source, std::uint64_t after, int wait, int cycles,
               CoverageCollector* coverage) {
  checked.unchecked([&](RtlDevice& device) {
    const std::uint64_t first_beat = device.cycles();
    std::uint64_t left = after;
    std::vector<cmodel::Beat> fed;
    source([&](std::span<const cmodel::Beat> beats) {
      const auto part = beats.first(static_cast<std::size_t>(std::min<std::uint64_t>(left, beats.size())));
      device.consume(part);
      if (coverage != nullptr) fed.insert(fed.end(), part.begin(), part.end());
      left -= part.size();
    });
    if (left > 0) {
      throw_usage({.where = "warm reset after beat " + std::to_string(after),
                   .what = "the stream ends before this beat",
                   .expected = "at most " + std::to_string(after - left),
                   .got = std::to_string(after),
                   .fix = "lower --reset-after"});
    }
    if (wait > 0) device.read_register(cmodel::kRegStatus.address, wait);
    if (coverage != nullptr) coverage->interrupted(fed, first_beat, device.cycles());
    device.warm_reset(cycles);
  });
}

}  // namespace

BeatSource source_of(std::vector<cmodel::Beat> beats) {
  return [beats = std::make_shared<const std::vector<cmodel::Beat>>(std::move(beats))](const BeatSink& sink) {
    sink(*beats);
  };
}

RtlOptions rtl_options(const VerifyOptions& options) {
  const Patterns patterns = patterns_of(options.input, options.ready, options.seed);
  return {.input = patterns.input,
          .output = patterns.ready,
          .fill = options.fill,
          .seed = options.seed,
          .timeout = options.timeout + patterns.input.longest_wait() + patterns.ready.longest_wait(),
          .taps = nullptr,
          .wave = options.wave,
          .wave_from = options.wave_from,
          .wave_to = options.wave_to,
          .wave_after_reset = options.reset_after > 0};
}

VerifyResult verify(const BeatSource& source, const VerifyOptions& options, cmodel::PixelSink* pixels) {
  cmodel::NullPixels none;
  const RtlOptions driven = rtl_options(options);
  CheckedDevice checked(
      options.config, options.scope, pixels == nullptr ? none : *pixels,
      [&](cmodel::PixelSink& tiles, RawTapSink& taps) { return make_device(options, tiles, taps); },
      {.stop_after = options.stop_after, .keep = options.keep, .source = &driven.input, .sink = &driven.output});
  std::optional<CoverageCollector> coverage;
  if (options.coverage) {
    coverage.emplace(options.config, options.scope,
                     CoverageRun{.source = &driven.input, .sink = &driven.output, .sliced = checked.device().sliced()});
  }
  VerifyResult out;
  try {
    if (options.reset_after > 0)
      interrupt(checked, source, options.reset_after, options.reset_wait, options.reset_cycles,
                coverage ? &*coverage : nullptr);
    if (coverage) coverage->start(checked.device().cycles());
    source([&](std::span<const cmodel::Beat> beats) {
      checked.consume(beats);
      if (coverage && !checked.stopped()) coverage->consume(beats);
    });
    checked.finish();
    if (coverage && !checked.stopped()) coverage->finish();
  } catch (const UserError& error) {
    if (error.code() != ExitCode::Simulation) throw;
    out.error = error.what();
    out.fault = error.parts().what;
  }
  out.check = checked.report();
  out.counters = checked.counters();
  out.last_cycle = checked.device().cycles();
  if (out.check.mismatches > 0) {
    out.verdict = Verdict::Mismatch;
  } else if (!out.error.empty()) {
    out.verdict = Verdict::Simulation;
  } else {
    const auto& taps = out.check.by_tap;
    const bool compared = std::any_of(taps.begin(), taps.end(), [](std::uint64_t count) { return count > 0; });
    out.verdict = compared ? Verdict::Pass : Verdict::NothingCompared;
  }
  if (coverage && out.verdict == Verdict::Pass) out.coverage = std::make_shared<const Coverage>(coverage->coverage());
  return out;
}

const char* to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::Pass:
      return "pass";
    case Verdict::Mismatch:
      return "mismatch";
    case Verdict::NothingCompared:
      return "nothing compared";
    case Verdict::Simulation:
      return "simulation";
    case Verdict::FaultUnseen:
      return "fault not seen";
  }
  return "?";
}

ExitCode exit_code(Verdict verdict) {
  if (verdict == Verdict::Pass) return ExitCode::Pass;
  return verdict == Verdict::Simulation ? ExitCode::Simulation : ExitCode::Failed;
}

}  // namespace fastsplat::testbench
