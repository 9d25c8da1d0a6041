// The fast unit: one tile's records to words and counters, the same as the plain unit's bit for bit, without taps.
#pragma once

#include <algorithm>
#include <array>
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

/// A footprint's place in a tile: all that does not change from sheet to sheet.
struct Placed {
  std::uint64_t columns = 0;  ///< of blocks its windows touch, a bit each
  const std::uint16_t* weights = nullptr;
  std::uint32_t at = 0;                ///< first pixel, of the memory of sheet or picture
  std::uint32_t inside = 0;            ///< pixels of its windows inside the tile
  std::uint32_t weighted = 0;          ///< of those, with a weight above 0
  std::uint16_t across = 0, down = 0;  ///< pixels that `weights` are of
  std::uint16_t first = 1, last = 0;   ///< rows of blocks, both included
  std::uint16_t windows = 0;
  std::uint16_t set = 0;  ///< behind the last one: an ellipse
  bool counted = true;    ///< here; false in a band of a tile that the footprint only reaches down into
};

/// Takes tiles one after the other, in records that are known to obey docs/stream.md (the driver's own). T is the
/// sheet's word: 16 bits where the plan is narrow, else 32.
template <class T>
class TileUnit final : public RecordSink {
 public:
  /// Both outlive the unit.
  TileUnit(const FrameTables& tables, PixelSink& pixels);

  void begin_tile(const BeginTile& tile) override { begin_band(tile, true, 0); }
  /// Treats a band of a tile's rows of blocks as a tile, in end_tile() as well. Counters of the bands of a tile add up
  /// to the tile's, except `tiles` and `sheets`. A splat goes to all bands its windows touch and is counted where they
  /// begin. The band with `first` also counts splats that begin above it. hide() accepts up to `ahead` sheets beyond
  /// the one begun. Densities come in whole tiles.
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

  /// What splats() does, in two steps: the first once per splat and tile, the second once per sheet; where every sample
  /// is composited the second before the next place(). A snapped splat, relative to the tile.
  Placed place(std::uint32_t set, const SnappedAxis& x, const SnappedAxis& y);
  /// What ellipses() does, likewise. The weights are in `kept`, or if none is given good until the next place().
  Placed place(const EllipseRecord& record, std::unique_ptr<std::uint16_t[]>* kept = nullptr);
  void add(const Placed& placed, const std::array<std::uint32_t, 4>& colour) {
    count(placed, 1);
    if (samples_)
      counters_.pixels_composited += placed.weighted;
    else
      touch(placed, dirty_);
    if (placed.weighted != 0) put(placed, colour);
  }
  /// No picture depends on what the splat adds to this sheet or to any later one: hide() will do instead of add().
  bool hidden(const Placed& placed) const {
    if (samples_ || rim_ > 0) return false;
    if (placed.weighted == 0) return true;
    bool frozen = any_frozen_ && tables_.plan.hides;
    for (std::size_t by = placed.first; by <= placed.last; ++by)
      frozen = frozen && (placed.columns & ~frozen_[by]) == 0;
    return frozen;
  }
  /// Counts a hidden splat's shares of this sheet and the following ones without drawing them. Returns their number.
  std::uint64_t hide(const Placed& placed, std::span<const HiddenShare> shares);
  /// False if that could not be exact: then add() them, each in its turn. True where no share has an excess.
  bool can_hide(const Placed& placed, std::span<const HiddenShare> shares) const;

  // Of a device that culls (docs/numerics.md, section 6.1), in modes 0 and 1 and in bands that are whole tiles: neither
  // hidden() nor hide(), but these. Footprints are single windows, cells of the map blocks.
  bool culls() const { return culls_; }
  /// All of the splat is hidden by the sheets up to the last but one.
  bool culled(const Placed& placed) const {
    for (std::size_t by = placed.first; by <= placed.last; ++by)
      if ((placed.columns & ~opaque_[sheet_parity_][by]) != 0) return false;
    return true;
  }
  bool would_hide(const CullBlock& set) override;
  /// Hidden splats that are no hidden set's.
  void count_culled(std::uint64_t splats) {
    counters_.splats += splats;
    hidden_splats_ += splats;
  }

  /// False if a sum may have left the sheet's format in the last tile: it was not delivered and its counters mean
  /// nothing; only the plain unit can tell how often. Then `counters()` are those of the tiles before.
  bool sound() const { return sound_; }
  const Counters& counters() const { return counters_; }
  /// Records of splats all of whose blocks, in the band they begin in, were frozen.
  std::uint64_t hidden_splats() const { return hidden_splats_; }

 private:
  static constexpr std::size_t kJobs = 256;  ///< drawn at once

  /// What is known of a sheet that may be still to come.
  struct Slot {
    std::vector<std::uint64_t> dirty;  ///< a word per row of blocks, of hidden splats
    std::uint64_t excess = 0;          ///< none of their colours is above their tau by more
    bool hidden = false;               ///< some there are
  };

  /// No word adds more to a pixel.
  std::uint64_t product(const Placed& placed, std::uint32_t word) const {
    return placed.weighted == 0 ? 0 : ((std::uint64_t{word} * heaviest_[placed.set]) >> dropped_) + 1;
  }
  void count(const Placed& placed, std::uint64_t records) {
    if (placed.counted) {
      counters_.splats += records;
      counters_.windows += records * placed.windows;
    }
    counters_.lanes_inside += records * placed.inside;
    counters_.lanes_weighted += records * placed.weighted;
  }
  static void touch(const Placed& placed, std::vector<std::uint64_t>& dirty) {
    for (std::size_t by = placed.first; by <= placed.last; ++by) dirty[by] |= placed.columns;
  }
  void put(const Placed& placed, const std::array<std::uint32_t, 4>& colour) {
    SplatJob& job = jobs_[waiting_jobs_];
    job.weights = placed.weights;
    job.at = placed.at;
    job.columns = placed.across;
    job.rows = placed.down;
    for (std::size_t c = 0; c < 4; ++c) job.colour[c] = static_cast<std::uint16_t>(colour[c] << colour_shift_);
    __builtin_prefetch(placed.weights);
    __builtin_prefetch(placed.weights + 32);
    waiting_ += largest_product_[placed.set];
    if (++waiting_jobs_ == kJobs) draw();
  }
  /// Of windows of these pixels: all but the weights.
  Placed outline(int x, int y, int width, int height) const;
  /// Of the picture or of the sheet.
  std::uint32_t memory_at(int x, int y) const {
    return static_cast<std::uint32_t>(samples_ ? static_cast<std::size_t>(y) * width_ + x : sheet_.at(x, y));
  }
  /// Counts the weights inside the tile; where every sample is composited only these are kept.
  void clip(Placed& placed, int x, int y);
  /// Room for weights until the next one's.
  std::uint16_t* room(std::size_t words);
  void take(const Placed& placed, const std::array<std::uint32_t, 4>& words);
  void draw();
  std::uint32_t largest_word() const;
  void composite(int bx, int by);
  struct Splatted;  ///< the sheet, to be taken
  /// Of densities: the sheet that waited for this one goes into the picture.
  void end_densities();
  /// Range checks of a frozen block's sums, seen and unseen.
  void count_frozen(int x0, int y0, int x1, int y1);
  /// No sum of a slab's tau and no colour beside it is cut to 1.0, if some of it is hidden.
  bool hidden_slab_fits(const SheetWord& seen, std::uint64_t hidden) const;
  /// Above it a sum may have been cut: words of 16 bits stop at their end.
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
  std::vector<std::uint32_t> heaviest_;         ///< weight, per set, and of ellipses
  std::vector<std::uint32_t> largest_product_;  ///< likewise
  BeginTile tile_;
  int rim_ = 0, width_ = 0, height_ = 0;  ///< of the sheet: the tile's and the rim's pixels
  std::uint32_t sheet_number_ = 0;
  std::optional<DensityStage> densities_;
  Compositor compositor_;  ///< of what they become
  bool samples_ = false;   ///< every one is composited
  Sheet<T> sheet_;
  std::vector<PixelState> picture_;            ///< row by row, and some more for what vectors write behind
  std::vector<std::uint64_t> dirty_, frozen_;  ///< a word per row of blocks
  std::vector<std::uint16_t> hidden_sums_;     ///< bounds of hidden splats' largest words, a plane per slot
  std::vector<Slot> slots_;                    ///< of sheet s: s modulo their number
  std::size_t now_ = 0;                        ///< the slot of the sheet begun
  std::uint64_t most_excess_ = 0;              ///< of the slots
  bool culls_ = false;
  std::array<std::vector<std::uint64_t>, 2> opaque_;  ///< frozen_ after the last sheet but one, and after the last
  std::size_t sheet_parity_ = 0;                      ///< of the open sheet
  CullSets<bool> sets_;                               ///< and whether each is hidden
  bool first_band_ = true;
  bool any_frozen_ = false, sound_ = true;
  std::uint64_t bound_ = 0;    ///< no word of the sheet is above
  std::uint64_t waiting_ = 0;  ///< no word grows by more when the jobs are drawn
  std::array<SplatJob, kJobs> jobs_;
  std::size_t waiting_jobs_ = 0;
  std::vector<std::uint16_t> room_;  ///< weights of waiting jobs
  std::size_t room_taken_ = 0;
  Counters counters_, before_;
  std::uint64_t hidden_splats_ = 0;
};

extern template class TileUnit<std::uint16_t>;
extern template class TileUnit<std::uint32_t>;

}  // namespace fastsplat::cmodel::fast
