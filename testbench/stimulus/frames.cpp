// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/frames.hpp"

namespace fastsplat::testbench {
namespace {

using cmodel::Opcode;

constexpr std::uint64_t kFrameTimeout = 200000;  ///< beyond any wait within a small stream

/// The records that end the tile left open by these beats; nothing if none is open.
struct Closers {
  Beats beats;
  bool in_table = false;  ///< a table is open
};
Closers closers_of(std::span<const cmodel::Beat> beats) {
  namespace layout = cmodel::layout;
  Closers out;
  const Beats all(beats.begin(), beats.end());
  const cmodel::Beat *tile = nullptr, *sheet = nullptr;  // open
  std::uint64_t sheets = 0, splats = 0;
  for (const auto& [at, opcode] : records_of(all)) {
    if (opcode == Opcode::LoadTable) out.in_table = at + cmodel::announced_beats(all[at]) >= all.size();
    if (opcode == Opcode::BeginTile) tile = &all[at], sheets = 0;
    if (opcode == Opcode::BeginSheet) sheet = &all[at], ++sheets, splats = 0;
    if (opcode == Opcode::Splat || opcode == Opcode::Ellipse) ++splats;
    if (opcode == Opcode::EndSheet) sheet = nullptr;
    if (opcode == Opcode::EndTile) tile = nullptr;
  }
  const auto end = [&](Opcode opcode, const cmodel::Field& number, std::int64_t value, const cmodel::Field& count,
                       std::uint64_t counted) {
    cmodel::Beat beat{};
    put(beat, layout::kOpcode, static_cast<std::uint64_t>(opcode));
    put(beat, number, static_cast<std::uint64_t>(value));
    put(beat, count, counted);
    out.beats.push_back(beat);
  };
  if (sheet != nullptr)
    end(Opcode::EndSheet, layout::kEndSheetNumber, get(*sheet, layout::kSheetNumber), layout::kEndSheetSplats, splats);
  if (tile != nullptr)
    end(Opcode::EndTile, layout::kEndTileNumber, get(*tile, layout::kTileNumber), layout::kEndTileSheets, sheets);
  return out;
}

}  // namespace

std::optional<Refused> refused_by_model(const cmodel::Config& config, const Beats& beats) {
  cmodel::StreamDecode decode(config, cmodel::StreamScope::Subset);
  for (std::size_t i = 0; i < beats.size(); ++i) {
    try {
      decode.feed(beats[i]);
    } catch (const cmodel::StreamRefusal& refusal) {
      return Refused{refusal.rule(), i};
    }
  }
  return std::nullopt;
}

std::optional<std::size_t> first_end(const cmodel::Config& config, const Beats& beats) {
  cmodel::StreamDecode decode(config, cmodel::StreamScope::Subset);
  try {
    for (std::size_t i = 0; i < beats.size(); ++i) {
      const cmodel::Record* record = decode.feed(beats[i]);
      if (record != nullptr && std::holds_alternative<cmodel::EndFrame>(*record)) return i + 1;
    }
  } catch (const cmodel::StreamRefusal&) {
    // Refused before any end.
  }
  return std::nullopt;
}

Frames::Frames(const cmodel::Config& config, const MakeDevice& make, Check& check, const Pattern& sink)
    : config_(config), check_(check), sink_(sink) {
  RtlOptions options;
  options.output = sink;
  options.taps = &relay_;
  options.timeout = kFrameTimeout;
  device_ = make(none_, options);
}

void Frames::good(const std::string& what, const Beats& beats, Coverage::Id bin, const Meanwhile& meanwhile) {
  begin();
  const auto all = std::span(beats);
  device_->consume(all.first(meanwhile.at));
  if (meanwhile.what) pause(meanwhile.what);
  device_->consume(all.subspan(meanwhile.at));
  end(what, bin, false);
}

bool Frames::bad(const std::string& what, const Beats& beats, const Refused& expected, Coverage::Id bin,
                 const std::function<void()>& meanwhile) {
  const std::size_t failures = check_.result.failures.size();
  begin();
  const auto before = std::span(beats).first(expected.beat);
  device_->consume(before);
  if (meanwhile) pause(meanwhile);
  const std::uint64_t aborted = device_->aborted_tiles();
  const auto refusal = device_->refuse(beats[expected.beat]);
  check_.equal(what + ": refused", 1, refusal ? 1 : 0, bin);
  if (refusal) check_.equal(what + ": checked in cycle", checker_->checked_at(refusal->taken), refusal->checked, bin);
  const Closers closers = closers_of(before);
  // The device's own end records lie where the refused beat lay, a cycle later. So check seems to take them in the
  // cycle before the verdict.
  if (refusal) source_.pause(0, refusal->checked - (device_->sliced() ? 2 : 1));
  for (const auto& beat : closers.beats) checker_->accept(beat);
  const auto opcode = static_cast<std::uint32_t>(get(beats[expected.beat], cmodel::layout::kOpcode));
  const auto error = [&] {
    check_.equal(what + ": STATUS, error", 1, read(cmodel::kRegStatus) >> 1 & 1, bin);
    check_.equal(what + ": ERROR", static_cast<std::uint32_t>(expected.rule) | opcode << 8, read(cmodel::kRegError),
                 bin);
    check_.equal(what + ": ERROR_BEAT", expected.beat, read(cmodel::kRegErrorBeat), bin);
  };
  error();
  end(what, closers.beats.empty() ? bin : check_.bin("refusal", "open_tile_is_ended"), closers.in_table);
  check_.equal(what + ": tiles marked as aborted", aborted + (closers.beats.empty() ? 0 : 1), device_->aborted_tiles(),
               bin);
  // Later beats change nothing and do not show in ERROR.
  const auto swallowed = check_.bin("refusal", "rest_is_swallowed");
  const auto counters = device_->counters();
  const auto cycles = device_->cycle_counters().busy;
  for (const auto& beat : std::span(beats).subspan(expected.beat)) device_->refuse(beat);
  check_.equal(what + ": counters after the rest", 1, counters == device_->counters() ? 1 : 0, swallowed);
  check_.equal(what + ": busy cycles after the rest", cycles, device_->cycle_counters().busy, swallowed);
  error();
  return check_.result.failures.size() == failures;
}

void Frames::cut(const std::string& what, std::span<const cmodel::Beat> beats, int wait, Coverage::Id bin,
                 const Beats& next) {
  begin();
  device_->consume(beats);
  for (int i = 0; i < wait; ++i) read(cmodel::kRegStatus);
  const Closers closers = closers_of(beats);
  for (const auto& beat : closers.beats) checker_->accept(beat);
  device_->soft_reset(next.empty());
  if (!next.empty()) follow(what, next, closers.in_table, bin);
  check_.equal(what + ": no error", 0, read(cmodel::kRegStatus), bin);
  check_.equal(what + ": IRQ, error", 0, read(cmodel::kRegIrq) & cmodel::kIrqError, bin);
  relay_.to = nullptr;
  // The cycle model does not know when the reset came.
  if (next.empty() && !closers.in_table) record(what, checker_->finish(), bin);
}

void Frames::follow(const std::string& what, const Beats& next, bool in_table, Coverage::Id bin) {
  Checker after(config_, cmodel::StreamScope::Subset, none_);
  relay_.next = &after;
  device_->consume(next);
  device_->finish();
  relay_.to = nullptr;
  if (!in_table) record(what, checker_->finish(), bin);
  record(what + ", the next frame", after.finish(), bin);
  // The counters were not cleared in between: they count both.
  cmodel::Counters both = checker_->counted();
  both += after.counted();
  std::vector<std::uint64_t> expected;
  both.for_each(
      [&](const char*, std::uint64_t value, const char*) { expected.push_back(config_.counter_word(value)); });
  auto one = expected.begin();
  device_->counters().for_each([&](const char* name, std::uint64_t value, const char*) {
    check_.equal(what + ", counter " + name + " of both frames", *one++, value, bin);
  });
}

void Frames::drop(std::span<const cmodel::Beat> beats, int reset_cycles, int wait) {
  relay_.tiles_left = 0;
  device_->consume(beats);
  for (int i = 0; i < wait; ++i) read(cmodel::kRegStatus);
  device_->warm_reset(reset_cycles);
}

void Frames::forgive() {
  write(cmodel::kRegIrq, cmodel::kIrqError);
  device_->soft_reset();
}

void Frames::begin() {
  write(cmodel::kRegControl, cmodel::kControlClear);
  source_.begin();
  checker_.emplace(config_, cmodel::StreamScope::Subset, none_,
                   CheckOptions{.source = &source_, .sink = &sink_, .verdicts = true});
  relay_.to = &*checker_;
  relay_.tiles_left = 0;
  checker_->start(device_->cycles(), device_->sliced());
}

void Frames::pause(const std::function<void()>& meanwhile) {
  const std::uint64_t from = device_->cycles();
  meanwhile();
  source_.pause(from, device_->cycles());
}

void Frames::end(const std::string& what, Coverage::Id bin, bool in_table) {
  device_->finish();
  relay_.to = nullptr;
  if (in_table) return;  // neither model has an end there, and only words were taken
  record(what, checker_->finish(device_->counters(), device_->cycle_counters()), bin);
}

void Frames::record(const std::string& what, const CheckReport& report, Coverage::Id bin) {
  check_.result.comparisons += report.comparisons;
  std::string how = what + ": mismatches";
  if (report.first)
    how += ", first at tap " +
           std::to_string(static_cast<int>(report.first->model ? report.first->model->tap : report.first->rtl->tap));
  if (!report.differences.empty()) how += " (" + report.differences.front() + ")";
  check_.equal(how, 0, report.mismatches, bin);
}

}  // namespace fastsplat::testbench
