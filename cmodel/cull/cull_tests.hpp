// SPDX-License-Identifier: Apache-2.0
// The cull tests of a stream, record by record: which cull groups, splats and windows are hidden (docs/numerics.md,
// section 6.1), with their counts and their log.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/cull/cull_log.hpp"
#include "cmodel/cull/cull_sets.hpp"
#include "cmodel/cull/cull_unit.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::cmodel {

class CullTests {
 public:
  explicit CullTests(const Config& config) : lanes_(config.lanes), unit_(config) {}

  /// Logs all results from the next tile on; null: no log. Must outlive this object.
  void log(CullLog* log) { log_ = log; }
  const CullCounts& counts() const { return counts_; }
  /// Whether tests are made in this tile.
  bool on() const { return unit_.on(); }

  void begin_tile(const BeginTile& tile);
  void begin_sheet() { unit_.begin_sheet(); }
  /// Whether a cull group with this rectangle would be hidden in the open sheet.
  bool would_hide(const CullBlock& set) const { return unit_.on() && unit_.hidden(box_of(set)); }
  void cull_block(const CullBlock& record);
  /// Whether the next splat belongs to a hidden cull group; counts it as dropped.
  bool dropped(std::uint32_t tag);
  /// Tests a splat or ellipse: columns x rows windows from pixel (x,y) on.
  bool hidden(std::int32_t x, std::int32_t y, std::uint32_t columns, std::uint32_t rows);
  /// Tests each window of a splat, after hidden() returned false for it.
  void test_windows(std::int32_t x, std::int32_t y, std::uint32_t columns, std::uint32_t rows);
  /// The result of one window of the last splat. An ellipse's are not tested (N-6.1-10), so none is hidden.
  bool window_hidden(std::size_t number) const { return !hidden_windows_.empty() && hidden_windows_[number] != 0; }
  /// CullUnit::composited().
  template <class Frozen>
  void composited(int bx, int by, Frozen frozen) {
    unit_.composited(bx, by, frozen);
  }
  void end_sheet();

 private:
  PixelBox box_of_windows(std::int32_t x, std::int32_t y, std::uint32_t columns, std::uint32_t rows) const {
    return {x, y, x + columns * lanes_, y + rows * lanes_};
  }
  void add(bool hidden, std::size_t count = 1) {
    if (answers_ != nullptr) answers_->add(hidden, count);
  }

  std::int64_t lanes_;
  CullUnit unit_;
  CullSets<bool> sets_;  ///< cull groups, each with whether it is hidden
  CullCounts counts_;
  CullLog* log_ = nullptr;
  CullAnswers* answers_ = nullptr;            ///< of the open tile, if it is logged
  std::vector<std::uint8_t> hidden_windows_;  ///< of the last splat; empty if none is or none was tested
};

}  // namespace fastsplat::cmodel
