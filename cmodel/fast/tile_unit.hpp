// SPDX-License-Identifier: Apache-2.0
// The fast unit: draws a tile's records without taps. Words and counters equal the plain unit's bit for bit.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cmodel/composite/compositor.hpp"
#include "cmodel/composite/pixel_out.hpp"
#include "cmodel/cull/cull_sets.hpp"
#include "cmodel/cull/cull_unit.hpp"
#include "cmodel/fast/frame_tables.hpp"
#include "cmodel/fast/row_kernel.hpp"
#include "cmodel/fast/sheet.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/splat/ellipse_unit.hpp"
#include "cmodel/splat/snap.hpp"
#include "cmodel/stream/device.hpp"
#include "cmodel/stream/record_sink.hpp"

namespace fastsplat::cmodel::fast {

/// A placed footprint: all that does not change from sheet to sheet of a tile.
struct PlacedFootprint {
  std::uint64_t columns = 0;  ///< columns of blocks its windows touch, a bit each
  const std::uint16_t* weights = nullptr;
  std::uint32_t at = 0;                ///< index of its first pixel in the sheet or picture
  std::uint32_t inside = 0;            ///< pixels of its windows inside the tile
  std::uint32_t weighted = 0;          ///< of those, with a weight above 0
  std::uint16_t across = 0, down = 0;  ///< size of `weights`, pixels
  std::uint16_t first = 1, last = 0;   ///< rows of blocks, both included
  std::uint16_t windows = 0;
  std::uint16_t set = 0;  ///< radius set; for an ellipse the number of sets
  bool counted = true;    ///< in this band; false if the footprint begins in a band above it
};

/// A placed footprint for a unit that does not count.
struct WaitingRecord {
  const std::uint16_t* weights;
  std::uint32_t at;                       ///< as in PlacedFootprint
  std::uint16_t columns, rows;            ///< SplatJob
  std::uint8_t left, right, top, bottom;  ///< the blocks its windows touch, all included
  std::uint16_t set;
  bool counted;  ///< PlacedFootprint::counted
};
static_assert(sizeof(WaitingRecord) <= 24);

/// Whether a unit counts as the device does, or draws the same words without counters: hidden splats may then be left
/// out.
enum class Counts { All, None };

/// Draws tiles one after the other, from records known to obey docs/stream.md (the driver's). T is the sheet's word: 16
/// bits if the plan is narrow, else 32.
template <class T>
class TileUnit final : public RecordSink {
 public:
  /// Both must outlive the unit.
  TileUnit(const FrameTables& tables, PixelSink& pixels, Counts counts = Counts::All);

  void begin_tile(const BeginTile& tile) override { begin_band(tile, true, 0); }
  /// Treats a band of a tile's rows of blocks as a tile, in end_tile() as well. Counters of a tile's bands add up to
  /// the tile's, except `tiles` and `sheets`. A splat goes to all bands that its windows touch and is counted where
  /// they begin. The band with `first` also counts splats that begin above it. hide() accepts up to `ahead` sheets
  /// beyond the open one. Densities come in whole tiles.
  void begin_band(const BeginTile& band, bool first, int ahead);
  void begin_sheet(const BeginSheet& sheet) override {
    sheet_number_ = sheet.sheet;
    now_ = sheet.sheet % slots_.size();
  }
  void splats(std::span<const SplatRecord> records) override;
  void ellipses(std::span<const EllipseRecord> records) override;
  void cull_blocks(std::span<const CullBlock> records) override;
  void end_sheet(const EndSheet& sheet) override;
  void end_tile(const EndTile& tile) override;

  /// splats() in two steps: place() once per splat and tile, add() once per sheet. In modes 4 and 5 add() must precede
  /// the next place(). `x` and `y` are snapped, relative to the tile.
  PlacedFootprint place(std::uint32_t set, const SnappedAxis& x, const SnappedAxis& y);
  /// The same for ellipses(). The weights are in `kept`; if that is null, they are valid until the next place().
  PlacedFootprint place(const EllipseRecord& record, std::unique_ptr<std::uint16_t[]>* kept = nullptr);
  void add(const PlacedFootprint& placed, const std::array<std::uint32_t, 4>& colour) {
    count(placed, 1);
    if (samples_) counters_.pixels_composited += placed.weighted;
    touch(placed, dirty_);
    if (placed.weighted != 0) put(job_of(placed, colour), placed.set);
  }
  /// Whether no picture depends on the splat in this sheet or a later one: hide() may then replace add().
  bool hidden(const PlacedFootprint& placed) const {
    if (samples_ || halo_ > 0) return false;
    if (placed.weighted == 0) return true;
    return any_frozen_ && (tables_.plan.hides || !counts_) && frozen(placed);
  }
  // With Counts::None, records wait for their sheets and are left out once they are hidden.
  WaitingRecord record(const PlacedFootprint& placed) const {
    return {.weights = placed.weights,
            .at = placed.at,
            .columns = placed.across,
            .rows = placed.down,
            .left = static_cast<std::uint8_t>(std::countr_zero(placed.columns)),
            .right = static_cast<std::uint8_t>(63 - std::countl_zero(placed.columns)),
            .top = static_cast<std::uint8_t>(placed.first),
            .bottom = static_cast<std::uint8_t>(placed.last),
            .set = placed.set,
            .counted = placed.counted};
  }
  bool hidden(const WaitingRecord& record) const {
    std::uint64_t open = 0;
    for (std::size_t by = record.top; by <= record.bottom; ++by) open |= ~frozen_[by];
    return (open & columns(record)) == 0;
  }
  /// Draws it in the open sheet. `colour` is shifted left by FastPlan::colour_shift.
  void add(const WaitingRecord& record, const std::array<std::uint16_t, 4>& colour) {
    for (std::size_t by = record.top; by <= record.bottom; ++by) dirty_[by] |= columns(record);
    put({.weights = record.weights, .at = record.at, .columns = record.columns, .rows = record.rows, .colour = colour},
        record.set);
  }
  /// Whether no later sheet changes a pixel of the box, in the tile's pixels.
  bool terminated(const PixelBox& box) const;
  /// Counts a hidden splat's shares of this sheet and the following ones without drawing them. Returns their number.
  std::uint64_t hide(const PlacedFootprint& placed, std::span<const HiddenShare> shares);
  /// Whether hide() would be exact; if not, add() each share in its turn. True if no share has an excess.
  bool can_hide(const PlacedFootprint& placed, std::span<const HiddenShare> shares) const;

  // For a device that culls (docs/numerics.md, section 6.1), in modes 0 and 1 and in bands that are whole tiles: these
  // replace hidden() and hide(). Footprints are single windows, and the map's cells are blocks.
  bool culls() const { return culls_; }
  /// Whether the sheets up to the last but one hide all of the splat.
  bool culled(const PlacedFootprint& placed) const {
    for (std::size_t by = placed.first; by <= placed.last; ++by)
      if ((placed.columns & ~opaque_[sheet_parity_][by]) != 0) return false;
    return true;
  }
  bool would_hide(const CullBlock& set) override;
  /// Counts hidden splats that belong to no hidden cull group.
  void count_culled(std::uint64_t splats) {
    counters_.splats += splats;
    hidden_splats_ += splats;
  }

  /// False if the last tile could not be drawn exactly: a sum may have left the sheet's format, for instance. It was
  /// neither delivered nor counted; the plain unit has to draw it.
  bool sound() const { return sound_; }
  const Counters& counters() const { return counters_; }
  /// Records of splats whose blocks, in the band where they begin, were all terminated.
  std::uint64_t hidden_splats() const { return hidden_splats_; }

 private:
  static constexpr std::size_t kJobs = 256;  ///< drawn at once

  /// State of the open sheet or of one to come.
  struct Slot {
    std::vector<std::uint64_t> dirty;  ///< blocks of hidden splats, a word per row of blocks
    std::uint64_t excess = 0;          ///< their colours exceed their tau by at most this
    bool hidden = false;               ///< it has hidden splats
  };

  static std::uint64_t columns(const WaitingRecord& record) {
    return ((std::uint64_t{2} << record.right) - 1) & (~std::uint64_t{0} << record.left);
  }
  /// Upper bound of what `word` adds to a pixel.
  std::uint64_t product(const PlacedFootprint& placed, std::uint32_t word) const {
    return placed.weighted == 0 ? 0 : ((std::uint64_t{word} * heaviest_[placed.set]) >> dropped_) + 1;
  }
  void count(const PlacedFootprint& placed, std::uint64_t records) {
    if (placed.counted) {
      counters_.splats += records;
      counters_.windows += records * placed.windows;
    }
    counters_.lanes_inside += records * placed.inside;
    counters_.lanes_weighted += records * placed.weighted;
  }
  /// Whether all blocks that its windows touch are terminated.
  bool frozen(const PlacedFootprint& placed) const {
    for (std::size_t by = placed.first; by <= placed.last; ++by)
      if ((placed.columns & ~frozen_[by]) != 0) return false;
    return true;
  }
  static void touch(const PlacedFootprint& placed, std::vector<std::uint64_t>& dirty) {
    for (std::size_t by = placed.first; by <= placed.last; ++by) dirty[by] |= placed.columns;
  }
  SplatJob job_of(const PlacedFootprint& placed, const std::array<std::uint32_t, 4>& colour) const {
    SplatJob job{.weights = placed.weights, .at = placed.at, .columns = placed.across, .rows = placed.down, .colour = {}};
    for (std::size_t c = 0; c < 4; ++c) job.colour[c] = static_cast<std::uint16_t>(colour[c] << colour_shift_);
    return job;
  }
  void put(const SplatJob& job, std::size_t set) {
    jobs_[waiting_jobs_] = job;
    __builtin_prefetch(job.weights);
    __builtin_prefetch(job.weights + 32);
    waiting_ += largest_product_[set];
    if (++waiting_jobs_ == kJobs) draw();
  }
  /// Modes 4 and 5: marks blocks whose pixels are all terminated.
  void find_frozen();
  /// Whether all blocks that the box touches are in the map; true if it touches none.
  bool covers(const std::vector<std::uint64_t>& map, const PixelBox& box) const;
  /// A footprint of windows that cover these pixels, without weights.
  PlacedFootprint outline(int x, int y, int width, int height) const;
  /// Index of a pixel in the picture (modes 4 and 5) or in the sheet.
  std::uint32_t memory_at(int x, int y) const {
    return static_cast<std::uint32_t>(samples_ ? static_cast<std::size_t>(y) * width_ + x : sheet_.at(x, y));
  }
  /// Counts the weights inside the tile; in modes 4 and 5 keeps only these.
  void clip(PlacedFootprint& placed, int x, int y);
  /// Memory for weights, valid until the next call.
  std::uint16_t* room(std::size_t words);
  void take(const PlacedFootprint& placed, const std::array<std::uint32_t, 4>& words);
  void draw();
  std::uint32_t largest_word() const;
  void composite(int bx, int by);
  /// Several blocks of a row, none of them terminated, all of them whole.
  void composite_together(std::uint64_t blocks, int by);
  /// These blocks of a row are terminated.
  void freeze(std::uint64_t blocks, std::size_t by);
  struct Splatted;  ///< the sheet as DensityStage reads it
  /// Densities: composites the sheet that waited for this one.
  void end_densities();
  /// Checks the ranges of a terminated block's sums, drawn and hidden.
  void count_frozen(int x0, int y0, int x1, int y1);
  /// Whether opacity and colours of a slab with hidden sums are certain to stay within 1.0.
  bool hidden_slab_fits(const SheetWord& seen, std::uint64_t hidden) const;
  /// A larger sum may have been cut: words of 16 bits saturate.
  std::uint32_t largest_whole() const {
    const std::uint32_t largest = tables_.plan.largest_sum;
    return largest - (sizeof(T) == 2 && largest == 0xFFFF ? 1 : 0);
  }

  const FrameTables& tables_;
  PixelSink& pixels_;
  Snap snap_;
  CompositeLane lane_;
  PixelOut pixel_out_;
  int lanes_, lane_bits_, colour_shift_, dropped_;
  EllipseUnit ellipse_;
  std::vector<std::uint32_t> heaviest_;         ///< largest weight, per set, and of ellipses
  std::vector<std::uint32_t> largest_product_;  ///< likewise
  BeginTile tile_;
  int halo_ = 0, width_ = 0, height_ = 0;  ///< halo; size of the sheet with its halo
  std::uint32_t sheet_number_ = 0;
  std::optional<DensityStage> densities_;
  Compositor compositor_;  ///< of classified densities
  bool counts_;            ///< Counts::All
  bool samples_ = false;   ///< modes 4 and 5
  Sheet<T> sheet_;
  std::vector<PixelState> picture_;            ///< row by row, plus room for what vectors write after it
  std::vector<std::uint64_t> dirty_, frozen_;  ///< a word per row of blocks
  std::uint64_t whole_blocks_ = 0;             ///< columns of blocks that composite_together() takes
  std::vector<std::uint16_t> hidden_sums_;     ///< bounds of hidden splats' largest words, a plane per slot
  std::vector<Slot> slots_;                    ///< that of sheet s: s modulo their number
  std::size_t now_ = 0;                        ///< the slot of the sheet begun
  std::uint64_t most_excess_ = 0;              ///< largest excess of all slots
  bool culls_ = false;
  std::array<std::vector<std::uint64_t>, 2> opaque_;  ///< frozen_ after the last sheet but one and after the last
  std::size_t sheet_parity_ = 0;                      ///< of the open sheet
  CullSets<bool> sets_;                               ///< cull groups, each with whether it is hidden
  bool first_band_ = true;
  bool any_frozen_ = false, sound_ = true;
  std::uint64_t bound_ = 0;    ///< upper bound of the sheet's words
  std::uint64_t waiting_ = 0;  ///< upper bound of what waiting jobs add to a word
  std::array<SplatJob, kJobs> jobs_;
  std::size_t waiting_jobs_ = 0;
  std::vector<std::uint16_t> room_;  ///< weights of waiting jobs
  std::size_t room_taken_ = 0;
  TilePixels out_;  ///< keeps its memory if the sink leaves it
  Counters counters_, before_;
  std::uint64_t hidden_splats_ = 0;
};

extern template class TileUnit<std::uint16_t>;
extern template class TileUnit<std::uint32_t>;

}  // namespace fastsplat::cmodel::fast
