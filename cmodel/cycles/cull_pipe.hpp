// SPDX-License-Identifier: Apache-2.0
// When beats pass the cull unit's registers and when its tables are complete (docs/microarchitecture.md, "Culling").
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "cmodel/cycles/cycle_stages.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel {

class CullPipe {
 public:
  explicit CullPipe(const Config& config)
      : lanes_(config.lanes), by_pixels_(config.cull_map == static_cast<int>(CullMap::Pixel)) {}

  /// A beat's way through t0 .. t3. Moves happen at the end of a cycle.
  struct Passage {
    std::uint64_t entered = 0;  ///< it moves into t0
    std::uint64_t verdict = 0;  ///< first cycle in t3, where its verdict is known
    std::uint64_t left = 0;     ///< it moves into decode's register
    std::uint64_t waited = 0;   ///< cycles in t0 only because of a table
  };
  /// Check passes it in cycle `checked`; decode takes a beat from cycle `ready` on.
  Passage pass(std::uint64_t checked, std::uint64_t ready, bool begin_sheet) {
    Passage out;
    out.entered = std::max(checked, free_[0]);
    std::uint64_t moved = std::max(out.entered + 1, free_[1]);
    if (begin_sheet) {
      const std::uint64_t whole = std::max(moved, whole_[sheet_ % 2]);
      out.waited = whole - moved;
      moved = whole;
      ++sheet_;
    }
    free_[0] = moved;
    for (std::size_t stage = 1; stage < stages::kCullStages; ++stage) {
      if (stage + 1 == stages::kCullStages) out.verdict = moved + 1;
      const std::uint64_t next = stage + 1 < stages::kCullStages ? free_[stage + 1] : ready;
      moved = std::max(moved + 1, next);
      free_[stage] = moved;
    }
    out.left = moved;
    return out;
  }

  void begin_tile(int width, int height) {
    rows_ = (height + lanes_ - 1) / lanes_;
    row_cycles_ =
        by_pixels_ ? static_cast<std::uint64_t>(lanes_) * static_cast<std::uint64_t>((width + lanes_ - 1) / lanes_) : 1;
    sheet_ = 0;
    done_ = 0;
    built_ = 0;
    whole_.fill(0);
    changed_.fill(0);  // the tables hold another tile
    opaque_ = false;
  }
  int rows() const { return rows_; }  ///< of blocks

  /// A sheet's last block was picked in cycle `last`. `row`: the first row of blocks in which a cell became opaque, or
  /// rows().
  void composited(std::uint64_t last, int row) {
    opaque_ = opaque_ || row < rows_;
    const std::size_t table = done_++ % 2;
    built_ = std::max(built_, last + stages::kComposite);  // what to build is not known before
    if (opaque_) {                                         // else no cell of the tile is opaque yet
      for (int& first : changed_) first = std::min(first, row);
      built_ += static_cast<std::uint64_t>(rows_ - changed_[table]) * row_cycles_;
      changed_[table] = rows_;
    }
    whole_[table] = built_ + 1;
  }

 private:
  int lanes_;
  bool by_pixels_;
  std::array<std::uint64_t, stages::kCullStages> free_{};  ///< first cycle in which each takes a beat
  std::array<std::uint64_t, 2> whole_{};                   ///< of sheets 0, 2, 4 and of 1, 3, 5: readable from then on
  std::array<int, 2> changed_{};                           ///< first row of blocks to rebuild in each table
  std::uint64_t built_ = 0;                                ///< last cycle in which a table was written
  std::uint64_t row_cycles_ = 1;                           ///< to build a row of blocks
  std::uint64_t sheet_ = 0, done_ = 0;
  int rows_ = 0;
  bool opaque_ = false;
};

}  // namespace fastsplat::cmodel
