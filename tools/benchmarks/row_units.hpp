// SPDX-License-Identifier: Apache-2.0
// The timed functions: both units on a tile full of splats.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>

#include "cmodel/fast/tile_unit.hpp"
#include "cmodel/model.hpp"
#include "tools/benchmarks/rows.hpp"

namespace fastsplat::bench {

inline void count_splats(benchmark::State& state, std::size_t splats) {
  state.counters["splats/s"] = benchmark::Counter(static_cast<double>(splats) * static_cast<double>(state.iterations()),
                                                  benchmark::Counter::kIsRate);
}

inline void plain_rows(benchmark::State& state, const std::string& config, int extent) {
  const Rows rows(config, extent);
  for (auto _ : state) {
    cmodel::NullPixels pixels;
    cmodel::Model model(rows.config, cmodel::StreamScope::Subset, pixels);
    model.consume(rows.preamble);
    model.consume(rows.tile);
  }
  count_splats(state, rows.records.size());
}

template <class Word>
void fast_rows_of(benchmark::State& state, const Rows& rows, const cmodel::fast::FrameTables& tables) {
  cmodel::NullPixels pixels;
  cmodel::fast::TileUnit<Word> unit(tables, pixels);
  for (auto _ : state) {
    unit.begin_tile({.width = rows.config.tile_width, .height = rows.config.tile_height});
    unit.splats(rows.records);
    if (!unit.sound()) state.SkipWithError("a sum was cut: the benchmark measures something else");
  }
  count_splats(state, rows.records.size());
}

inline void fast_rows(benchmark::State& state, const std::string& config, int extent) {
  const Rows rows(config, extent);
  const auto tables = cmodel::fast::frame_tables(rows.config, rows.preamble);
  if (!tables) return state.SkipWithError("no fast unit for it here");
  if (tables->plan.narrow)
    fast_rows_of<std::uint16_t>(state, rows, *tables);
  else
    fast_rows_of<std::uint32_t>(state, rows, *tables);
}

}  // namespace fastsplat::bench
