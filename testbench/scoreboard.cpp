#include "testbench/scoreboard.hpp"

#include <algorithm>
#include <cstdio>

namespace fastsplat::testbench {
namespace {

/// Meaning of a payload word, as "window pixel (i,j): weight" or "C_R".
std::string word_name(const cmodel::Config& config, const TapCopy& record, std::size_t word) {
  static constexpr const char* kChannels[] = {"R", "G", "B", "tau"};
  static constexpr const char* kState[] = {"C_R", "C_G", "C_B", "T"};
  static constexpr const char* kSnap[] = {"x0", "y0", "mx", "my"};
  static constexpr const char* kPixel[] = {"R", "G", "B", "A"};
  const auto lanes = static_cast<std::size_t>(config.lanes);
  const auto pixel = [&](std::size_t lane) {
    return "(" + std::to_string(lane % lanes) + "," + std::to_string(lane / lanes) + ")";
  };
  switch (record.tap) {
    case cmodel::Tap::Snap:
      return kSnap[word % 4];
    case cmodel::Tap::Footprint:
      return "window pixel " + pixel(word) + ": weight";
    case cmodel::Tap::Sheet:
      return "window pixel " + pixel(word / 4) + ": sheet " + kChannels[word % 4];
    case cmodel::Tap::Composite:
      return "block pixel " + pixel(word / 4) + ": " + kState[word % 4];
    case cmodel::Tap::Pixel:
      return std::string("output ") + kPixel[word % 4];
  }
  return "?";
}

std::string hex(std::uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "0x%X", value);
  return text;
}

std::string place(const TapCopy& record) {
  std::string text = std::string("stage ") + cmodel::to_string(record.tap) + ", tile " + std::to_string(record.tile);
  if (record.tap != cmodel::Tap::Pixel) text += ", sheet " + std::to_string(record.sheet);
  if (record.tap <= cmodel::Tap::Sheet) text += ", splat " + std::to_string(record.tag);
  return text + ", pixel (" + std::to_string(record.x) + "," + std::to_string(record.y) + ")";
}

}  // namespace

TapCopy copy(const cmodel::TapRecord& record) {
  return {.tap = record.tap,
          .tile = record.tile,
          .sheet = record.sheet,
          .tag = record.tag,
          .cycle = record.cycle,
          .x = record.x,
          .y = record.y,
          .payload = {record.payload.begin(), record.payload.end()}};
}

std::string describe(const cmodel::Config& config, const Divergence& divergence) {
  if (!divergence.rtl) return place(*divergence.model) + ": the RTL never produced this event";
  if (!divergence.model)
    return place(*divergence.rtl) + ": the RTL produced an event that the model has not (cycle " +
           std::to_string(divergence.rtl->cycle) + ")";
  const TapCopy& model = *divergence.model;
  const TapCopy& rtl = *divergence.rtl;
  if (divergence.header)
    return "expected " + place(model) + ", RTL has " + place(rtl) + " (cycle " + std::to_string(rtl.cycle) + ")";
  const std::uint32_t a = model.payload[divergence.word], b = rtl.payload[divergence.word];
  return place(model) + ", " + word_name(config, model, divergence.word) + " " + hex(a) + ", RTL " + hex(b) +
         " (differs in " + hex(a ^ b) + ", cycle " + std::to_string(rtl.cycle) + ")";
}

void Scoreboard::Side::on_tap(const cmodel::TapRecord& record) {
  is_model ? board->expect(record) : board->check(record);
}

void Scoreboard::expect(const cmodel::TapRecord& record) {
  expected_[static_cast<std::size_t>(record.tap)].push_back(copy(record));
}

void Scoreboard::mismatch(Divergence divergence) {
  ++mismatches_;
  if (!first_) first_ = std::move(divergence);
}

void Scoreboard::check(const cmodel::TapRecord& record) {
  auto& queue = expected_[static_cast<std::size_t>(record.tap)];
  if (queue.empty()) {
    mismatch({.model = std::nullopt, .rtl = copy(record), .word = 0, .header = false});
    return;
  }
  const TapCopy& model = queue.front();
  ++comparisons_;
  ++by_tap_[static_cast<std::size_t>(record.tap)];
  const bool same_header = model.tile == record.tile && model.sheet == record.sheet && model.tag == record.tag &&
                           model.x == record.x && model.y == record.y && model.payload.size() == record.payload.size();
  if (!same_header) {
    mismatch({.model = model, .rtl = copy(record), .word = 0, .header = true});
  } else if (!std::equal(model.payload.begin(), model.payload.end(), record.payload.begin())) {
    const auto at =
        std::mismatch(model.payload.begin(), model.payload.end(), record.payload.begin()).first - model.payload.begin();
    mismatch({.model = model, .rtl = copy(record), .word = static_cast<std::size_t>(at), .header = false});
  }
  queue.pop_front();
}

void Scoreboard::finish() {
  for (auto& queue : expected_) {
    for (auto& record : queue) mismatch({.model = std::move(record), .rtl = std::nullopt, .word = 0, .header = false});
    queue.clear();
  }
}

}  // namespace fastsplat::testbench
