// SPDX-License-Identifier: Apache-2.0
#include "testbench/capi/checker_run.hpp"

#include <algorithm>
#include <cstring>

#include "base/hash_text.hpp"
#include "cmodel/io/register_fields.hpp"
#include "testbench/capi/handles.hpp"
#include "testbench/device/port_bits.hpp"

namespace fastsplat::capi {
namespace {

static_assert(FASTSPLAT_PORT_VERDICT == static_cast<int>(testbench::RawPort::Verdict));
static_assert(FASTSPLAT_TAPS == static_cast<int>(testbench::Detector::Tiles));

std::uint32_t blocks(const cmodel::Config& config) {
  return static_cast<std::uint32_t>(config.tile_width / config.lanes * (config.tile_height / config.lanes));
}

std::string number(std::uint64_t value) { return std::to_string(value); }

}  // namespace

std::size_t port_words(const cmodel::Config& config, std::uint32_t port) {
  const auto lanes = static_cast<std::size_t>(config.lanes), banks = lanes * lanes;
  const auto bits = testbench::port_bits(config);
  const auto words = [](std::size_t fields, int each) { return (fields * static_cast<std::size_t>(each) + 31) / 32; };
  switch (port) {
    case FASTSPLAT_PORT_SHEET:
      return words(banks * 4, bits.sheet);
    case FASTSPLAT_PORT_WINDOW:
      return words(banks, bits.weight);
    case FASTSPLAT_PORT_COMPOSITE:
      return words(banks * 4, bits.state);
    case FASTSPLAT_PORT_PIXELS:
      return lanes * 4;
    default:
      return 0;
  }
}

void unknown_port(const char* call, std::uint32_t port) {
  misuse(call, "unknown port", "at most " + number(FASTSPLAT_PORTS - 1), number(port));
}

CheckerRun::CheckerRun(CheckerSetup setup)
    : setup_(std::move(setup)),
      checker_(setup_.config, setup_.scope, pixels_,
               {.stop_after = setup_.stop_after,
                .source = &setup_.patterns.input,
                .sink = &setup_.patterns.ready,
                .verdicts = setup_.verdicts}) {}

void CheckerRun::require_open(const char* call) const {
  if (finished_) misuse(call, "the checker is finished; reset it for another stream");
  if (!broken_.empty()) misuse(call, "the stream failed earlier (" + broken_ + "); reset the checker");
}

void CheckerRun::start(const char* call, std::uint64_t first_beat) {
  require_open(call);
  if (checker_.started()) misuse(call, "already started");
  if (fed_) misuse(call, "beats were already accepted", "start before the first beat");
  if (auto violation = cmodel::cycle_violation(setup_.config)) throw_input(*violation);
  checker_.start(first_beat);
}

void CheckerRun::took(const char* call, const std::uint32_t* words, std::size_t beats) {
  require_open(call);
  cmodel::Beat beat;
  for (; beats > 0; --beats, words += beat.size()) {
    std::memcpy(beat.data(), words, sizeof beat);
    fed_ = true;
    try {
      checker_.accept(beat);
    } catch (const UserError& error) {
      broken_ = error.what();
      throw;
    }
  }
}

void CheckerRun::showed(const char* call, const fastsplat_shown& shown) {
  require_open(call);
  if (shown.port >= FASTSPLAT_PORTS) unknown_port(call, shown.port);
  if (shown.cycle < cycle_) misuse(call, "cycles must not decrease", "at least " + number(cycle_), number(shown.cycle));
  const std::size_t words = port_words(setup_.config, shown.port);
  if (shown.word_count != words)
    misuse(call, "wrong number of words for port " + number(shown.port), number(words), number(shown.word_count));
  if (words > 0) require(call, "words", shown.words);
  if (shown.port == FASTSPLAT_PORT_COMPOSITE && shown.block >= blocks(setup_.config))
    misuse(call, "block number out of range", "below " + number(blocks(setup_.config)), number(shown.block));
  cycle_ = shown.cycle;
  if (stopped()) return;
  const auto given = [&](std::uint32_t bit, std::uint32_t value) {
    return (shown.given & bit) != 0 ? std::optional(value) : std::nullopt;
  };
  checker_.on_raw({.port = static_cast<testbench::RawPort>(shown.port),
                   .cycle = shown.cycle,
                   .tag = shown.tag,
                   .x = shown.x,
                   .y = shown.y,
                   .mx = shown.mx,
                   .my = shown.my,
                   .block = shown.block,
                   .last = shown.last != 0,
                   .cut = shown.cut != 0,
                   .hidden = shown.hidden != 0,
                   .keep = given(FASTSPLAT_GIVEN_KEEP, shown.keep),
                   .tile = given(FASTSPLAT_GIVEN_TILE, shown.tile),
                   .words = {shown.words, words}});
}

void CheckerRun::finish(const char* call, std::span<const std::uint64_t> counters) {
  require_open(call);
  const std::size_t count = counters.size(), all = cmodel::counters_of(setup_.config);
  if (count != 0 && count != FASTSPLAT_MODEL_COUNTERS && count != all)
    misuse(call, "wrong number of counters", "0, 16 or " + number(all), number(count));
  if (checker_.started() && count != all)
    misuse(call, "the counters of cycles are missing, which this checker compares", number(all) + " counters",
           number(count));
  try {
    if (count == 0) {
      checker_.finish();
    } else {
      auto value = counters.begin();
      cmodel::Counters work;
      cmodel::StallCounters cycles;
#define X(name, meaning) work.name = *value++;
      FASTSPLAT_COUNTERS(X)
#undef X
      if (count == all) {
#define X(name, counter, meaning) \
  if (cmodel::has_counter(setup_.config, #counter)) cycles.name = *value++;
        FASTSPLAT_STALL_COUNTERS(X)
#undef X
      }
      checker_.finish(work, cycles);
    }
  } catch (const UserError& error) {  // the stream is incomplete
    broken_ = error.what();
    throw;
  }
  finished_ = true;
}

std::int32_t CheckerRun::verdict() const {
  const auto so_far = report();
  if (so_far.mismatches > 0) return FASTSPLAT_VERDICT_MISMATCH;
  if (!finished_) return FASTSPLAT_VERDICT_OPEN;
  const bool compared = std::ranges::any_of(so_far.by_tap, [](std::uint64_t records) { return records > 0; });
  return compared ? FASTSPLAT_VERDICT_PASS : FASTSPLAT_VERDICT_NOTHING_COMPARED;
}

std::string CheckerRun::first_mismatch() const {
  const auto so_far = report();
  if (!so_far.detector) return broken_;  // why the stream was refused; may be empty
  // The first difference is a tap record, unless a detector of another kind found one before.
  if (*so_far.detector < testbench::Detector::Tiles && so_far.first) return describe(setup_.config, *so_far.first);
  return so_far.differences.front();
}

std::string CheckerRun::summary() const {
  constexpr const char* kVerdicts[] = {"pass", "mismatch", "nothing compared", "not finished"};
  const auto so_far = report();
  std::string text = std::string(kVerdicts[verdict()]) + ": configuration " + setup_.config.name + " " +
                     hash_text(cmodel::config_hash(setup_.config)) + ", " + number(so_far.comparisons) +
                     " comparisons, " + number(so_far.mismatches) + " mismatches";
  if (so_far.cycles_rtl && so_far.cycles_model)
    text += ", busy cycles " + number(*so_far.cycles_rtl) + ", expected " + number(*so_far.cycles_model);
  return text;
}

}  // namespace fastsplat::capi
