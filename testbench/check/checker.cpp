// SPDX-License-Identifier: Apache-2.0
#include "testbench/check/checker.hpp"

#include <algorithm>

namespace fastsplat::testbench {
namespace {

/// More than any device can hold back (a tile's pixels, a sheet's blocks): beyond it the device has gone silent.
constexpr std::size_t kBacklogWords = std::size_t{1} << 26;
constexpr std::size_t kDifferencesTold = 32;

static_assert(static_cast<int>(Detector::Tiles) == cmodel::kTapCount);
Detector detector_of(const Divergence& divergence) {
  return static_cast<Detector>((divergence.model ? divergence.model : divergence.rtl)->tap);
}

}  // namespace

const char* to_string(Detector detector) {
  constexpr const char* kNames[] = {"tap snap", "tap footprint", "tap sheet", "tap composite", "tap pixel",
                                    "tiles",    "counters",      "cycles",    "verdicts"};
  return kNames[static_cast<std::size_t>(detector)];
}

Checker::Checker(const cmodel::Config& config, cmodel::StreamScope scope, cmodel::PixelSink& pixels,
                 const CheckOptions& options)
    : config_(config),
      scope_(scope),
      options_(options),
      pixels_(pixels),
      assembly_(config, device_tiles_, board_.rtl()),
      model_(config, scope, model_tiles_, &board_.model()) {
  board_.keep(options.keep);
  model_.log_culls(&culls_);
}

void Checker::start(std::uint64_t first_beat, bool sliced) {
  cycle_model_.emplace(config_, scope_,
                       cmodel::CycleOptions{.input = options_.source,
                                            .output = options_.sink,
                                            .first_beat = first_beat,
                                            .sliced = sliced,
                                            .spans = options_.verdicts ? &verdicts_ : nullptr,
                                            .culls = &culls_});
}

void Checker::on_raw(const RawTap& tap) {
  if (tap.port == RawPort::Verdict) return check_verdict(tap);
  if (tap.cut)
    differ(Detector::Tiles,
           "the pixel beat of cycle " + std::to_string(tap.cycle) + " is marked as belonging to an aborted tile");
  assembly_.on_raw(tap);
}

void Checker::check_verdict(const RawTap& tap) {
  if (!options_.verdicts || !cycle_model_ || stopped()) return;
  ++comparisons_;
  if (const auto difference = verdicts_.compare(tap)) differ(Detector::Verdicts, *difference);
}

void Checker::accept(const cmodel::Beat& beat) {
  if (stopped()) return;
  // A record is expected before the device can show it, and no earlier than that.
  model_.consume({&beat, 1});
  if (cycle_model_) cycle_model_->consume({&beat, 1});
  if (beat[0] % 256 == static_cast<std::uint32_t>(cmodel::Opcode::EndTile)) culls_.clear();  // or a table word
  assembly_.accept(beat);
  if (board_.backlog() > kBacklogWords) {
    silent_ = true;
    board_.finish();
    differ(*first_detector(Detector::Tiles), "the RTL produced none of the last events");
  }
}

CheckReport Checker::finish(const cmodel::Counters& counters, const cmodel::StallCounters& cycles) {
  if (stopped()) return report();
  finish();
  check_counters(counters);
  if (cycle_model_) check_cycles(cycles);
  return report();
}

CheckReport Checker::finish() {
  if (stopped()) return report();
  end_of_stream();
  board_.finish();
  for (const auto& tile : model_tiles_.tiles)
    differ(Detector::Tiles, "tile " + std::to_string(tile.tile) + " was never output");
  model_tiles_.tiles.clear();
  while (const auto missing = verdicts_.missing()) differ(Detector::Verdicts, *missing);
  return report();
}

void Checker::check_counters(const cmodel::Counters& rtl) {
  std::vector<std::uint64_t> expected;
  model_.counters().for_each(
      [&](const char*, std::uint64_t value, const char*) { expected.push_back(config_.counter_word(value)); });
  auto model = expected.begin();
  rtl.for_each([&](const char* name, std::uint64_t value, const char*) {
    equal(Detector::Counters, std::string("counter ") + name, *model++, value);
  });
}

void Checker::check_cycles(const cmodel::StallCounters& rtl) {
  cycle_model_->finish();
  const cmodel::StallCounters& model = cycle_model_->stalls();
  cycles_model_ = config_.counter_word(model.busy);  // a narrow counter wraps
  cycles_rtl_ = rtl.busy;
#define X(name, counter, meaning)                                       \
  if (cmodel::has_counter(config_, #counter) || model.name != rtl.name) \
    equal(Detector::Cycles, meaning, config_.counter_word(model.name), rtl.name);
  FASTSPLAT_STALL_COUNTERS(X)
#undef X
}

void Checker::equal(Detector detector, const std::string& what, std::uint64_t model, std::uint64_t rtl) {
  ++comparisons_;
  if (model != rtl) differ(detector, what + ": expected " + std::to_string(model) + ", RTL " + std::to_string(rtl));
}

void Checker::check_tile(cmodel::TilePixels&& tile) {
  const std::string name = "tile " + std::to_string(tile.tile);
  if (model_tiles_.tiles.empty()) {
    differ(Detector::Tiles, name + " was output by the RTL but not by the model");
  } else {
    const auto& expected = model_tiles_.tiles.front();
    comparisons_ += expected.words.size();
    if (expected.tile != tile.tile || expected.x != tile.x || expected.y != tile.y || expected.width != tile.width ||
        expected.height != tile.height || expected.words != tile.words) {
      differ(Detector::Tiles, name + ": pixels differ from tile " + std::to_string(expected.tile) + " of the model");
    }
    model_tiles_.tiles.pop_front();
  }
  pixels_.on_tile(std::move(tile));
}

std::optional<Detector> Checker::first_detector(std::optional<Detector> next) const {
  if (detector_) return detector_;
  return board_.first() ? detector_of(*board_.first()) : next;
}

void Checker::differ(Detector detector, std::string text) {
  detector_ = first_detector(detector);
  ++mismatches_;
  if (differences_.size() < std::max(kDifferencesTold, options_.keep)) differences_.push_back(std::move(text));
}

CheckReport Checker::report() const {
  return {.comparisons = board_.comparisons() + comparisons_,
          .mismatches = board_.mismatches() + mismatches_,
          .stopped = board_.mismatches() + mismatches_ >= options_.stop_after,
          .detector = first_detector(std::nullopt),
          .by_tap = board_.by_tap(),
          .first = board_.first() != nullptr ? std::optional(*board_.first()) : std::nullopt,
          .kept = options_.keep > 0 ? board_.kept() : std::vector<Divergence>{},
          .mismatches_by_tap = board_.mismatches_by_tap(),
          .differences = differences_,
          .cycles_rtl = cycles_rtl_,
          .cycles_model = cycles_model_};
}

}  // namespace fastsplat::testbench
