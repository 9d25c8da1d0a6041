// SPDX-License-Identifier: Apache-2.0
// Settled pixels of a band of rows: splats behind them do not change their stored value. A splat that reaches only
// settled pixels need not be drawn.
#pragma once

#include <cstdint>
#include <vector>

#include "golden/splat/composite.hpp"
#include "golden/splat/footprint.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden {

/// Whether no layer behind can change the floats that store() writes. A layer whose colour is at most its opacity adds
/// at most T * alpha to a channel, so all of them together add between 0 and T, in exact arithmetic. Rounding of the
/// sums at most doubles each contribution, and products of thousands of factors drift by less than a thousandth. A
/// channel therefore ends between c - 4T and c + 4T. Rounding to float is monotone: if both ends round to the same
/// float, so does all between them. A transmittance of 0 is the simplest case.
inline bool settled(const FrontToBack& pixel) {
  if (!(pixel.transmittance < 0x1p-25)) return false;  // below it 1 - T is 1 as a float
  const double room = 4.0 * pixel.transmittance;
  const auto fixed = [room](double sum) { return static_cast<float>(sum - room) == static_cast<float>(sum + room); };
  return fixed(pixel.red) && fixed(pixel.green) && fixed(pixel.blue);
}

/// Whether all splats are finite and none is brighter than it is opaque, as settled() assumes. Footprints and shares
/// are the same factors for all channels and rounding is monotone, so this carries over from splats to sums.
bool never_brighter_than_opaque(const std::vector<scene::Splat>& splats);

class SettledPixels {
 public:
  SettledPixels(Rows rows, int width);

  void settle(int x, int y);
  bool at(int x, int y) const { return (word(x, y) >> (x & 63) & 1u) != 0; }
  /// First pixel of [begin, end) in row y that is not settled (next_settled: that is settled); `end` if none.
  int next_open(int begin, int end, int y) const { return next(begin, end, y, 0); }
  int next_settled(int begin, int end, int y) const { return next(begin, end, y, ~std::uint64_t{0}); }

  /// Drops rows at either end in which the splat reaches only settled pixels. Empty: the splat cannot be seen.
  Rows open_rows(const ProjectedSplat& splat, Rows rows) const;

 private:
  std::uint64_t word(int x, int y) const { return row(y)[x >> 6]; }
  const std::uint64_t* row(int y) const { return &bits_[static_cast<std::size_t>(y - rows_.first) * words_]; }
  int next(int begin, int end, int y, std::uint64_t flip) const;

  Rows rows_;
  int width_;
  std::size_t words_;  ///< per row
  std::vector<std::uint64_t> bits_;
  bool any_ = false;
};

}  // namespace fastsplat::golden
