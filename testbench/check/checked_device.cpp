#include "testbench/check/checked_device.hpp"

#include <algorithm>

namespace fastsplat::testbench {
namespace {

/// More than any device can hold back (a tile's pixels, a sheet's blocks): beyond it the device has gone silent.
constexpr std::size_t kBacklogWords = std::size_t{1} << 26;

}  // namespace

CheckedDevice::CheckedDevice(const cmodel::Config& config, cmodel::StreamScope scope, cmodel::PixelSink& pixels,
                             const Factory& make, const CheckOptions& options)
    : config_(config),
      scope_(scope),
      options_(options),
      pixels_(pixels),
      model_(config, scope, model_tiles_, &board_.model()) {
  gate_.to = &board_.rtl();
  device_ = make(device_tiles_, gate_);
}

void CheckedDevice::unchecked(const std::function<void(RtlDevice&)>& action) {
  gate_.open = false;
  action(*device_);
  gate_.open = true;
}

void CheckedDevice::consume(std::span<const cmodel::Beat> beats) {
  if (!cycle_model_) {
    cycle_model_.emplace(
        config_, scope_,
        cmodel::CycleOptions{.input = options_.source, .output = options_.sink, .first_beat = device_->cycles()});
  }
  // Beat by beat, the model first: a record is expected before the device can show it, and no earlier than that.
  for (const auto& beat : beats) {
    if (stopped_) return;
    model_.consume({&beat, 1});
    cycle_model_->consume({&beat, 1});
    device_->consume({&beat, 1});
    stop_if_broken();
  }
}

void CheckedDevice::finish() {
  if (stopped_) return;
  model_.finish();
  device_->finish();
  board_.finish();
  for (const auto& tile : model_tiles_.tiles) differ("tile " + std::to_string(tile.tile) + " never came out");
  model_tiles_.tiles.clear();
  check_counters();
  if (cycle_model_) check_cycles();
}

void CheckedDevice::check_counters() {
  counters_ = device_->counters();
  std::vector<std::uint64_t> expected;
  model_.counters().for_each([&](const char*, std::uint64_t value, const char*) { expected.push_back(value); });
  auto model = expected.begin();
  counters_.for_each([&](const char* name, std::uint64_t value, const char*) {
    equal(std::string("counter ") + name, *model++, value);
  });
}

void CheckedDevice::check_cycles() {
  cycle_model_->finish();
  const cmodel::StallCounters& model = cycle_model_->stalls();
  const RtlCycles rtl = device_->cycle_counters();
  cycles_model_ = model.busy;
  cycles_rtl_ = rtl.busy;
  equal("cycles", model.busy, rtl.busy);
  equal("cycles without input", model.stall_input, rtl.stall_input);
  equal("cycles of table words", model.stall_table, rtl.stall_table);
  equal("cycles of waiting for a sheet buffer", model.stall_buffer, rtl.stall_buffer);
  equal("cycles of waiting between tiles", model.stall_tile, rtl.stall_tile);
}

void CheckedDevice::equal(const std::string& what, std::uint64_t model, std::uint64_t rtl) {
  ++comparisons_;
  if (model != rtl) differ(what + ": expected " + std::to_string(model) + ", RTL " + std::to_string(rtl));
}

void CheckedDevice::check_tile(cmodel::TilePixels&& tile) {
  if (!gate_.open) return;
  const std::string name = "tile " + std::to_string(tile.tile);
  if (model_tiles_.tiles.empty()) {
    differ(name + " came out of the RTL and not out of the model");
  } else {
    const auto& expected = model_tiles_.tiles.front();
    comparisons_ += expected.words.size();
    if (expected.tile != tile.tile || expected.x != tile.x || expected.y != tile.y || expected.width != tile.width ||
        expected.height != tile.height || expected.words != tile.words) {
      differ(name + ": its pixels differ from tile " + std::to_string(expected.tile) + " of the model");
    }
    model_tiles_.tiles.pop_front();
  }
  pixels_.on_tile(std::move(tile));
}

void CheckedDevice::differ(std::string text) {
  ++mismatches_;
  if (differences_.size() < 32) differences_.push_back(std::move(text));
}

void CheckedDevice::stop_if_broken() {
  if (board_.mismatches() + mismatches_ >= options_.stop_after) stopped_ = true;
  if (board_.backlog() > kBacklogWords) {
    differ("the RTL shows none of the last events");
    board_.finish();
    stopped_ = true;
  }
}

CheckReport CheckedDevice::report() const {
  return {.comparisons = board_.comparisons() + comparisons_,
          .mismatches = board_.mismatches() + mismatches_,
          .by_tap = board_.by_tap(),
          .first = board_.first(),
          .differences = differences_,
          .cycles_rtl = cycles_rtl_,
          .cycles_model = cycles_model_};
}

}  // namespace fastsplat::testbench
