// SPDX-License-Identifier: Apache-2.0
// Writes the conformance vectors of docs/vectors: a small stream for each feature, and the pixels, counters, cycles and
// refusals of a device that plays it (docs/stream.md, "Vectors").
//   fastsplat_vectors FOLDER
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "cmodel/cull/cull_log.hpp"
#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/model.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/stimulus/cull_frames.hpp"
#include "testbench/stimulus/frames.hpp"
#include "testbench/stimulus/random.hpp"
#include "testbench/stimulus/stimulus.hpp"

namespace fastsplat {
namespace {

using cmodel::Beat;
using cmodel::Config;
using cmodel::Mode;
using testbench::Beats;

struct Feature {
  const char* name;
  const char* what;
  Mode mode;
  std::vector<std::pair<const char*, const char*>> keys;  ///< beside kSmall
  bool refuses = false;                                   ///< has rules that the features before it do not show
};

/// Of `tiny`; tables of few words make short streams.
const std::vector<std::pair<const char*, const char*>> kSmall{
    {"snap.phases", "4"},  {"tile.width", "8"},      {"tile.height", "8"},
    {"rlut.columns", "8"}, {"radial.entries", "16"}, {"opacity.segments", "4"},
};
const std::vector<Feature> kFeatures{
    {"exponential", "slabs of exponential opacity", Mode::Exponential, {}, true},
    {"additive", "slabs of additive opacity", Mode::Additive, {}},
    {"sum", "X-ray: sums of all splats", Mode::Sum, {}},
    {"slices", "a block composited pixel by pixel", Mode::Exponential, {{"composite.lanes", "1"}}},
    {"interpolated", "weights between two radial entries", Mode::Exponential, {{"radial.interpolate", "1"}}},
    {"rounded",
     "other roundings and integer bits",
     Mode::Exponential,
     {{"rounding.snap", "rnd_conv"},
      {"rounding.product", "rnd_conv"},
      {"rounding.fall", "trn"},
      {"rounding.slab", "rnd_conv"},
      {"rounding.light", "trn"},
      {"rounding.pixel", "rnd_conv"},
      {"colour.int_bits", "1"},
      {"radial.int_bits", "1"},
      {"pixel.int_bits", "1"}}},
    {"ellipses", "ellipses and circles", Mode::Exponential, {{"ellipse.frac_bits", "6"}}, true},
    {"samples", "every sample composited", Mode::SampleExponential, {{"composite.every_sample", "1"}}, true},
    {"culled_blocks",
     "hidden sets, splats and windows, by block",
     Mode::Exponential,
     {{"cull.map", "block"}, {"rlut.sets", "2"}, {"tile.width", "4"}, {"tile.height", "4"}},
     true},
    {"culled_pixels",
     "hidden sets, splats and windows, by pixel",
     Mode::Exponential,
     {{"cull.map", "pixel"}, {"rlut.sets", "2"}, {"tile.width", "4"}, {"tile.height", "4"}}},
    {"densities", "densities classified by pixel", Mode::DensityExponential, {{"classify.segment_bits", "2"}}, true},
};

/// Of all tiles: small, and not a whole number of windows.
constexpr int kWidth = 5, kHeight = 5;
constexpr std::size_t kCulledRecords = 9;
constexpr std::uint64_t kSeeds = 400, kSplats = 300;
constexpr std::size_t kTiles = 2, kSheets = 3, kRecords = 4;

/// Keys beside those of `tiny`.
std::map<std::string, std::string> keys_of(const Feature& feature) {
  std::map<std::string, std::string> out(feature.keys.begin(), feature.keys.end());
  out.insert(kSmall.begin(), kSmall.end());
  return out;
}

Config config_of(const Feature& feature) {
  Config config = driver::load_config("tiny");
  for (const auto& [key, value] : keys_of(feature)) {
    if (const auto error = cmodel::set(config, key, value)) throw UserError(ExitCode::Internal, *error);
  }
  if (const auto error = cmodel::first_violation(config)) throw UserError(ExitCode::Internal, *error);
  return config;
}

/// Hexadecimal without leading zeros; the first word is the lowest.
std::string hex(std::span<const std::uint32_t> words) {
  std::string out;
  for (std::size_t i = words.size(); i-- > 0;) out += fmt::format("{:08x}", words[i]);
  out.erase(0, std::min(out.find_first_not_of('0'), out.size() - 1));
  return out;
}

/// The lines of pixels that leave the device, one for P pixels of a row.
class PixelLines final : public cmodel::PixelSink {
 public:
  explicit PixelLines(int lanes) : lanes_(lanes) {}
  void on_tile(cmodel::TilePixels&& tile) override {
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; x += lanes_) {
        const int count = std::min(lanes_, tile.width - x);
        const bool last = y + 1 == tile.height && x + count == tile.width;
        const std::span words =
            std::span(tile.words)
                .subspan(4 * (std::size_t(y) * std::size_t(tile.width) + std::size_t(x)), 4 * std::size_t(count));
        values_.insert(words.begin(), words.end());
        text_ += fmt::format("pixel {} {:x} {}\n", last ? 1 : 0, (1 << count) - 1, hex(words));
      }
    }
  }
  const std::string& text() const { return text_; }
  std::size_t values() const { return values_.size(); }  ///< different words

 private:
  int lanes_;
  std::string text_;
  std::set<std::uint32_t> values_;
};

struct Played {
  std::string text;                        ///< lines of beats, pixels and counters
  int counted = 0, values = 0, drawn = 0;  ///< counters above 0, different words of pixels, pixels with a weight
};

/// Without text if the stream shows too little.
Played play(const Config& config, const Beats& beats) {
  Played out;
  for (const Beat& beat : beats) out.text += "beat " + hex(beat) + "\n";
  PixelLines pixels(config.lanes);
  cmodel::CullLog culls;
  cmodel::Model model(config, cmodel::StreamScope::Whole, pixels);
  model.log_culls(&culls);
  model.consume(beats);
  model.finish();
  cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, {.sliced = true, .culls = &culls});
  cycles.consume(beats);
  cycles.finish();
  out.text += pixels.text();
  int number = 0;
  const auto counter = [&](const char*, std::uint64_t value, const char*) {
    out.text += fmt::format("counter {} {}\n", number++, value);
    out.counted += value > 0 ? 1 : 0;
  };
  model.counters().for_each(counter);
  cycles.stalls().for_each(config, counter);
  const cmodel::Counters& counts = model.counters();
  const bool shows = counts.sheets > 1 && counts.windows > 4 &&
                     (!config.culls() || (model.culls().hidden_sets > 0 && model.culls().dropped > 0 &&
                                          cycles.stalls().hidden_windows > 0));
  out.values = static_cast<int>(pixels.values());
  out.drawn = static_cast<int>(counts.lanes_weighted);
  return shows ? out : Played{};
}

/// Tiles of the feature's mode, side by side, cut to few sheets and records. Fewer tiles if there are not enough. Of
/// four splats three lie between two phases.
testbench::StreamDocument short_stream(const Feature& feature, const Config& config, std::uint64_t seed) {
  auto out = testbench::make_stimulus(config, testbench::StimulusClass::Mixed, seed, kSplats).document;
  std::erase_if(out.tiles, [&](const auto& tile) { return tile.begin.mode != feature.mode; });
  out.tiles.resize(std::min(out.tiles.size(), kTiles));
  out.width = kWidth * static_cast<int>(kTiles);
  out.height = kHeight;
  int x = 0, number = 0;
  for (testbench::TileDocument& tile : out.tiles) {
    tile.begin.x = std::exchange(x, x + kWidth);
    tile.begin.y = 0;
    tile.begin.width = kWidth;
    tile.begin.height = kHeight;
    tile.sheets.resize(std::min(tile.sheets.size(), kSheets));
    for (testbench::SheetDocument& sheet : tile.sheets) {
      sheet.records.resize(std::min(sheet.records.size(), kRecords));
      for (testbench::SheetRecord& record : sheet.records) {
        if (auto* splat = std::get_if<cmodel::SplatRecord>(&record))
          splat->x |= number & 1, splat->y |= number >> 1 & 1;
        ++number;
      }
    }
  }
  return out;
}

/// An opaque half, an empty sheet, and splats over both: some in a set.
testbench::StreamDocument culled_stream(const Config& config, std::uint64_t seed) {
  testbench::Random random(seed);
  auto out = testbench::sets_frame(config, random);
  out.tiles.resize(1);
  auto& sheets = out.tiles.front().sheets;
  sheets.erase(sheets.begin());
  sheets.resize(3);
  sheets.back().records.resize(kCulledRecords);
  return out;
}

/// The shortest of some random streams. What a fault could change is worth some characters: each counter above 0, each
/// different word, each pixel of a footprint.
Beats stream_of(const Feature& feature, const Config& config, Played& best) {
  constexpr int kCounter = 400, kWord = 40, kPixel = 20;
  Beats out;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto document = config.culls() ? culled_stream(config, seed) : short_stream(feature, config, seed);
    if (document.tiles.size() < (config.culls() ? 1 : kTiles)) continue;
    const Beats beats = testbench::write_document(config, document);
    const Played played = play(config, beats);
    const auto price = [&](const Played& of) {
      return static_cast<int>(of.text.size()) - kCounter * of.counted - kWord * of.values - kPixel * of.drawn;
    };
    if (played.text.empty() || (!out.empty() && price(played) >= price(best))) continue;
    best = played;
    out = beats;
  }
  if (out.empty()) throw std::runtime_error(fmt::format("no stream shows '{}' in {} seeds", feature.name, kSeeds));
  return out;
}

/// For each rule, a beat that the device refuses behind the first beats of the stream, not of a kind in `shown`.
std::string refusals(const Config& config, const Beats& beats, std::set<std::string>& shown) {
  std::string asked, answered;
  std::set<cmodel::StreamRule> rules;
  for (const auto& violation : testbench::violations(config, beats)) {
    if (rules.contains(violation.rule) || shown.contains(violation.name)) continue;
    Beats broken = beats;
    violation.commit(broken);
    const auto refused = testbench::refused_by_model(config, broken);
    const auto differs = static_cast<std::size_t>(std::ranges::mismatch(beats, broken).in1 - beats.begin());
    if (!refused || refused->beat != differs) continue;
    if (differs == 0 && !testbench::begins_frame(broken[0])) continue;
    rules.insert(violation.rule);
    shown.insert(violation.name);
    asked += fmt::format("refuse {} {}  # {}\n", differs, hex(broken[differs]), violation.name);
    answered += fmt::format("refused {} {}\n", static_cast<int>(refused->rule), differs);
  }
  return asked + answered;
}

int write(const std::filesystem::path& folder) {
  std::size_t bytes = 0;
  std::set<std::string> shown;
  for (const Feature& feature : kFeatures) {
    const Config config = config_of(feature);
    Played played;
    const Beats beats = stream_of(feature, config, played);
    std::string text = fmt::format("# {}: {}. Generated (docs/stream.md, \"Vectors\"); do not edit.\nconfig tiny\n",
                                   feature.name, feature.what);
    for (const auto& [key, value] : keys_of(feature)) text += fmt::format("set {}={}\n", key, value);
    text += played.text;
    if (feature.refuses) text += refusals(config, beats, shown);
    std::ofstream out(folder / (std::string(feature.name) + ".txt"), std::ios::binary);
    out << text;
    if (!out.flush()) throw std::runtime_error("cannot write to " + folder.string());
    fmt::print("{}: {} beats, {} bytes, {} counters above 0, {} different words\n", feature.name, beats.size(),
               text.size(), played.counted, played.values);
    bytes += text.size();
  }
  fmt::print("all: {} bytes\n", bytes);
  return 0;
}

}  // namespace
}  // namespace fastsplat

int main(int argc, char** argv) {
  try {
    if (argc == 2) return fastsplat::write(argv[1]);
    std::cerr << "usage: fastsplat_vectors FOLDER\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << "fastsplat_vectors: " << error.what() << "\n";
    return 1;
  }
}
