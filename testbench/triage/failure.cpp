// SPDX-License-Identifier: Apache-2.0
#include "testbench/triage/failure.hpp"

#include <algorithm>
#include <optional>

#include "cmodel/decode/stream_decode.hpp"
#include "testbench/triage/explain.hpp"
#include "testbench/triage/waveform.hpp"

namespace fastsplat::testbench {
namespace {

constexpr std::uint64_t kCyclesBefore = 64, kCyclesAfter = 16;  ///< of the waveform, around the divergence
/// A candidate that hangs is given up sooner than the full stream: no stream that fits one tile waits this long.
constexpr std::uint64_t kShrinkTimeout = 1u << 16;

/// The same failure: a mismatch at the same tap (or in no tap at all), or the same kind of stop.
bool same_failure(const VerifyResult& a, const VerifyResult& b) {
  if (a.verdict != b.verdict || a.check.first.has_value() != b.check.first.has_value()) return false;
  const auto tap = [](const Divergence& d) { return d.model ? d.model->tap : d.rtl->tap; };
  if (a.check.first) return tap(*a.check.first) == tap(*b.check.first);
  return a.fault == b.fault;
}

/// The stream as a tree: all of it, or its tables and one tile.
StreamDocument gather(const BeatSource& source, const cmodel::Config& config, std::optional<std::uint32_t> only) {
  std::vector<cmodel::Beat> beats;
  cmodel::StreamDecode decode(config, cmodel::StreamScope::Subset);
  bool keep = true;
  source([&](std::span<const cmodel::Beat> part) {
    for (const auto& beat : part) {
      const cmodel::Record* record = decode.feed(beat);
      const auto* tile = record == nullptr ? nullptr : std::get_if<cmodel::BeginTile>(record);
      if (tile != nullptr) keep = !only || tile->tile == *only;
      if (keep) beats.push_back(beat);
    }
  });
  return read_document(config, beats);
}

/// Starts from the tile that diverged where that alone fails; else from the whole stream.
StreamDocument start(const BeatSource& source, const cmodel::Config& config, const VerifyResult& failed,
                     const std::function<bool(const StreamDocument&)>& fails) {
  if (const auto& diverged = failed.check.first) {
    StreamDocument tile = gather(source, config, (diverged->model ? diverged->model : diverged->rtl)->tile);
    if (fails(tile)) return tile;
  }
  return gather(source, config, std::nullopt);
}

int halo_of(const StreamDocument& document, const Divergence& divergence) {
  const std::uint32_t number = (divergence.model ? divergence.model : divergence.rtl)->tile;
  const auto tile = std::ranges::find(document.tiles, number, [](const auto& one) { return one.begin.tile; });
  return tile != document.tiles.end() && cmodel::holds_densities(tile->begin.mode) ? 1 : 0;
}

}  // namespace

std::string first_divergence(const VerifyResult& result, const cmodel::Config& config) {
  if (result.check.first) return describe(config, *result.check.first);
  if (!result.check.differences.empty()) return result.check.differences.front();
  return result.error;
}

FailureReport investigate(const BeatSource& source, const VerifyOptions& options, const VerifyResult& failed,
                          const std::filesystem::path& waveform, int most_runs) {
  FailureReport report;
  report.options = options;
  report.options.wave.clear();
  report.options.scope = cmodel::StreamScope::Whole;
  VerifyOptions trial = report.options;
  trial.stop_after = 1;
  trial.timeout = std::min(options.timeout, kShrinkTimeout);
  const auto fails = [&](const StreamDocument& candidate) {
    VerifyOptions run = trial;
    const auto beats = write_document(options.config, candidate);
    run.reset_after = std::min<std::uint64_t>(run.reset_after, beats.size());
    try {
      return same_failure(failed, verify(source_of(beats), run));
    } catch (const UserError& error) {
      if (error.code() != ExitCode::Input) throw;
      return false;  // a cull_block covers fewer splats than it announces
    }
  };
  report.original = first_divergence(failed, options.config);
  report.document = shrink(start(source, options.config, failed, fails), fails, most_runs, report.shrink);
  // A file has to cover its image. The device has no image, so it fails in the same way; if not, the stream stays as it
  // is.
  if (StreamDocument whole = arranged(report.document); fails(whole)) report.document = std::move(whole);

  const auto beats = write_document(options.config, report.document);
  report.options.reset_after = std::min<std::uint64_t>(options.reset_after, beats.size());
  VerifyOptions last = report.options;
  last.stop_after = 1;
  last.timeout = trial.timeout;
  const VerifyResult smallest = verify(source_of(beats), last);
  report.divergence = first_divergence(smallest, options.config);
  if (smallest.check.mismatches > 0) report.stopped_by = smallest.error;
  const auto& diverged = smallest.check.first;
  if (diverged) {
    report.operands = explain(source_of(beats), options.config, *diverged);
    report.pixel = pixel_of(options.config, *diverged);
    report.place = rtl_place(options.config, *diverged, halo_of(report.document, *diverged));
  }
  const std::uint64_t cycle = diverged && diverged->rtl ? diverged->rtl->cycle : smallest.last_cycle;
  report.wave_from = cycle > kCyclesBefore ? cycle - kCyclesBefore : 0;
  report.wave_to = cycle + kCyclesAfter;
  if (!waveform.empty()) {
    // The device runs on past the divergence, so the waveform has what follows it.
    last.stop_after = options.stop_after;
    last.wave = waveform;
    last.wave_from = report.wave_from;
    last.wave_to = report.wave_to;
    const auto same = [&](const VerifyResult& run) {
      return same_failure(smallest, run) && (!diverged || first_divergence(run, options.config) == report.divergence);
    };
    const WaveFocus focus{.cycle = cycle, .instance = report.place ? report.place->instance : ""};
    report.no_waveform = write_waveform(source_of(beats), last, same, focus);
  }
  return report;
}

}  // namespace fastsplat::testbench
