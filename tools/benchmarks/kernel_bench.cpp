// SPDX-License-Identifier: Apache-2.0
// The row kernel alone, compared with the bound of the first-level cache: footprints of 7 pixels in 16-bit words, i.e.
// 7 rows of 64 bytes each.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <vector>

#include "cmodel/splat/snap.hpp"
#include "tools/benchmarks/rmw_loop.hpp"
#include "tools/benchmarks/row_units.hpp"

namespace fastsplat {
namespace {

using bench::Order;

constexpr int kExtent = 7;
constexpr std::size_t kJobs = 256;  ///< splats per call, as in the fast unit

std::vector<cmodel::fast::SplatJob> jobs_of(const bench::Rows& rows, const cmodel::fast::FrameTables& tables) {
  cmodel::NullPixels nowhere;
  cmodel::fast::TileUnit<std::uint16_t> unit(tables, nowhere);
  unit.begin_tile({.width = rows.config.tile_width, .height = rows.config.tile_height});
  std::vector<cmodel::fast::SplatJob> jobs;
  for (const cmodel::SplatRecord& record : rows.records) {
    const std::uint32_t rho = tables.memo.shape(0).rho;
    const auto placed = unit.place(0, snap(rows.config, record.x, rho), snap(rows.config, record.y, rho));
    cmodel::fast::SplatJob job{
        .weights = placed.weights, .at = placed.at, .columns = placed.across, .rows = placed.down};
    for (std::size_t c = 0; c < 4; ++c)
      job.colour[c] = static_cast<std::uint16_t>(record.colour[c] << tables.plan.colour_shift);
    jobs.push_back(job);
  }
  return jobs;
}

/// Words saturate after some rounds, which takes no longer.
void kernel(benchmark::State& state, Order order) {
  const bench::Rows rows("compact", kExtent, order);
  const auto tables = cmodel::fast::frame_tables(rows.config, rows.preamble);
  if (!tables) return state.SkipWithError("no fast unit here");
  const auto jobs = jobs_of(rows, *tables);
  cmodel::fast::Sheet<std::uint16_t> sheet;
  sheet.resize(rows.config.tile_width, rows.config.tile_height, tables->reach);
  for (auto _ : state) {
    for (std::size_t at = 0; at < jobs.size(); at += kJobs) {
      const auto some = std::span(jobs).subspan(at, std::min(kJobs, jobs.size() - at));
      benchmark::DoNotOptimize(add_splats(tables->plan, some, sheet.words(), sheet.row()));
    }
  }
  bench::count_splats(state, jobs.size());
}

/// The same number of rows at the same offsets within a cache line, but without waiting for each other: each footprint
/// lies beside the previous one, not over it.
void bound(benchmark::State& state) {
  const bench::Rows rows("compact", kExtent, Order::Slice);
  constexpr std::size_t kBands = 4, kAcross = 6;  // 576 bytes x 32 rows: under 20 KB
  std::vector<std::uint16_t> memory(kBands * 8 * bench::kRmwRow / 2 + 64, 0);
  auto* const first = memory.data() + (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64 / 2;
  std::vector<std::uint32_t> places;
  for (std::size_t i = 0; i < rows.records.size(); ++i) {
    const auto pixel = static_cast<std::size_t>(rows.records[i].x >> rows.config.position_frac_bits) % 8;
    places.push_back(
        static_cast<std::uint32_t>(i / kAcross % kBands * 8 * bench::kRmwRow / 2 + i % kAcross * 32 + pixel * 4));
  }
  for (auto _ : state) {
    bench::rmw(places, kExtent, first);
    benchmark::ClobberMemory();
  }
  bench::count_splats(state, places.size());
}

BENCHMARK(bound)->Name("bound/slice7/compact")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kernel, slice, Order::Slice)->Name("kernel/slice7/compact")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(kernel, anywhere, Order::Anywhere)->Name("kernel/rows7/compact")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace fastsplat
