// SPDX-License-Identifier: Apache-2.0
#include "cmodel/fast/tile_unit.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

#include "cmodel/numbers/observers.hpp"

namespace fastsplat::cmodel::fast {
namespace {

constexpr std::size_t kPictureSlack = 8;  ///< pixels that the widest vector writes
constexpr std::size_t kRoom = 16384;      ///< words: half a first-level cache

/// Bits a..b-1.
std::uint64_t bits(int a, int b) { return (~std::uint64_t{0} >> (64 - (b - a))) << a; }

}  // namespace

template <class T>
TileUnit<T>::TileUnit(const FrameTables& tables, PixelSink& pixels, Counts counts)
    : tables_(tables),
      pixels_(pixels),
      snap_(tables.config),
      lane_(tables.config),
      pixel_out_(tables.config),
      lanes_(tables.config.lanes),
      lane_bits_(Config::log2_exact(tables.config.lanes)),
      colour_shift_(tables.plan.colour_shift),
      dropped_(narrowing(tables.config, Site::Product).dropped_bits()),
      ellipse_(tables.config),
      densities_(tables.densities),
      compositor_(tables.config),
      counts_(counts == Counts::All),
      slots_(1) {
  compositor_.opacity() = tables.opacity;
  const std::uint64_t brightest = static_cast<std::uint64_t>(tables.config.colour_format().max);
  for (std::uint32_t set = 0; set < tables.memo.sets(); ++set) heaviest_.push_back(tables.memo.shape(set).heaviest);
  heaviest_.push_back(tables.ellipses ? tables.ellipses->heaviest : 0);
  // Rounding adds less than one to the bits that are kept.
  for (const std::uint32_t weight : heaviest_)
    largest_product_.push_back(static_cast<std::uint32_t>((brightest * weight) >> dropped_) + 1);
}

template <class T>
void TileUnit<T>::begin_band(const BeginTile& tile, bool first, int ahead) {
  tile_ = tile;
  first_band_ = first;
  samples_ = every_sample(tile.mode);
  halo_ = DensityStage::halo(tile.mode);
  width_ = tile.width + 2 * halo_;
  height_ = tile.height + 2 * halo_;
  if (!samples_) sheet_.resize(width_, height_, tables_.reach);
  const std::uint32_t one = std::uint32_t{1} << tables_.config.composite_frac_bits;
  picture_.assign(static_cast<std::size_t>(tile.width) * tile.height + kPictureSlack,
                  PixelState{0, 0, 0, tile.mode == Mode::Sum ? 0 : one});
  room_.resize(std::max(kRoom, std::size_t{pitch_of(static_cast<std::uint32_t>(width_))} * height_));
  const auto rows = static_cast<std::size_t>((height_ + lanes_ - 1) >> lane_bits_);
  dirty_.assign(rows, 0);
  frozen_.assign(rows, 0);
  culls_ = counts_ && tables_.config.culls() && culls_in(tile.mode);
  for (auto& map : opaque_) map.assign(rows, 0);
  sheet_parity_ = 0;
  sets_.clear();
  slots_.assign(static_cast<std::size_t>(ahead) + 1, {.dirty = std::vector<std::uint64_t>(rows)});
  hidden_sums_.assign(samples_ || !counts_ ? 0 : slots_.size() * sheet_.pixels(), 0);
  most_excess_ = 0;
  now_ = waiting_jobs_ = room_taken_ = 0;
  any_frozen_ = false;
  sound_ = (!samples_ || tables_.samples) &&
           (halo_ == 0 ? !tables_.tints() || tile.mode == Mode::Sum || samples_ : densities_.has_value());
  if (halo_ > 0 && densities_) {
    densities_->begin_tile(tile, tables_.frame);
    compositor_.begin_tile(tile.mode, tile.width, tile.height);
  }
  const int whole = tile.width >> lane_bits_;
  const bool together = halo_ == 0 && !samples_ && tile.mode != Mode::Sum && tables_.samples &&
                        tables_.terminations == nullptr && composites_sums(static_cast<std::size_t>(lanes_));
  whole_blocks_ = together && whole > 0 ? bits(0, whole) : 0;
  bound_ = waiting_ = 0;
  before_ = counters_;
}

template <class T>
std::uint16_t* TileUnit<T>::room(std::size_t words) {
  if (room_taken_ + words > room_.size()) draw();
  std::uint16_t* const out = room_.data() + room_taken_;
  room_taken_ += words;
  return out;
}

template <class T>
void TileUnit<T>::clip(PlacedFootprint& placed, int x, int y) {
  const int i0 = std::max(0, -x), i1 = std::min<int>(placed.across, width_ - x);
  const int j0 = std::max(0, -y), j1 = std::min<int>(placed.down, height_ - y);
  const std::size_t pitch = pitch_of(placed.across);
  placed.weighted = 0;
  for (int j = j0; j < j1; ++j) {
    const std::uint16_t* row = placed.weights + static_cast<std::size_t>(j) * pitch;
    for (int i = i0; i < i1; ++i) placed.weighted += row[i] != 0 ? 1 : 0;
  }
  if (!samples_ || placed.weighted == 0) return;
  const auto columns = static_cast<std::uint16_t>(i1 - i0), rows = static_cast<std::uint16_t>(j1 - j0);
  const std::size_t inner = pitch_of(columns);
  std::uint16_t* const out = room(inner * rows);
  std::fill_n(out, inner * rows, std::uint16_t{0});
  for (int j = j0; j < j1; ++j)
    std::copy_n(placed.weights + static_cast<std::size_t>(j) * pitch + i0, columns,
                out + static_cast<std::size_t>(j - j0) * inner);
  placed.weights = out;
  placed.across = columns;
  placed.down = rows;
  placed.at = memory_at(x + i0, y + j0);
}

template <class T>
PlacedFootprint TileUnit<T>::outline(int x, int y, int width, int height) const {
  PlacedFootprint out{.counted = first_band_ || y >= 0};
  const int x0 = std::max(x, 0), x1 = std::min(x + width, width_);
  const int y0 = std::max(y, 0), y1 = std::min(y + height, height_);
  out.windows = static_cast<std::uint16_t>((width >> lane_bits_) * (height >> lane_bits_));
  if (x0 >= x1 || y0 >= y1) return out;
  out.inside = static_cast<std::uint32_t>(x1 - x0) * static_cast<std::uint32_t>(y1 - y0);
  out.columns = bits(x0 >> lane_bits_, ((x1 - 1) >> lane_bits_) + 1);
  out.first = static_cast<std::uint16_t>(y0 >> lane_bits_);
  out.last = static_cast<std::uint16_t>((y1 - 1) >> lane_bits_);
  return out;
}

template <class T>
PlacedFootprint TileUnit<T>::place(std::uint32_t set, const SnappedAxis& sx, const SnappedAxis& sy) {
  const int x = sx.origin + halo_, y = sy.origin + halo_;
  const Shape& shape = tables_.memo.shape(set);
  PlacedFootprint out = outline(x, y, shape.padded, shape.padded);
  out.set = static_cast<std::uint16_t>(set);
  if (out.inside == 0) return out;
  const std::size_t number = tables_.memo.number(sx.phase, sy.phase);
  out.weights = tables_.memo.words(shape, number);
  out.across = out.down = static_cast<std::uint16_t>(shape.extent);
  if (x >= 0 && y >= 0 && x + shape.extent <= width_ && y + shape.extent <= height_) {
    out.weighted = tables_.memo.weighted(set, number);
    out.at = memory_at(x, y);
    return out;
  }
  if (!samples_) out.at = memory_at(x, y);
  clip(out, x, y);
  return out;
}

template <class T>
PlacedFootprint TileUnit<T>::place(const EllipseRecord& record, std::unique_ptr<std::uint16_t[]>* kept) {
  assert(tables_.ellipses);
  const EllipseAxis x = ellipse_axis(tables_.config, record.x, record.windows.left);
  const EllipseAxis y = ellipse_axis(tables_.config, record.y, record.windows.top);
  const int left = x.origin + halo_, top = y.origin + halo_;
  const int width = static_cast<int>(record.windows.columns) * lanes_,
            height = static_cast<int>(record.windows.rows) * lanes_;
  PlacedFootprint out = outline(left, top, width, height);
  out.set = static_cast<std::uint16_t>(heaviest_.size() - 1);
  if (out.inside == 0 || (samples_ && !counts_ && frozen(out))) return out;
  const EllipseBox box{.column = std::max(0, -left),
                       .row = std::max(0, -top),
                       .columns = std::min(left + width, width_) - std::max(left, 0),
                       .rows = std::min(top + height, height_) - std::max(top, 0)};
  const std::size_t words = std::size_t{pitch_of(static_cast<std::uint32_t>(box.columns))} * box.rows;
  std::uint16_t* weights = nullptr;
  if (kept != nullptr) {
    *kept = std::make_unique_for_overwrite<std::uint16_t[]>(words);
    weights = kept->get();
  } else {
    weights = room(words);
  }
  out.weighted = weigh(*tables_.ellipses, ellipse_.coefficients(record.shape, x.distance, y.distance), box, weights);
  out.weights = weights;
  out.across = static_cast<std::uint16_t>(box.columns);
  out.down = static_cast<std::uint16_t>(box.rows);
  out.at = memory_at(left + box.column, top + box.row);
  return out;
}

template <class T>
void TileUnit<T>::take(const PlacedFootprint& placed, const std::array<std::uint32_t, 4>& words) {
  const std::uint32_t largest = std::max({words[0], words[1], words[2], words[3]});
  if (samples_ && any_frozen_ && frozen(placed) &&
      is_small(*tables_.samples, std::uint64_t{largest} << colour_shift_)) {
    count(placed, 1);
    counters_.pixels_composited += placed.weighted;
    counters_.frozen_pixels += placed.weighted;
    hidden_splats_ += placed.counted ? 1 : 0;
    return;
  }
  const HiddenShare share{largest, largest - words[3]};
  if (largest != 0 && hidden(placed) && can_hide(placed, {&share, 1}))
    hide(placed, {&share, 1});
  else
    add(placed, words);
}

template <class T>
void TileUnit<T>::splats(std::span<const SplatRecord> records) {
  if (!sound_) return;
  Counting counting{counters_};
  for (const SplatRecord& record : records) {
    if (const bool* gone = sets_.next(record.tag); gone != nullptr && *gone) continue;
    const std::uint32_t rho = tables_.memo.shape(record.set).rho;
    if (culls_) {
      Nothing nobody;
      if (culled(place(record.set, snap_(record.x, rho, nobody), snap_(record.y, rho, nobody)))) {
        count_culled(1);
        continue;
      }
    }
    const SnappedAxis x = snap_(record.x, rho, counting), y = snap_(record.y, rho, counting);
    const PlacedFootprint placed = place(record.set, x, y);
    if (culls_)
      add(placed, record.colour);
    else
      take(placed, record.colour);
  }
}

template <class T>
void TileUnit<T>::ellipses(std::span<const EllipseRecord> records) {
  sound_ = sound_ && (records.empty() || (tables_.ellipses && !culls_));
  if (!sound_) return;
  for (const EllipseRecord& record : records) take(place(record), record.colour);
}

template <class T>
bool TileUnit<T>::covers(const std::vector<std::uint64_t>& map, const PixelBox& of) const {
  const PixelBox box = of.clipped(tile_.width, tile_.height);
  if (box.empty()) return true;
  const std::uint64_t columns =
      bits(static_cast<int>(box.x0) >> lane_bits_, ((static_cast<int>(box.x1) - 1) >> lane_bits_) + 1);
  for (int by = static_cast<int>(box.y0) >> lane_bits_; by <= (static_cast<int>(box.y1) - 1) >> lane_bits_; ++by)
    if ((columns & ~map[static_cast<std::size_t>(by)]) != 0) return false;
  return true;
}

template <class T>
bool TileUnit<T>::would_hide(const CullBlock& set) {
  return culls_ && covers(opaque_[sheet_parity_], box_of(set));
}

template <class T>
bool TileUnit<T>::terminated(const PixelBox& box) const {
  return any_frozen_ && covers(frozen_, box);
}

template <class T>
void TileUnit<T>::cull_blocks(std::span<const CullBlock> records) {
  counters_.cull_blocks += records.size();
  if (!culls_) return;
  for (const CullBlock& set : records) sets_.announce(set.tag, set.splats, would_hide(set));
}

template <class T>
bool TileUnit<T>::can_hide(const PlacedFootprint& placed, std::span<const HiddenShare> shares) const {
  std::uint32_t excess = 0;
  for (const HiddenShare& share : shares) excess = std::max(excess, share.excess);
  return excess == 0 || most_excess_ + product(placed, excess) <= tables_.opacity_excess;
}

template <class T>
std::uint64_t TileUnit<T>::hide(const PlacedFootprint& placed, std::span<const HiddenShare> shares) {
  std::uint64_t records = 0;
  std::size_t at = now_;
  for (const HiddenShare& share : shares) {
    Slot& slot = slots_[at];
    if (++at == slots_.size()) at = 0;
    if (share.word == 0) continue;
    ++records;
    touch(placed, slot.dirty);
    slot.hidden = true;
    if (share.excess == 0) continue;
    slot.excess += product(placed, share.excess);
    most_excess_ = std::max(most_excess_, slot.excess);
  }
  count(placed, records);
  if (placed.weighted == 0) return records;
  if (placed.counted) hidden_splats_ += records;
  add_hidden(tables_.plan, {placed.weights, placed.at, placed.across, placed.down}, shares,
             {hidden_sums_.data(), sheet_.pixels(), sheet_.row(), slots_.size(), now_});
  return records;
}

template <class T>
void TileUnit<T>::draw() {
  const auto jobs = std::span(jobs_).first(waiting_jobs_);
  waiting_jobs_ = room_taken_ = 0;
  if (samples_) {
    if (!sound_) return;
    SampleCounts counts;
    composite_samples(*tables_.samples, tile_.mode == Mode::SampleExponential, jobs, picture_.front().data(),
                      static_cast<std::size_t>(width_), counts);
    counters_.frozen_pixels += counts.frozen;
    counters_.opacity_saturated += counts.opacity_saturated;
    counters_.composite_saturated += counts.composite_saturated;
    find_frozen();
    return;
  }
  // Words of 16 bits saturate; those of 32 bits must not wrap.
  if (sizeof(T) == 4 && !tables_.plan.carries && bound_ + waiting_ > 0xFFFFFFFFU) {
    bound_ = largest_word();
    if (bound_ > tables_.plan.largest_sum || bound_ + waiting_ > 0xFFFFFFFFU) sound_ = false;
  }
  if (sound_) sound_ = add_splats(tables_.plan, jobs, sheet_.words(), sheet_.row());
  bound_ += waiting_;
  waiting_ = 0;
}

template <class T>
void TileUnit<T>::find_frozen() {
  const auto frozen_row = [&](int x0, int x1, int y) {
    const PixelState* const row = &picture_[static_cast<std::size_t>(y) * tile_.width];
    return std::all_of(row + x0, row + x1, [&](const PixelState& pixel) { return lane_.frozen(pixel); });
  };
  for (std::size_t by = 0; by < dirty_.size(); ++by) {
    const int y0 = static_cast<int>(by) << lane_bits_, y1 = std::min(tile_.height, y0 + lanes_);
    for (std::uint64_t left = dirty_[by] & ~frozen_[by]; left != 0; left &= left - 1) {
      const int x0 = std::countr_zero(left) << lane_bits_, x1 = std::min(tile_.width, x0 + lanes_);
      bool all = true;
      for (int y = y0; y < y1 && all; ++y) all = frozen_row(x0, x1, y);
      if (!all) continue;
      frozen_[by] |= std::uint64_t{1} << (x0 >> lane_bits_);
      any_frozen_ = true;
    }
    dirty_[by] = 0;
  }
}

template <class T>
std::uint32_t TileUnit<T>::largest_word() const {
  std::uint32_t largest = 0;
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const SheetWord sums = sheet_.sums(x, y);
      largest = std::max({largest, sums[0], sums[1], sums[2], sums[3]});
    }
  }
  return largest;
}

template <class T>
void TileUnit<T>::end_sheet(const EndSheet&) {
  ++counters_.sheets;
  draw();
  Slot& slot = slots_[now_];
  if (!sound_ || samples_) return;
  if (halo_ > 0) {
    end_densities();
    return;
  }
  for (std::size_t by = 0; by < dirty_.size(); ++by) {
    const std::uint64_t dirty = dirty_[by] | slot.dirty[by];
    const std::uint64_t together = dirty & ~frozen_[by] & whole_blocks_;
    if (together != 0) composite_together(together, static_cast<int>(by));
    for (std::uint64_t left = dirty & ~together; left != 0 && sound_; left &= left - 1)
      composite(std::countr_zero(left), static_cast<int>(by));
    dirty_[by] = slot.dirty[by] = 0;
  }
  if (tables_.plan.carries) {
    // Sums in the guard band would wrap in the end.
    sheet_.clear();
  }
  if (slot.hidden)
    std::fill_n(hidden_sums_.begin() + static_cast<std::ptrdiff_t>(now_ * sheet_.pixels()), sheet_.pixels(), 0);
  slot.hidden = false;
  if (culls_) {
    // The open sheet's map is free now and becomes that of the sheet after the next.
    opaque_[sheet_parity_] = frozen_;
    sheet_parity_ = 1 - sheet_parity_;
  }
  slot.excess = most_excess_ = 0;
  for (const Slot& other : slots_) most_excess_ = std::max(most_excess_, other.excess);
  bound_ = 0;
}

template <class T>
void TileUnit<T>::composite_together(std::uint64_t blocks, int by) {
  const int y0 = by << lane_bits_, rows = std::min(tile_.height - y0, lanes_);
  SampleCounts counts;
  const CompositedBlocks done =
      composite_sums(*tables_.samples, tile_.mode == Mode::Exponential,
                     SumBlocks<T>{.blocks = blocks,
                                  .side = static_cast<std::size_t>(lanes_),
                                  .rows = static_cast<std::size_t>(rows),
                                  .sums = sheet_.words() + sheet_.at(0, y0) * 4,
                                  .sums_row = sheet_.row(),
                                  .picture = picture_[static_cast<std::size_t>(y0) * tile_.width].data(),
                                  .picture_row = static_cast<std::size_t>(tile_.width),
                                  .largest = largest_whole()},
                     counts);
  sound_ = sound_ && done.sound;
  const auto number = static_cast<std::uint64_t>(std::popcount(blocks));
  counters_.dirty_blocks += number;
  counters_.pixels_composited += number * static_cast<std::uint64_t>(lanes_ * rows);
  counters_.frozen_pixels += counts.frozen;
  counters_.opacity_saturated += counts.opacity_saturated;
  counters_.composite_saturated += counts.composite_saturated;
  for (std::uint64_t left = blocks; left != 0; left &= left - 1) {
    const int x0 = std::countr_zero(left) << lane_bits_;
    sheet_.clear(x0, y0, x0 + lanes_, y0 + rows);
  }
  freeze(done.terminated, static_cast<std::size_t>(by));
}

template <class T>
void TileUnit<T>::freeze(std::uint64_t blocks, std::size_t by) {
  if (blocks == 0) return;
  // From here on the blocks cannot change, and colours below tau stay in range for any sums.
  frozen_[by] |= blocks;
  any_frozen_ = any_frozen_ || !counts_ || tile_.mode == Mode::Additive || tables_.opacity_holds;
}

template <class T>
void TileUnit<T>::composite(int bx, int by) {
  Counting counting{counters_};
  const int x0 = bx << lane_bits_, x1 = std::min(tile_.width, x0 + lanes_);
  const int y0 = by << lane_bits_, y1 = std::min(tile_.height, y0 + lanes_);
  ++counters_.dirty_blocks;
  counters_.pixels_composited += static_cast<std::uint64_t>(x1 - x0) * static_cast<std::uint64_t>(y1 - y0);
  const std::uint64_t bit = std::uint64_t{1} << bx;
  if ((frozen_[static_cast<std::size_t>(by)] & bit) != 0) {
    counters_.frozen_pixels += static_cast<std::uint64_t>(x1 - x0) * static_cast<std::uint64_t>(y1 - y0);
    if (counts_) count_frozen(x0, y0, x1, y1);
    sheet_.clear(x0, y0, x1, y1);
    return;
  }
  bool all_frozen = tile_.mode != Mode::Sum;
  for (int y = y0; y < y1; ++y) {
    PixelState* pixel = &picture_[static_cast<std::size_t>(y) * tile_.width + x0];
    for (int x = x0; x < x1; ++x, ++pixel) {
      const SheetWord sums = sheet_.sums(x, y);
      const bool frozen = tile_.mode != Mode::Sum && lane_.frozen(*pixel);
      counters_.frozen_pixels += frozen ? 1 : 0;
      if ((sums[0] | sums[1] | sums[2] | sums[3]) == 0) {
        all_frozen = all_frozen && frozen;
        continue;
      }
      if (std::max({sums[0], sums[1], sums[2], sums[3]}) > largest_whole()) {
        // Outside the sheet's format: the slab factor table has no entry for it.
        sound_ = false;
        return;
      }
      if (tile_.mode == Mode::Sum) {
        for (std::size_t c = 0; c < 4; ++c) (*pixel)[c] = lane_.add((*pixel)[c], sums[c], counting);
        continue;
      }
      const Slab slab = tile_.mode == Mode::Exponential ? tables_.opacity.exponential(sums, counting)
                                                        : tables_.opacity.additive(sums, counting);
      lane_.composite(slab, *pixel, counting);
      const bool ends = lane_.frozen(*pixel);
      all_frozen = all_frozen && ends;
      if (ends && !frozen && tables_.terminations != nullptr)
        tables_.terminations->note(tile_.x + x, tile_.y + y, sheet_number_);
    }
  }
  sheet_.clear(x0, y0, x1, y1);
  if (all_frozen) freeze(bit, static_cast<std::size_t>(by));
}

/// The sheet, as DensityStage reads it.
template <class T>
struct TileUnit<T>::Splatted {
  TileUnit& unit;
  SheetWord at(int x, int y) const {
    const SheetWord sums = unit.sheet_.sums(x, y);
    if (std::max({sums[0], sums[1], sums[2], sums[3]}) > unit.largest_whole()) unit.sound_ = false;
    return sums;
  }
  template <class Visit>
  void drain(Visit visit) const {
    for (std::size_t by = 0; by < unit.dirty_.size(); ++by) {
      const int y0 = static_cast<int>(by) << unit.lane_bits_;
      for (std::uint64_t left = unit.dirty_[by]; left != 0; left &= left - 1) {
        const int x0 = std::countr_zero(left) << unit.lane_bits_;
        visit(x0 >> unit.lane_bits_, static_cast<int>(by));
        unit.sheet_.clear(x0, y0, std::min(unit.width_, x0 + unit.lanes_), std::min(unit.height_, y0 + unit.lanes_));
      }
      unit.dirty_[by] = 0;
    }
  }
};

template <class T>
void TileUnit<T>::end_densities() {
  Splatted splatted{*this};
  Counting counting{counters_};
  densities_->end_sheet(
      splatted, sheet_number_,
      [&](const SheetWord& sums, int x, int y) { compositor_.step(sums, x, y, counters_, counting); },
      [&](int, int, std::uint32_t) { ++counters_.dirty_blocks; });
  if (tables_.plan.carries) sheet_.clear();
  bound_ = 0;
}

template <class T>
void TileUnit<T>::count_frozen(int x0, int y0, int x1, int y1) {
  Counting counting{counters_};
  for (int y = y0; y < y1; ++y) {
    const std::uint16_t* bound = &hidden_sums_[now_ * sheet_.pixels() + sheet_.at(x0, y)];
    for (int x = x0; x < x1; ++x, ++bound) {
      const SheetWord sums = sheet_.sums(x, y);
      const std::uint32_t colour = std::max({sums[0], sums[1], sums[2]});
      const std::uint64_t hidden = std::uint64_t{*bound} << tables_.plan.hidden_unit;
      if (std::max(colour, sums[3]) + hidden > largest_whole()) {
        sound_ = false;
        return;
      }
      if (hidden != 0) {
        sound_ = sound_ && hidden_slab_fits(sums, hidden);
      } else if (tile_.mode == Mode::Additive) {
        (void)tables_.opacity.additive(sums, counting);
      } else if (colour > sums[3] || !tables_.opacity_holds) {
        (void)tables_.opacity.exponential(sums, counting);
      }
    }
  }
}

template <class T>
bool TileUnit<T>::hidden_slab_fits(const SheetWord& seen, std::uint64_t hidden) const {
  // The slab factor is at most 1.0: values of at most 1.0 stay so.
  const std::uint32_t colour = std::max({seen[0], seen[1], seen[2]});
  const std::uint64_t one = std::uint64_t{1} << tables_.config.sheet_frac_bits;
  if (std::max(colour, seen[3]) + hidden <= one) return true;
  if (tile_.mode == Mode::Additive) return false;
  // Colours exceed tau by at most this.
  const std::uint64_t above = slots_[now_].excess + (colour > seen[3] ? colour - seen[3] : 0);
  return above <= tables_.opacity_excess;
}

template <class T>
void TileUnit<T>::end_tile(const EndTile&) {
  ++counters_.tiles;
  if (!sound_) {
    counters_ = before_;
    return;
  }
  Counting counting{counters_};
  if (halo_ > 0) {
    densities_->end_tile(
        [&](const SheetWord& sums, int x, int y) { compositor_.step(sums, x, y, counters_, counting); },
        [&](int, int, std::uint32_t) { ++counters_.dirty_blocks; });
  }
  out_.tile = tile_.tile;
  out_.x = tile_.x;
  out_.y = tile_.y;
  out_.width = tile_.width;
  out_.height = tile_.height;
  out_.words.resize(static_cast<std::size_t>(tile_.width) * tile_.height * 4);
  std::uint32_t* to = out_.words.data();
  for (int y = 0; y < tile_.height; ++y) {
    for (int x = 0; x < tile_.width; ++x) {
      const PixelState& pixel =
          halo_ > 0 ? compositor_.at(x, y) : picture_[static_cast<std::size_t>(y) * tile_.width + x];
      for (const std::uint32_t word : pixel_out_(tile_.mode, pixel, counting)) *to++ = word;
    }
  }
  pixels_.on_tile(std::move(out_));
}

template class TileUnit<std::uint16_t>;
template class TileUnit<std::uint32_t>;

}  // namespace fastsplat::cmodel::fast
