// SPDX-License-Identifier: Apache-2.0
// Log of a frame's cull tests and of its map's changes, by tile. Timing depends on no other property of the pixels
// (M-cull-2).
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <vector>

namespace fastsplat::cmodel {

/// Numbers of cull tests and of their results.
struct CullCounts {
  std::uint64_t set_tests = 0, hidden_sets = 0;
  std::uint64_t splat_tests = 0, hidden_splats = 0;  ///< without splats that were dropped
  std::uint64_t dropped = 0;                         ///< splats of hidden cull groups that were sent, and dropped
  std::uint64_t hidden_windows = 0;                  ///< of splats that are not hidden

  CullCounts& operator+=(const CullCounts& other) {
    set_tests += other.set_tests;
    hidden_sets += other.hidden_sets;
    splat_tests += other.splat_tests;
    hidden_splats += other.hidden_splats;
    dropped += other.dropped;
    hidden_windows += other.hidden_windows;
    return *this;
  }
  bool operator==(const CullCounts&) const = default;
};

/// Answers of one tile's tests in the order of the stream: one for each cull_block and for each splat that is not
/// dropped. A visible splat (no ellipse) of several windows has one more for each of them, row by row. Also, for each
/// sheet, the first row of blocks in which a cell became opaque; the number of rows if none did. Both are empty in a
/// tile without tests.
class CullAnswers {
 public:
  void add(bool hidden) { add(hidden, 1); }
  /// `count` equal answers.
  void add(bool hidden, std::size_t count) {
    words_.resize((size_ + count + 63) / 64);
    for (const std::size_t end = size_ + count; size_ < end;) {
      const std::size_t here = std::min(64 - size_ % 64, end - size_);
      if (hidden) words_[size_ / 64] |= ~std::uint64_t{0} >> (64 - here) << size_ % 64;
      size_ += here;
    }
  }
  bool operator[](std::size_t at) const {
    check(at, 1);
    return (words_[at / 64] >> at % 64 & 1) != 0;
  }
  /// 1 to 64 answers, the first lowest; 1: hidden.
  std::uint64_t bits(std::size_t at, std::size_t count) const {
    check(at, count);
    std::uint64_t out = words_[at / 64] >> at % 64;
    if (at % 64 + count > 64) out |= words_[at / 64 + 1] << (64 - at % 64);
    return out & ~std::uint64_t{0} >> (64 - count);
  }
  /// Whether one of `count` answers is that something is hidden.
  bool any(std::size_t at, std::size_t count) const {
    for (std::size_t here = 0; count > 0; at += here, count -= here) {
      here = std::min<std::size_t>(count, 64);
      if (bits(at, here) != 0) return true;
    }
    return false;
  }
  std::size_t size() const { return size_; }
  void add_sheet(int row) { rows_.push_back(row); }
  int first_row(std::size_t sheet) const { return rows_.at(sheet); }
  bool operator==(const CullAnswers&) const = default;

 private:
  void check(std::size_t at, std::size_t count) const {
    if (count > size_ || at > size_ - count) throw std::out_of_range("cull answers are missing");
  }

  std::vector<std::uint64_t> words_;  ///< the first answer lowest
  std::size_t size_ = 0;
  std::vector<int> rows_;  ///< by sheet
};

/// Answers by tile number. Tiles are independent: merge() joins logs of different tiles.
class CullLog {
 public:
  CullAnswers& tile(std::uint32_t number) { return tiles_[number]; }
  /// Null if the tile is not in the log.
  const CullAnswers* find(std::uint32_t number) const {
    const auto found = tiles_.find(number);
    return found == tiles_.end() ? nullptr : &found->second;
  }
  void clear() { tiles_.clear(); }
  void merge(CullLog&& other) { tiles_.merge(other.tiles_); }
  std::size_t size() const { return tiles_.size(); }
  bool operator==(const CullLog&) const = default;

 private:
  std::map<std::uint32_t, CullAnswers> tiles_;
};

}  // namespace fastsplat::cmodel
