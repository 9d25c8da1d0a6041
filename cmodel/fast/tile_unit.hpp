// The fast unit: one tile's records to words and counters, the same as the plain unit's bit for bit, without taps.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cmodel/compositor.hpp"
#include "cmodel/counters.hpp"
#include "cmodel/device.hpp"
#include "cmodel/fast/frame_tables.hpp"
#include "cmodel/fast/row_kernel.hpp"
#include "cmodel/fast/sheet.hpp"
#include "cmodel/pixel_out.hpp"
#include "cmodel/record_sink.hpp"
#include "cmodel/snap.hpp"

namespace fastsplat::cmodel::fast {

/// A footprint's place in a tile: all that does not change from sheet to sheet.
struct Placed {
  std::uint64_t columns = 0;  ///< of blocks its windows touch, a bit each
  const std::uint16_t* weights = nullptr;
  std::uint32_t at = 0;               ///< first pixel, of the sheet's memory
  std::uint16_t inside = 0;           ///< pixels of its windows inside the tile
  std::uint16_t weighted = 0;         ///< of those, with a weight above 0
  std::uint16_t first = 1, last = 0;  ///< rows of blocks, both included
  std::uint16_t set = 0;
  bool counted = true;  ///< here; false in a band of a tile that the footprint only reaches down into
};

/// Takes tiles one after the other, in records that are known to obey docs/stream.md (the driver's own). T is the
/// sheet's word: 16 bits where the plan is narrow, else 32.
template <class T>
class TileUnit final : public RecordSink {
 public:
  /// Both outlive the unit.
  TileUnit(const FrameTables& tables, PixelSink& pixels);

  void begin_tile(const BeginTile& tile) override { begin_band(tile, true); }
  /// A band of a tile's rows of blocks as if it were a tile: for end_tile() as well. Counters of the bands of a tile
  /// add up to those of the tile, but for `tiles` and `sheets`. A splat goes to all bands its windows touch and is
  /// counted where they begin: `first` is the band that has those that begin above it, too.
  void begin_band(const BeginTile& band, bool first);
  void begin_sheet(const BeginSheet& sheet) override;
  void splats(std::span<const SplatRecord> records) override;
  void end_sheet(const EndSheet& sheet) override;
  void end_tile(const EndTile& tile) override;

  /// What splats() does, in two steps: the first once per splat and tile, the second once per sheet. A snapped splat,
  /// relative to the tile.
  Placed place(std::uint32_t set, const SnappedAxis& x, const SnappedAxis& y) const;
  void add(const Placed& placed, const std::array<std::uint32_t, 4>& colour) {
    if (placed.counted) {
      ++counters_.splats;
      counters_.windows += windows_[placed.set];
    }
    counters_.lanes_inside += placed.inside;
    counters_.lanes_weighted += placed.weighted;
    bool frozen = any_frozen_;
    for (std::size_t by = placed.first; by <= placed.last; ++by) {
      dirty_[by] |= placed.columns;
      frozen = frozen && (placed.columns & ~frozen_[by]) == 0;
    }
    if (placed.weighted == 0) return;
    const std::uint32_t brightest = std::max({colour[0], colour[1], colour[2]});
    if (frozen && brightest <= colour[3]) {
      // Nothing it does can be seen, and only its tau can be counted.
      hidden_splats_ += placed.counted ? 1 : 0;
      put(hidden_jobs_, placed, colour);
    } else {
      put(jobs_, placed, colour);
    }
  }

  /// False if a sum may have left the sheet's format in the last tile: it was not delivered and its counters mean
  /// nothing; only the plain unit can tell how often. Then `counters()` are those of the tiles before.
  bool sound() const { return sound_; }
  const Counters& counters() const { return counters_; }
  /// Splats all of whose blocks, in the band they begin in, were frozen: only their tau was added up, for the counters.
  std::uint64_t hidden_splats() const { return hidden_splats_; }

 private:
  static constexpr std::size_t kJobs = 256;  ///< drawn at once

  struct Jobs {
    std::array<SplatJob, kJobs> list;
    std::size_t size = 0;
    std::span<const SplatJob> all() const { return std::span(list).first(size); }
  };
  void put(Jobs& jobs, const Placed& placed, const std::array<std::uint32_t, 4>& colour) {
    SplatJob& job = jobs.list[jobs.size];
    job.weights = placed.weights;
    job.at = placed.at;
    job.set = placed.set;
    for (std::size_t c = 0; c < 4; ++c) job.colour[c] = static_cast<std::uint16_t>(colour[c] << colour_shift_);
    __builtin_prefetch(placed.weights);
    __builtin_prefetch(placed.weights + 32);
    waiting_ += largest_product_[placed.set];
    if (++jobs.size == kJobs) draw();
  }
  std::uint32_t clipped_weighted(const Shape& shape, const std::uint16_t* weights, int x, int y) const;
  void draw();
  std::uint32_t largest_word() const;
  void composite(int bx, int by);
  /// Range checks of a frozen block's sums, seen and unseen.
  void count_frozen(int x0, int y0, int x1, int y1);
  /// Above it a sum may have been cut: words of 16 bits stop at their end.
  std::uint32_t largest_whole() const {
    const std::uint32_t largest = tables_.jobs.plan.largest_sum;
    return largest - (sizeof(T) == 2 && largest == 0xFFFF ? 1 : 0);
  }

  const FrameTables& tables_;
  PixelSink& pixels_;
  Snap snap_;
  CompositeLane lane_;
  PixelOut pixel_out_;
  int lanes_, lane_bits_, colour_shift_;
  std::vector<std::uint32_t> windows_;          ///< of a splat, per set
  std::vector<std::uint32_t> largest_product_;  ///< per set
  BeginTile tile_;
  Sheet<T> sheet_;
  std::vector<PixelState> picture_;            ///< row by row
  std::vector<std::uint64_t> dirty_, frozen_;  ///< a word per row of blocks
  std::vector<T> hidden_tau_;                  ///< sums of tau of hidden splats, laid out as the sheet
  bool first_band_ = true;
  bool any_frozen_ = false, any_hidden_ = false, sound_ = true;
  std::uint64_t bound_ = 0;    ///< no word of the sheet is above
  std::uint64_t waiting_ = 0;  ///< no word grows by more when the jobs are drawn
  Jobs jobs_, hidden_jobs_;
  Counters counters_, before_;
  std::uint64_t hidden_splats_ = 0;
};

extern template class TileUnit<std::uint16_t>;
extern template class TileUnit<std::uint32_t>;

}  // namespace fastsplat::cmodel::fast
