// SPDX-License-Identifier: Apache-2.0
// One sheet over a band of image rows, or over the whole frame: sums per pixel, and the touched part of each row.
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <vector>

#include "golden/splat/footprint.hpp"
#include "golden/splat/projected_splat.hpp"

namespace fastsplat::golden {

/// Pixels of one row, [begin, end).
struct Run {
  int begin = 0;
  int end = 0;

  bool empty() const { return begin >= end; }
  int size() const { return empty() ? 0 : end - begin; }
};

/// Allocates memory aligned to cache lines, so that each Sums lies in one line.
template <class T>
struct LineAllocator {
  using value_type = T;
  static constexpr std::align_val_t kLine{64};
  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kLine)); }
  void deallocate(T* at, std::size_t) { ::operator delete(at, kLine); }
  bool operator==(const LineAllocator&) const { return true; }
};

/// Rows are independent: threads may add to different rows of one sheet.
class Sheet {
 public:
  Sheet(Rows rows, int width)
      : rows_(rows),
        width_(width),
        pitch_(pitch_for(width)),
        sums_(static_cast<std::size_t>(rows.end - rows.first) * pitch_),
        touched_(rows.end - rows.first, Run{width, 0}) {}

  /// Adds value * weight on every pixel of a footprint that was rasterised for rows of this sheet.
  void add(const Footprint& footprint, const Sums& value) {
    for (const Footprint::Span& span : footprint.spans()) {
      const double* weights = footprint.weights(span);
      Sums* sums = row(span.y) + span.x;
      for (int i = 0; i < span.width; ++i) {
        for (int c = 0; c < 4; ++c) sums[i][c] += weights[i] * value[c];
      }
      touch(span.y, {span.x, span.x + span.width});
    }
  }

  void touch(int y, Run run) {
    Run& touched = touched_[y - rows_.first];
    touched = {std::min(touched.begin, run.begin), std::max(touched.end, run.end)};
  }

  int width() const { return width_; }
  Rows rows() const { return rows_; }
  /// Outside this run of row y all sums are 0.
  Run touched(int y) const { return touched_[y - rows_.first]; }
  std::size_t pitch() const { return pitch_; }  ///< pixels from row to row
  Sums* row(int y) { return &sums_[static_cast<std::size_t>(y - rows_.first) * pitch_]; }
  const Sums* row(int y) const { return &sums_[static_cast<std::size_t>(y - rows_.first) * pitch_]; }

  void clear_row(int y) {
    Run& touched = touched_[y - rows_.first];
    if (!touched.empty()) std::fill(row(y) + touched.begin, row(y) + touched.end, Sums{});
    touched = {width_, 0};
  }

 private:
  /// Rows a multiple of 4 KiB apart would evict each other from the cache: a footprint has several, in several sheets.
  /// So rows lie an odd number of cache lines apart.
  static std::size_t pitch_for(int width) {
    constexpr std::size_t kPixelsInLine = 64 / sizeof(Sums);
    const std::size_t lines = (static_cast<std::size_t>(width) + kPixelsInLine - 1) / kPixelsInLine;
    return (lines | 1) * kPixelsInLine;
  }

  Rows rows_;
  int width_;
  std::size_t pitch_;
  std::vector<Sums, LineAllocator<Sums>> sums_;
  std::vector<Run> touched_;
};

}  // namespace fastsplat::golden
