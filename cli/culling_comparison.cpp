// SPDX-License-Identifier: Apache-2.0
#include "cli/culling_comparison.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/output.hpp"
#include "cli/text_table.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

}  // namespace

std::string to_text(const std::vector<driver::CullRow>& rows) {
  TextTable table{.columns = {"cull.map", "source", "cycles", "times fewer", "ms at 100 MHz", "% drawn", "windows",
                              "blocks", "hidden", "records", "table", "map", "waits", "pixels"},
                  .rows = {}};
  const driver::CullRow& off = rows.front();
  for (const driver::CullRow& row : rows) {
    const auto& a = row.account;
    table.rows.push_back({row.map, row.fetch ? fmt::format("fetch, {}", *row.fetch) : "all sent", grouped(row.cycles),
                          fmt::format("{:.2f}", ratio(off.cycles, row.cycles)),
                          fmt::format("{:.2f}", static_cast<double>(row.cycles) / 100'000.0),
                          fmt::format("{:.1f}", 100.0 * driver::share_drawn(row, off)), grouped(row.counters.windows),
                          grouped(a.ideal - row.counters.windows), grouped(a.hidden), grouped(a.records),
                          grouped(a.table_load), grouped(a.map), grouped(a.input + a.sheet_buffer + a.drain),
                          grouped(a.pixels + a.output)});
  }
  return to_text(table);
}

Json to_json(const std::vector<driver::CullRow>& rows) {
  Json out = Json::array();
  for (const driver::CullRow& row : rows) {
    Json one{{"cull_map", row.map}, {"fetch", row.fetch.has_value()}};
    if (row.fetch) one["fetch_latency"] = *row.fetch;
    one["cycles"] = row.cycles;
    one["times_fewer"] = ratio(rows.front().cycles, row.cycles);
    one["share_drawn"] = driver::share_drawn(row, rows.front());
    one["beats"] = row.beats;
    one["windows"] = row.counters.windows;
    one["dirty_blocks"] = row.counters.dirty_blocks;
    row.account.for_each([&](const char* name, std::uint64_t cycles, const char*) { one["account"][name] = cycles; });
    one["tests"] = {{"sets", row.culls.set_tests},
                    {"sets_hidden", row.culls.hidden_sets},
                    {"splats", row.culls.splat_tests},
                    {"splats_hidden", row.culls.hidden_splats},
                    {"windows_hidden", row.culls.hidden_windows}};
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace fastsplat::cli
