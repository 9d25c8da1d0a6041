// SPDX-License-Identifier: Apache-2.0
// The plain device model: windows per second of each configuration, nanoseconds per composited pixel, beats per second
// of the stream decoder. Only ratios within one run are meaningful; absolute times depend on the machine.
#include <benchmark/benchmark.h>

#include <cmath>

#include "cmodel/composite/compositor.hpp"
#include "cmodel/model.hpp"
#include "cmodel/numbers/observers.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tables/tables.hpp"
#include "scene/kernel.hpp"

namespace fastsplat {
namespace {

using cmodel::Beat;
using cmodel::Config;

/// Pseudo-random numbers with a fixed seed: the same stream every time.
class Sequence {
 public:
  std::uint32_t below(std::uint32_t n) {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return static_cast<std::uint32_t>((state_ >> 33) % n);
  }

 private:
  std::uint64_t state_ = 1;
};

/// One full tile of `sheets` sheets with `splats` each at random positions; the footprint's radius just fills one
/// window.
std::vector<Beat> one_window_stream(const Config& config, int sheets, int splats) {
  const double radius = (config.lanes - 0.5) / 2;
  std::vector<Beat> beats;
  append(beats, cmodel::BeginFrame{config_hash(config), config.tile_width, config.tile_height, 1});
  append(beats, driver::rlut_table(config, 0, radius, 0));
  append(beats, driver::radial_table(config, scene::kernel_by_name("smooth")));
  append(beats, driver::factor_table(config));
  append(beats, cmodel::BeginTile{.width = config.tile_width, .height = config.tile_height});
  Sequence sequence;
  std::uint32_t tag = 0;
  // Dim, because terminated or saturated pixels take an unusual path.
  const std::uint32_t brightest = (1U << config.colour_frac_bits) / 16;
  for (int sheet = 0; sheet < sheets; ++sheet) {
    append(beats, cmodel::BeginSheet{static_cast<std::uint32_t>(sheet)});
    for (int i = 0; i < splats; ++i) {
      cmodel::SplatRecord splat{.tag = tag++};
      splat.x = static_cast<std::int32_t>(
          sequence.below(static_cast<std::uint32_t>(config.tile_width) << config.position_frac_bits));
      splat.y = static_cast<std::int32_t>(
          sequence.below(static_cast<std::uint32_t>(config.tile_height) << config.position_frac_bits));
      for (std::uint32_t& colour : splat.colour) colour = sequence.below(brightest);
      beats.push_back(to_beat(splat));
    }
    append(beats, cmodel::EndSheet{static_cast<std::uint32_t>(sheet), static_cast<std::uint32_t>(splats)});
  }
  append(beats, cmodel::EndTile{0, static_cast<std::uint32_t>(sheets)});
  return beats;
}

class Pixels final : public cmodel::PixelSink {
 public:
  void on_tile(cmodel::TilePixels&& tile) override { benchmark::DoNotOptimize(tile.words.data()); }
};

void splat_windows(benchmark::State& state, const std::string& name) {
  const Config config = driver::load_config(name);
  const std::vector<Beat> beats = one_window_stream(config, 4, 20000);
  std::uint64_t windows = 0, weighted = 0;
  for (auto _ : state) {
    Pixels pixels;
    cmodel::Model model(config, cmodel::StreamScope::Subset, pixels);
    model.consume(beats);
    model.finish();
    windows += model.counters().windows;
    weighted += model.counters().lanes_weighted;
  }
  state.counters["windows/s"] = benchmark::Counter(static_cast<double>(windows), benchmark::Counter::kIsRate);
  state.counters["weighted pixels/s"] = benchmark::Counter(static_cast<double>(weighted), benchmark::Counter::kIsRate);
}

void composite_pixels(benchmark::State& state, const std::string& name, cmodel::Mode mode) {
  const Config config = driver::load_config(name);
  cmodel::Compositor compositor(config);
  compositor.opacity().load(driver::factor_table(config).words);
  cmodel::Counters counters;
  cmodel::Counting observer{counters};
  Sequence sequence;
  // So transparent that no pixel terminates within the sheets of one round.
  std::vector<cmodel::SheetWord> sums(4096);
  for (auto& word : sums)
    for (auto& sum : word) sum = sequence.below(1 + (1U << config.sheet_frac_bits) / 64);
  const int side = 64;
  for (auto _ : state) {
    compositor.begin_tile(mode, side, side);
    for (int sheet = 0; sheet < 16; ++sheet)
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
          compositor.step(sums[static_cast<std::size_t>((y * side + x + sheet * 37) % 4096)], x, y, counters, observer);
    benchmark::DoNotOptimize(compositor.at(0, 0));
  }
  state.counters["time/pixel"] = benchmark::Counter(static_cast<double>(counters.pixels_composited),
                                                    benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  if (counters.frozen_pixels != 0) state.SkipWithError("pixels froze: the benchmark measures something else");
}

void decode_beats(benchmark::State& state, cmodel::StreamScope scope) {
  const Config config = driver::load_config("base");
  const std::vector<Beat> beats = one_window_stream(config, 4, 50000);
  for (auto _ : state) {
    cmodel::StreamDecode decode(config, scope);
    for (const Beat& beat : beats) benchmark::DoNotOptimize(decode.feed(beat));
  }
  state.counters["beats/s"] = benchmark::Counter(
      static_cast<double>(state.iterations()) * static_cast<double>(beats.size()), benchmark::Counter::kIsRate);
}

/// Runs before main, so that every built-in configuration has its own line.
const bool kRegistered = [] {
  for (const std::string& name : driver::config_names())
    benchmark::RegisterBenchmark(("windows/" + name).c_str(), splat_windows, name)->Unit(benchmark::kMillisecond);
  for (const char* name : {"base", "compact"}) {
    const std::string prefix = std::string("composite/") + name;
    benchmark::RegisterBenchmark((prefix + "/exponential").c_str(), composite_pixels, name, cmodel::Mode::Exponential);
    benchmark::RegisterBenchmark((prefix + "/additive").c_str(), composite_pixels, name, cmodel::Mode::Additive);
    benchmark::RegisterBenchmark((prefix + "/sum").c_str(), composite_pixels, name, cmodel::Mode::Sum);
  }
  benchmark::RegisterBenchmark("decode/subset", decode_beats, cmodel::StreamScope::Subset);
  benchmark::RegisterBenchmark("decode/whole (CRC)", decode_beats, cmodel::StreamScope::Whole);
  return true;
}();

}  // namespace
}  // namespace fastsplat
