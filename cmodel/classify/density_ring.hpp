// SPDX-License-Identifier: Apache-2.0
// Unit "density ring": the live sheets of a tile of densities. A sheet waits for the one behind it and is then
// classified between its neighbours (N-6.2-4).
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace fastsplat::cmodel {

/// A finished sheet of densities with a halo of one pixel.
class DensitySheet {
 public:
  /// A missing sheet: width x height pixels, all 0.
  DensitySheet(int width, int height)
      : width_(width), words_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0) {}
  /// Moves the densities out of the buffer, which is clear after that.
  template <class Buffer>
  void take(Buffer& from, std::uint32_t number, int lanes) {
    number_ = number;
    blocks_.clear();
    std::fill(words_.begin(), words_.end(), 0);
    const int height = static_cast<int>(words_.size()) / width_;
    from.drain([&](int bx, int by) {
      blocks_.emplace_back(bx, by);
      for (int y = by * lanes; y < std::min((by + 1) * lanes, height); ++y) {
        for (int x = bx * lanes; x < std::min((bx + 1) * lanes, width_); ++x)
          words_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] =
              from.at(x, y)[3];
      }
    });
  }

  std::uint32_t number() const { return number_; }
  /// Pixel (0,0) is the halo's.
  std::int64_t at(int x, int y) const {
    return words_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }
  /// Dirty blocks, row by row.
  const std::vector<std::pair<int, int>>& blocks() const { return blocks_; }

 private:
  int width_;
  std::uint32_t number_ = 0;
  std::vector<std::uint32_t> words_;
  std::vector<std::pair<int, int>> blocks_;
};

class DensityRing {
 public:
  /// Sides include the halo.
  void begin_tile(int width, int height) {
    const DensitySheet none(width, height);
    before_ = here_ = behind_ = empty_ = none;
    waiting_ = false;
  }
  /// Ends the sheet in `splatted` and calls classify(before, here, behind) for the one that waited, if any.
  template <class Buffer, class Classify>
  void end_sheet(Buffer& splatted, std::uint32_t number, int lanes, Classify classify) {
    behind_.take(splatted, number, lanes);
    const bool next = waiting_ && number == here_.number() + 1;
    if (waiting_) classify(before_, here_, next ? behind_ : empty_);
    std::swap(before_, here_);
    std::swap(here_, behind_);
    if (!next) before_ = empty_;
    waiting_ = true;
  }
  template <class Classify>
  void end_tile(Classify classify) {
    if (waiting_) classify(before_, here_, empty_);
    waiting_ = false;
  }

 private:
  DensitySheet before_{0, 0}, here_{0, 0}, behind_{0, 0}, empty_{0, 0};
  bool waiting_ = false;
};

}  // namespace fastsplat::cmodel
