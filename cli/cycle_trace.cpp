// SPDX-License-Identifier: Apache-2.0
#include "cli/cycle_trace.hpp"

#include <fmt/format.h>

#include "cmodel/cycles/cycle_stages.hpp"

namespace fastsplat::cli {
namespace {

constexpr int kDecode = 1, kSplat = 2, kCompositor = 3, kPixelOut = 4;

}  // namespace

CycleTrace::CycleTrace() {
  const auto name = [this](int track, const char* text) {
    events_ += fmt::format(R"({}{{"ph":"M","pid":1,"tid":{},"name":"thread_name","args":{{"name":"{}"}}}})",
                           events_.empty() ? "" : ",\n", track, text);
    events_ += fmt::format(R"(,{}{{"ph":"M","pid":1,"tid":{},"name":"thread_sort_index","args":{{"sort_index":{}}}}})",
                           "\n", track, track);
  };
  name(kDecode, "decode");
  name(kSplat, "splat path (sums written)");
  name(kCompositor, "compositor (blocks picked)");
  name(kPixelOut, "pixel out");
}

void CycleTrace::slice(int track, const std::string& name, std::uint64_t from, std::uint64_t to,
                       const std::string& arguments) {
  if (from >= to) return;
  events_ += fmt::format(
      ",\n"
      R"({{"ph":"X","pid":1,"tid":{},"name":"{}","ts":{},"dur":{},"args":{{{}}}}})",
      track, name, from, to - from, arguments);
}

void CycleTrace::on_sheet(const cmodel::SheetCycles& sheet) {
  const std::string name = fmt::format("sheet {}", sheet.sheet);
  const std::string arguments = fmt::format(R"("tile":{},"windows":{},"blocks":{},"cycles":{})", sheet.tile,
                                            sheet.windows, sheet.blocks, sheet.closed + 1 - sheet.begun);
  slice(kDecode, "wait for a sheet buffer", sheet.offered, sheet.begun, "");
  slice(kDecode, name, sheet.begun, sheet.closed + 1, arguments);
  // The first window may come right after begin_sheet; the last comes right before end_sheet.
  if (sheet.windows > 0) {
    slice(kSplat, name, sheet.begun + 1 + cmodel::stages::kSheet, sheet.closed + cmodel::stages::kSheet, arguments);
  }
  slice(kCompositor, name, sheet.walk_from, sheet.walk_to, arguments);
}

void CycleTrace::on_tile(const cmodel::TileCycles& tile) {
  slice(kPixelOut, fmt::format("tile {}", tile.tile), tile.picture_from, tile.picture_to,
        fmt::format(R"("begun":{},"closed":{})", tile.begun, tile.closed));
}

std::string CycleTrace::text() const {
  return "{\"displayTimeUnit\":\"ns\",\"otherData\":{\"unit\":\"1 us = 1 clock cycle\"},\"traceEvents\":[\n" + events_ +
         "\n]}\n";
}

}  // namespace fastsplat::cli
