// SPDX-License-Identifier: Apache-2.0
// The same inner loop in SystemC's sc_ufixed types, in the plain unit and in the fast one: splats of 7 pixels, CPU
// time. First compares every sum with the plain unit's, window by window, on a stream that also saturates.
#include <benchmark/benchmark.h>

#include <stdexcept>

#include "cmodel/model.hpp"
#include "tools/benchmarks/peers/peer_main.hpp"
#include "tools/benchmarks/peers/sc_splatter.hpp"
#include "tools/benchmarks/row_units.hpp"

namespace fastsplat::bench {
namespace {

constexpr int kExtent = 7;

std::unique_ptr<ScSplatter> splatter_of(const cmodel::Config& config) {
  auto splatter = make_sc_splatter(config, driver::rlut_table(config, 0, kExtent / 2.0, 0),
                                   driver::radial_table(config, scene::kernel_by_name("smooth")));
  if (!splatter) throw std::runtime_error("unsupported SystemC widths of " + config.name);
  return splatter;
}

/// Adds each splat after the plain unit has, and compares the window.
class Beside final : public cmodel::TapSink {
 public:
  Beside(const Rows& rows, ScSplatter& splatter) : rows_(rows), splatter_(splatter) {}
  void on_tap(const cmodel::TapRecord& record) override {
    if (record.tap != cmodel::Tap::Sheet) return;
    splatter_.splats(std::span(rows_.records).subspan(record.tag, 1));
    const int lanes = rows_.config.lanes;
    std::size_t at = 0;
    for (int y = record.y; y < record.y + lanes; ++y) {
      for (int x = record.x; x < record.x + lanes; ++x) {
        for (std::size_t c = 0; c < 4; ++c, ++at) {
          if (x >= rows_.config.tile_width || y >= rows_.config.tile_height) continue;
          ++words;
          different += splatter_.word(x, y, c) != record.payload[at] ? 1 : 0;
        }
      }
    }
  }
  std::uint64_t words = 0, different = 0;

 private:
  const Rows& rows_;
  ScSplatter& splatter_;
};

/// Bright splats, so that some products round up and some sums saturate.
void same_words(benchmark::State& state, const std::string& config) {
  const Rows rows(config, kExtent, Order::Anywhere, 8000, 1);
  const auto splatter = splatter_of(rows.config);
  Beside beside(rows, *splatter);
  cmodel::NullPixels pixels;
  cmodel::Model model(rows.config, cmodel::StreamScope::Subset, pixels, &beside);
  for (auto _ : state) {
    model.consume(rows.preamble);
    model.consume(rows.tile);
  }
  state.counters["words"] = static_cast<double>(beside.words);
  state.counters["different"] = static_cast<double>(beside.different);
  state.counters["saturated"] = static_cast<double>(model.counters().sheet_saturated);
  if (beside.different != 0 || beside.words == 0 || model.counters().sheet_saturated == 0)
    throw std::runtime_error("the SystemC description of " + config + " differs from the plain unit");
}

void systemc(benchmark::State& state, const std::string& config) {
  const Rows rows(config, kExtent);
  const auto splatter = splatter_of(rows.config);
  for (auto _ : state) {
    splatter->begin();
    splatter->splats(rows.records);
  }
}

void register_all() {
  for (const char* config : {"base", "compact"}) {
    benchmark::RegisterBenchmark((std::string("words/") + config).c_str(), same_words, config)
        ->Iterations(1)
        ->Repetitions(1);
    const auto line = [&](const char* who, auto run) {
      benchmark::RegisterBenchmark((std::string(who) + "/rows7/" + config).c_str(), run, config)
          ->Unit(benchmark::kMillisecond);
    };
    line("systemc", systemc);
    line("plain", [](benchmark::State& state, const std::string& name) { plain_rows(state, name, kExtent); });
    line("fast", [](benchmark::State& state, const std::string& name) { fast_rows(state, name, kExtent); });
  }
}

}  // namespace
}  // namespace fastsplat::bench

int main(int count, char** arguments) {
  return fastsplat::bench::run_peer(count, arguments, fastsplat::bench::register_all);
}
