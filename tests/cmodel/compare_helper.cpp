// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/compare_helper.hpp"

#include <cstdio>

#include "cmodel/model.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

constexpr const char* kNames[] = {"snap", "footprint", "sheet", "composite", "pixel"};

std::string describe(const oracle::Event& e) {
  return std::string(kNames[static_cast<int>(e.kind)]) + " tile " + std::to_string(e.tile) + " sheet " +
         std::to_string(e.sheet) + " tag " + std::to_string(e.tag) + " at (" + std::to_string(e.x) + ", " +
         std::to_string(e.y) + ")";
}

bool same_place(const oracle::Event& a, const oracle::Event& b) {
  return a.kind == b.kind && a.tile == b.tile && a.sheet == b.sheet && a.tag == b.tag && a.x == b.x && a.y == b.y;
}

void differ(Comparison& result, const std::string& text) {
  if (result.mismatches++ == 0) result.first = text;
}

void compare_words(Comparison& result, const std::string& who, const std::string& count,
                   const std::vector<std::uint32_t>& model, const std::vector<std::uint32_t>& expected) {
  if (model.size() != expected.size()) {
    differ(result, who + ": " + std::to_string(model.size()) + " words, oracle " + std::to_string(expected.size()));
    return;
  }
  result.compared[count] += expected.size();
  for (std::size_t i = 0; i < expected.size(); ++i)
    if (model[i] != expected[i])
      differ(result, who + ": word " + std::to_string(i) + " is " + std::to_string(model[i]) + ", oracle " +
                         std::to_string(expected[i]));
}

}  // namespace

void Collector::on_tile(cmodel::TilePixels&& tile) {
  rendering.tiles.push_back({tile.tile, tile.x, tile.y, tile.width, tile.height, std::move(tile.words)});
}

void Collector::on_tap(const cmodel::TapRecord& record) {
  rendering.events.push_back({static_cast<oracle::Kind>(record.tap),
                              record.tile,
                              record.sheet,
                              record.tag,
                              record.x,
                              record.y,
                              {record.payload.begin(), record.payload.end()}});
}

oracle::Rendering run_model(const cmodel::Config& config, std::span<const std::uint8_t> bytes, Taps taps,
                            const std::vector<std::size_t>& cuts) {
  Collector collector;
  cmodel::Model model(config, cmodel::StreamScope::Whole, collector, taps == Taps::On ? &collector : nullptr);
  const std::vector<cmodel::Beat> beats = to_beats(bytes);
  std::size_t done = 0;
  for (const std::size_t cut : cuts) {
    model.consume(std::span(beats).subspan(done, cut - done));
    done = cut;
  }
  model.consume(std::span(beats).subspan(done));
  model.finish();
  model.counters().for_each([&](const char* name, std::uint64_t value, const char*) {
    if (value != 0) collector.rendering.counts[name] = value;
  });
  return std::move(collector.rendering);
}

std::uint64_t Comparison::total() const {
  std::uint64_t sum = 0;
  for (const auto& [name, count] : compared) sum += count;
  return sum;
}

Comparison& Comparison::operator+=(const Comparison& other) {
  for (const auto& [name, count] : other.compared) compared[name] += count;
  if (mismatches == 0) first = other.first;
  mismatches += other.mismatches;
  return *this;
}

Comparison compare(const oracle::Rendering& model, const oracle::Rendering& expected) {
  Comparison result;
  // One by one, in their order (N-9-4).
  for (std::size_t i = 0; i < std::max(model.events.size(), expected.events.size()); ++i) {
    if (i >= model.events.size() || i >= expected.events.size()) {
      differ(result, "event only in " + (i >= model.events.size() ? "oracle: " + describe(expected.events[i])
                                                                  : "model: " + describe(model.events[i])));
      break;
    }
    const oracle::Event &ours = model.events[i], &theirs = expected.events[i];
    if (!same_place(ours, theirs)) {
      differ(result, "event " + std::to_string(i) + " is " + describe(ours) + ", oracle " + describe(theirs));
      break;  // later records would be compared with the wrong partner
    }
    const char* count = kNames[static_cast<int>(theirs.kind)];
    if (ours.payload == theirs.payload)
      result.compared[count] += theirs.payload.size();
    else
      compare_words(result, describe(theirs), count, ours.payload, theirs.payload);
  }
  if (model.tiles.size() != expected.tiles.size())
    differ(result, std::to_string(model.tiles.size()) + " tiles, oracle " + std::to_string(expected.tiles.size()));
  for (std::size_t i = 0; i < std::min(model.tiles.size(), expected.tiles.size()); ++i) {
    const oracle::Picture &ours = model.tiles[i], &theirs = expected.tiles[i];
    const std::string who = "picture of tile " + std::to_string(theirs.tile);
    if (ours.tile != theirs.tile || ours.x != theirs.x || ours.y != theirs.y || ours.width != theirs.width ||
        ours.height != theirs.height)
      differ(result, who + ": number, place or size differ");
    compare_words(result, who, "picture", ours.words, theirs.words);
  }
  std::map<std::string, std::pair<std::uint64_t, std::uint64_t>> counters;
  for (const auto& [name, value] : model.counts) counters[name].first = value;
  for (const auto& [name, value] : expected.counts) counters[name].second = value;
  for (const auto& [name, values] : counters) {
    ++result.compared["counter"];
    if (values.first != values.second)
      differ(result,
             "counter " + name + " is " + std::to_string(values.first) + ", oracle " + std::to_string(values.second));
  }
  return result;
}

void print(const char* name, const Comparison& comparison) {
  for (const auto& [what, count] : comparison.compared)
    std::printf("[figure] %s %s words compared = %llu\n", name, what.c_str(), static_cast<unsigned long long>(count));
  std::printf("[figure] %s mismatches = %llu (limit 0)\n", name,
              static_cast<unsigned long long>(comparison.mismatches));
}

}  // namespace fastsplat::test
