// SPDX-License-Identifier: Apache-2.0
#include "testbench/triage/shrink.hpp"

#include <algorithm>
#include <set>

namespace fastsplat::testbench {
namespace {

using Fails = std::function<bool(const StreamDocument&)>;
/// Whether part number n stays.
using Keep = std::vector<bool>;

class Shrinker {
 public:
  Shrinker(StreamDocument document, const Fails& fails, int most_runs)
      : document_(std::move(document)), fails_(fails), runs_left_(most_runs) {}

  /// One level of detail: `count` parts, `without` builds the document of those kept. True if any part went.
  template <class Count, class Without>
  bool reduce(Count count, Without without) {
    bool any = false;
    std::size_t parts = count(document_);
    for (std::size_t piece = (parts + 1) / 2; piece >= 1; piece = piece == 1 ? 0 : (piece + 1) / 2) {
      for (std::size_t first = 0; first < parts;) {
        if (runs_left_ <= 0) return any;
        Keep keep(parts, true);
        const std::size_t end = std::min(parts, first + piece);
        std::fill(keep.begin() + static_cast<std::ptrdiff_t>(first), keep.begin() + static_cast<std::ptrdiff_t>(end),
                  false);
        if (try_with(without(document_, keep))) {
          any = true;
          parts = count(document_);
        } else {
          first = end;
        }
      }
    }
    return any;
  }

  bool try_with(StreamDocument candidate) {
    --runs_left_;
    if (!fails_(candidate)) return false;
    document_ = std::move(candidate);
    return true;
  }

  int runs_left() const { return runs_left_; }
  StreamDocument take() { return std::move(document_); }

 private:
  StreamDocument document_;
  const Fails& fails_;
  int runs_left_;
};

/// Erases the parts that `keep` excludes; they have the numbers first, first+1, ... Returns how many there were.
template <class Part>
std::size_t leave_out(std::vector<Part>& parts, const Keep& keep, std::size_t first) {
  const std::size_t count = parts.size();
  std::vector<Part> left;
  for (std::size_t i = 0; i < count; ++i) {
    if (keep[first + i]) left.push_back(std::move(parts[i]));
  }
  parts = std::move(left);
  return count;
}

StreamDocument without_tiles(const StreamDocument& document, const Keep& keep) {
  StreamDocument out = document;
  leave_out(out.tiles, keep, 0);
  return out;
}

std::size_t count_sheets(const StreamDocument& document) {
  std::size_t count = 0;
  for (const auto& tile : document.tiles) count += tile.sheets.size();
  return count;
}

StreamDocument without_sheets(const StreamDocument& document, const Keep& keep) {
  StreamDocument out = document;
  std::size_t number = 0;
  for (auto& tile : out.tiles) number += leave_out(tile.sheets, keep, number);
  return out;
}

std::size_t count_records(const StreamDocument& document) {
  std::size_t count = 0;
  for (const auto& tile : document.tiles) {
    for (const auto& sheet : tile.sheets) count += sheet.records.size();
  }
  return count;
}

StreamDocument without_records(const StreamDocument& document, const Keep& keep) {
  StreamDocument out = document;
  std::size_t number = 0;
  for (auto& tile : out.tiles) {
    for (auto& sheet : tile.sheets) number += leave_out(sheet.records, keep, number);
  }
  return out;
}

/// Radius sets that no splat uses any more.
StreamDocument without_idle_sets(const StreamDocument& document) {
  std::set<std::uint32_t> used;
  for (const auto& tile : document.tiles) {
    for (const auto& sheet : tile.sheets) {
      for (const auto& record : sheet.records) {
        if (const auto* splat = std::get_if<cmodel::SplatRecord>(&record)) used.insert(splat->set);
      }
    }
  }
  StreamDocument out = document;
  std::erase_if(out.tables, [&](const cmodel::LoadTable& table) {
    return table.table == cmodel::Table::Rlut && !used.contains(table.radius.set);
  });
  return out;
}

}  // namespace

StreamDocument shrink(StreamDocument document, const Fails& fails, int most_runs, ShrinkReport& report) {
  report.splats_before = document.splats();
  Shrinker shrinker(std::move(document), fails, most_runs);
  bool again = true;
  while (again && shrinker.runs_left() > 0) {
    again = shrinker.reduce([](const auto& d) { return d.tiles.size(); }, without_tiles);
    again = shrinker.reduce(count_sheets, without_sheets) || again;
    again = shrinker.reduce(count_records, without_records) || again;
  }
  report.finished = !again;
  StreamDocument out = shrinker.take();
  const StreamDocument idle = without_idle_sets(out);
  report.runs = most_runs - shrinker.runs_left();
  if (idle.tables.size() < out.tables.size()) {
    ++report.runs;
    if (fails(idle)) out = idle;
  }
  report.splats_after = out.splats();
  return out;
}

}  // namespace fastsplat::testbench
