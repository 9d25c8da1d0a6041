#include "cmodel/fast/tile_unit.hpp"

#include <algorithm>
#include <bit>

#include "cmodel/observers.hpp"

namespace fastsplat::cmodel::fast {
namespace {

/// Bits a..b-1.
std::uint64_t bits(int a, int b) { return (~std::uint64_t{0} >> (64 - (b - a))) << a; }

}  // namespace

template <class T>
TileUnit<T>::TileUnit(const FrameTables& tables, PixelSink& pixels)
    : tables_(tables),
      pixels_(pixels),
      snap_(tables.config),
      lane_(tables.config),
      pixel_out_(tables.config),
      lanes_(tables.config.lanes),
      lane_bits_(Config::log2_exact(tables.config.lanes)),
      colour_shift_(tables.jobs.plan.colour_shift) {
  const std::uint64_t brightest = (std::uint64_t{1} << tables.config.colour_frac_bits) - 1;
  const int dropped = narrowing(tables.config, Site::Product).dropped_bits();
  for (std::uint32_t set = 0; set < tables.jobs.shapes.size(); ++set) {
    const Shape& shape = tables.memo.shape(set);
    windows_.push_back(shape.windows);
    // Rounding adds less than one to what the bits kept say.
    largest_product_.push_back(static_cast<std::uint32_t>((brightest * shape.heaviest) >> dropped) + 1);
  }
}

template <class T>
void TileUnit<T>::begin_band(const BeginTile& tile, bool first) {
  tile_ = tile;
  first_band_ = first;
  sheet_.resize(tile.width, tile.height, tables_.reach);
  const std::uint32_t one = std::uint32_t{1} << tables_.config.composite_frac_bits;
  picture_.assign(static_cast<std::size_t>(tile.width) * tile.height,
                  PixelState{0, 0, 0, tile.mode == Mode::Sum ? 0 : one});
  const auto rows = static_cast<std::size_t>((tile.height + lanes_ - 1) >> lane_bits_);
  dirty_.assign(rows, 0);
  frozen_.assign(rows, 0);
  hidden_tau_.assign(sheet_.pixels(), 0);
  any_frozen_ = any_hidden_ = false;
  sound_ = true;
  bound_ = waiting_ = 0;
  before_ = counters_;
}

template <class T>
void TileUnit<T>::begin_sheet(const BeginSheet&) {}

template <class T>
std::uint32_t TileUnit<T>::clipped_weighted(const Shape& shape, const std::uint16_t* weights, int x, int y) const {
  const int i0 = std::max(0, -x), i1 = std::min(shape.extent, tile_.width - x);
  const int j0 = std::max(0, -y), j1 = std::min(shape.extent, tile_.height - y);
  std::uint32_t weighted = 0;
  for (int j = j0; j < j1; ++j) {
    const std::uint16_t* row = weights + static_cast<std::size_t>(j) * shape.pitch;
    for (int i = i0; i < i1; ++i) weighted += row[i] != 0 ? 1 : 0;
  }
  return weighted;
}

template <class T>
Placed TileUnit<T>::place(std::uint32_t set, const SnappedAxis& sx, const SnappedAxis& sy) const {
  const int x = sx.origin, y = sy.origin;
  Placed out{.set = static_cast<std::uint16_t>(set), .counted = first_band_ || y >= 0};
  const Shape& shape = tables_.memo.shape(set);
  const int x0 = std::max(x, 0), x1 = std::min(x + shape.padded, tile_.width);
  const int y0 = std::max(y, 0), y1 = std::min(y + shape.padded, tile_.height);
  if (x0 >= x1 || y0 >= y1) return out;
  const std::size_t number = tables_.memo.number(sx.phase, sy.phase);
  out.weights = tables_.memo.words(shape, number);
  const bool whole = x >= 0 && y >= 0 && x + shape.extent <= tile_.width && y + shape.extent <= tile_.height;
  out.weighted = static_cast<std::uint16_t>(whole ? tables_.memo.weighted(set, number)
                                                  : clipped_weighted(shape, out.weights, x, y));
  out.inside = static_cast<std::uint16_t>((x1 - x0) * (y1 - y0));
  out.columns = bits(x0 >> lane_bits_, ((x1 - 1) >> lane_bits_) + 1);
  out.first = static_cast<std::uint16_t>(y0 >> lane_bits_);
  out.last = static_cast<std::uint16_t>((y1 - 1) >> lane_bits_);
  if (out.weighted != 0) out.at = static_cast<std::uint32_t>(sheet_.at(x, y));
  return out;
}

template <class T>
void TileUnit<T>::splats(std::span<const SplatRecord> records) {
  if (!sound_) return;
  Counting counting{counters_};
  for (const SplatRecord& record : records) {
    const std::uint32_t rho = tables_.memo.shape(record.set).rho;
    const SnappedAxis x = snap_(record.x, rho, counting), y = snap_(record.y, rho, counting);
    add(place(record.set, x, y), record.colour);
  }
}

template <class T>
void TileUnit<T>::draw() {
  // Words of 16 bits stay at their end when they reach it; those of 32 bits must not come round.
  if (sizeof(T) == 4 && !tables_.jobs.plan.carries && bound_ + waiting_ > 0xFFFFFFFFU) {
    bound_ = largest_word();
    if (bound_ > tables_.jobs.plan.largest_sum || bound_ + waiting_ > 0xFFFFFFFFU) sound_ = false;
  }
  if (sound_) {
    const bool seen = add_splats(tables_.jobs, jobs_.all(), sheet_.words(), sheet_.row());
    const bool unseen = add_tau(tables_.jobs, hidden_jobs_.all(), hidden_tau_.data(), sheet_.row());
    sound_ = seen && unseen;
  }
  any_hidden_ = any_hidden_ || hidden_jobs_.size > 0;
  bound_ += waiting_;
  waiting_ = 0;
  jobs_.size = hidden_jobs_.size = 0;
}

template <class T>
std::uint32_t TileUnit<T>::largest_word() const {
  std::uint32_t largest = 0;
  for (int y = 0; y < tile_.height; ++y) {
    for (int x = 0; x < tile_.width; ++x) {
      const SheetWord sums = sheet_.sums(x, y);
      largest = std::max({largest, sums[0], sums[1], sums[2], sums[3], std::uint32_t{hidden_tau_[sheet_.at(x, y)]}});
    }
  }
  return largest;
}

template <class T>
void TileUnit<T>::end_sheet(const EndSheet&) {
  ++counters_.sheets;
  draw();
  if (!sound_) return;
  for (std::size_t by = 0; by < dirty_.size(); ++by) {
    for (std::uint64_t left = dirty_[by]; left != 0 && sound_; left &= left - 1)
      composite(std::countr_zero(left), static_cast<int>(by));
    dirty_[by] = 0;
  }
  if (tables_.jobs.plan.carries) {
    // What lies in the guard band would come round in the end.
    sheet_.clear();
    std::ranges::fill(hidden_tau_, T{0});
  }
  any_hidden_ = false;
  bound_ = 0;
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
    count_frozen(x0, y0, x1, y1);
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
        // No word of the sheet's format: the opacity's table has nothing for it.
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
      all_frozen = all_frozen && lane_.frozen(*pixel);
    }
  }
  sheet_.clear(x0, y0, x1, y1);
  if (all_frozen) {
    // From here on nothing can change: colours under tau leave no range, whatever their sums.
    frozen_[static_cast<std::size_t>(by)] |= bit;
    any_frozen_ = any_frozen_ || tile_.mode == Mode::Additive || tables_.opacity_holds;
  }
}

template <class T>
void TileUnit<T>::count_frozen(int x0, int y0, int x1, int y1) {
  Counting counting{counters_};
  for (int y = y0; y < y1; ++y) {
    T* unseen = &hidden_tau_[sheet_.at(x0, y)];
    for (int x = x0; x < x1; ++x, ++unseen) {
      SheetWord sums = sheet_.sums(x, y);
      const std::uint32_t colour = std::max({sums[0], sums[1], sums[2]});
      if (std::uint64_t{std::max(colour, sums[3])} + *unseen > largest_whole()) {
        sound_ = false;
        return;
      }
      // Hidden colours are at most the hidden tau, so that these are the largest sums there can have been.
      for (std::uint32_t& sum : sums) sum += *unseen;
      if (tile_.mode == Mode::Exponential && tables_.opacity_holds && colour + *unseen <= sums[3]) continue;
      const std::uint64_t before = counters_.opacity_saturated;
      if (tile_.mode == Mode::Exponential) {
        (void)tables_.opacity.exponential(sums, counting);
      } else {
        (void)tables_.opacity.additive(sums, counting);
      }
      if (*unseen != 0 && counters_.opacity_saturated != before) sound_ = false;
    }
    if (any_hidden_) std::fill(unseen - (x1 - x0), unseen, T{0});
  }
}

template <class T>
void TileUnit<T>::end_tile(const EndTile&) {
  ++counters_.tiles;
  if (!sound_) {
    counters_ = before_;
    return;
  }
  Counting counting{counters_};
  TilePixels out{
      .tile = tile_.tile, .x = tile_.x, .y = tile_.y, .width = tile_.width, .height = tile_.height, .words = {}};
  out.words.reserve(picture_.size() * 4);
  for (const PixelState& pixel : picture_) {
    const auto words = pixel_out_(tile_.mode, pixel, counting);
    out.words.insert(out.words.end(), words.begin(), words.end());
  }
  pixels_.on_tile(std::move(out));
}

template class TileUnit<std::uint16_t>;
template class TileUnit<std::uint32_t>;

}  // namespace fastsplat::cmodel::fast
