// Unit "density ring": the live sheets of a tile of densities. A sheet waits for the one behind it, to be classified
// between its neighbours (docs/numerics.md, section 6.2).
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace fastsplat::cmodel {

/// A finished sheet of densities, the rim of one pixel with it.
class DensitySheet {
 public:
  /// Of width x height pixels, all 0: the sheet that is not there.
  DensitySheet(int width, int height)
      : width_(width), words_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0) {}
  /// Takes what was splatted out of the buffer, which is clear after that.
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
  /// Pixel (0,0) is the rim's.
  std::int64_t at(int x, int y) const {
    return words_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
  }
  /// Dirty ones, row by row.
  const std::vector<std::pair<int, int>>& blocks() const { return blocks_; }

 private:
  int width_;
  std::uint32_t number_ = 0;
  std::vector<std::uint32_t> words_;
  std::vector<std::pair<int, int>> blocks_;
};

class DensityRing {
 public:
  /// Sides with the rim.
  void begin_tile(int width, int height) {
    const DensitySheet none(width, height);
    before_ = here_ = behind_ = empty_ = none;
    waiting_ = false;
  }
  /// The sheet that was splatted has ended: classify(before, here, behind) of the one that waited.
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
