// SPDX-License-Identifier: Apache-2.0
#include "cmodel/model.hpp"

#include <algorithm>

namespace fastsplat::cmodel {

Model::Model(const Config& config, StreamScope scope, PixelSink& pixels, TapSink* taps, Ranges* ranges)
    : config_(config),
      decode_(config, scope),
      snap_(config),
      unit_(weight_unit(config)),
      ellipse_(config),
      radial_(config),
      sheet_(config),
      lane_(config),
      densities_(config),
      compositor_(config),
      pixel_out_(config),
      cull_(config),
      pixels_(pixels),
      taps_(taps),
      ranges_(ranges),
      weights_(static_cast<std::size_t>(config.lanes) * config.lanes),
      scratch_(weights_.size() * 4) {}

void Model::consume(std::span<const Beat> beats) {
  Counting counting{counters_};
  for (const Beat& beat : beats) {
    const Record* record = decode_.feed(beat);
    if (record == nullptr) continue;
    if (ranges_ == nullptr) {
      take(*record, counting);
    } else {
      Both<Counting, Ranges> both{counting, *ranges_};
      take(*record, both);
    }
  }
}

template <class Observer>
void Model::take(const Record& record, Observer& observer) {
  if (const auto* found = std::get_if<SplatRecord>(&record)) {
    splat(*found, observer);
  } else if (const auto* shaped = std::get_if<EllipseRecord>(&record)) {
    ellipse(*shaped, observer);
  } else if (const auto* table = std::get_if<LoadTable>(&record)) {
    load(*table);
  } else if (const auto* frame = std::get_if<BeginFrame>(&record)) {
    frame_ = *frame;
  } else if (const auto* tile = std::get_if<BeginTile>(&record)) {
    begin_tile(*tile);
  } else if (const auto* sheet = std::get_if<BeginSheet>(&record)) {
    sheet_number_ = sheet->sheet;
    cull_.begin_sheet();
  } else if (std::holds_alternative<EndSheet>(record)) {
    end_sheet(observer);
  } else if (std::holds_alternative<EndTile>(record)) {
    end_tile(observer);
  } else if (const auto* set = std::get_if<CullBlock>(&record)) {
    ++counters_.cull_blocks;
    cull_.cull_block(*set);
  }
}

void Model::load(const LoadTable& table) {
  switch (table.table) {
    case Table::Rlut:
      std::visit([&](auto& unit) { unit.load(table); }, unit_);
      break;
    case Table::Radial:
      std::visit([&](auto& unit) { unit.load_radial(table.words); }, unit_);
      radial_.load(table.words);
      break;
    case Table::Factor:
      compositor_.opacity().load(table.words);
      break;
    case Table::Classify:
    case Table::Root:
    case Table::Glint:
    case Table::Lighting:
    case Table::Sheets:
    case Table::Nodes:
    case Table::Pattern:
      densities_.load(table.table, table.words);
      break;
  }
}

void Model::begin_tile(const BeginTile& tile) {
  tile_ = tile;
  sheet_number_ = 0;
  halo_ = DensityStage::halo(tile.mode);
  sheet_.begin_tile(tile.width + 2 * halo_, tile.height + 2 * halo_);
  if (halo_ > 0) densities_.begin_tile(tile, frame_);
  compositor_.begin_tile(tile.mode, tile.width, tile.height);
  cull_.begin_tile(tile);
  if (terminations_ != nullptr) terminations_->reset(tile.x, tile.y, tile.width, tile.height);
}

template <class Observer>
void Model::splat(const SplatRecord& record, Observer& observer) {
  std::visit([&](auto& unit) { splat(record, unit, observer); }, unit_);
}

template <class Unit, class Observer>
void Model::splat(const SplatRecord& record, Unit& unit, Observer& observer) {
  if (cull_.dropped(record.tag)) return;
  const std::uint32_t rho = unit.rho(record.set);
  const std::uint32_t extent = unit.extent(record.set);
  const auto lanes = static_cast<std::uint32_t>(config_.lanes);
  if (cull_.on()) {
    Nothing nobody;
    const std::int32_t left = snap_(record.x, rho, nobody).origin, top = snap_(record.y, rho, nobody).origin;
    if (cull_.hidden(left, top, extent / lanes, extent / lanes)) {
      ++counters_.splats;
      return;
    }
    cull_.test_windows(left, top, extent / lanes, extent / lanes);
  }
  const SnappedAxis x = snap_(record.x, rho, observer);
  const SnappedAxis y = snap_(record.y, rho, observer);
  ++counters_.splats;
  if (taps_ != nullptr) {
    const std::array<std::uint32_t, 4> payload{static_cast<std::uint32_t>(x.origin),
                                               static_cast<std::uint32_t>(y.origin), x.phase, y.phase};
    tap(Tap::Snap, record.tag, x.origin, y.origin, payload);
  }
  unit.place(record.set, x, y);
  std::size_t number = 0;
  for (std::uint32_t row = 0; row < extent; row += lanes) {
    for (std::uint32_t column = 0; column < extent; column += lanes) {
      if (cull_.window_hidden(number++)) continue;
      unit.window(column, row, weights_, observer);
      window(record, x.origin + static_cast<std::int32_t>(column), y.origin + static_cast<std::int32_t>(row), observer);
    }
  }
}

template <class Observer>
void Model::ellipse(const EllipseRecord& record, Observer& observer) {
  if (cull_.dropped(record.tag)) return;
  const EllipseAxis x = ellipse_axis(config_, record.x, record.windows.left);
  const EllipseAxis y = ellipse_axis(config_, record.y, record.windows.top);
  ++counters_.splats;
  if (cull_.hidden(x.origin, y.origin, record.windows.columns, record.windows.rows)) return;
  if (taps_ != nullptr) {
    const std::array<std::uint32_t, 4> payload{
        static_cast<std::uint32_t>(x.origin), static_cast<std::uint32_t>(y.origin),
        static_cast<std::uint32_t>(x.distance), static_cast<std::uint32_t>(y.distance)};
    tap(Tap::Snap, record.tag, x.origin, y.origin, payload);
  }
  const EllipseCoefficients f = ellipse_.coefficients(record.shape, x.distance, y.distance);
  const auto lanes = static_cast<std::uint32_t>(config_.lanes);
  for (std::uint32_t row = 0; row < record.windows.rows * lanes; row += lanes) {
    for (std::uint32_t column = 0; column < record.windows.columns * lanes; column += lanes) {
      ellipse_.window(f, column, row, radial_, weights_, observer);
      window(record, x.origin + static_cast<std::int32_t>(column), y.origin + static_cast<std::int32_t>(row), observer);
    }
  }
}

template <class Record, class Observer>
void Model::window(const Record& record, std::int32_t x, std::int32_t y, Observer& observer) {
  ++counters_.windows;
  if (every_sample(tile_.mode)) {
    samples(record, x, y, observer);
    return;
  }
  sheet_.accumulate(x + halo_, y + halo_, weights_, record.colour, counters_, observer);
  if (taps_ != nullptr) {
    tap(Tap::Footprint, record.tag, x, y, weights_);
    tap(Tap::Sheet, record.tag, x, y,
        gather(
            x, y, [&](int i, int j) { return sheet_.at(i + halo_, j + halo_).data(); }, halo_));
  }
}

template <class Record, class Observer>
void Model::samples(const Record& record, std::int32_t x, std::int32_t y, Observer& observer) {
  const int lanes = config_.lanes;
  const int left = std::max(0, -x), right = std::min(lanes, tile_.width - x);
  const int top = std::max(0, -y), bottom = std::min(lanes, tile_.height - y);
  for (int j = top; j < bottom; ++j) {
    for (int i = left; i < right; ++i) {
      const std::uint32_t weight = weights_[static_cast<std::size_t>(j) * lanes + i];
      ++counters_.lanes_inside;
      if (weight == 0) continue;
      ++counters_.lanes_weighted;
      SheetWord products;
      for (std::size_t c = 0; c < 4; ++c) products[c] = lane_.product(record.colour[c], weight, observer);
      compositor_.step(products, x + i, y + j, counters_, observer);
    }
  }
  if (taps_ != nullptr) {
    tap(Tap::Footprint, record.tag, x, y, weights_);
    tap(Tap::Composite, record.tag, x, y, gather(x, y, [&](int i, int j) { return compositor_.at(i, j).data(); }));
  }
}

SheetWord Model::sums(int x, int y) const {
  const PatternUnit& pattern = densities_.pattern();
  if (!pattern.loaded() || tile_.mode == Mode::Sum) return sheet_.at(x, y);
  return pattern.tinted(sheet_.at(x, y), {.x = tile_.x + x, .y = tile_.y + y, .sheet = sheet_number_});
}

template <class Observer>
void Model::end_sheet(Observer& observer) {
  ++counters_.sheets;
  if (halo_ > 0) {
    classify(observer, [this](auto... takes) { densities_.end_sheet(sheet_, sheet_number_, takes...); });
    return;
  }
  sheet_.drain([&](int bx, int by) {
    ++counters_.dirty_blocks;
    const int x0 = bx * config_.lanes, x1 = std::min(tile_.width, x0 + config_.lanes);
    const int y0 = by * config_.lanes, y1 = std::min(tile_.height, y0 + config_.lanes);
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) {
        compositor_.step(sums(x, y), x, y, counters_, observer);
        if (terminations_ != nullptr && compositor_.frozen(x, y))
          terminations_->note(tile_.x + x, tile_.y + y, sheet_number_);
      }
    }
    cull_.composited(bx, by, [&](int x, int y) { return compositor_.frozen(x, y); });
    if (taps_ != nullptr)
      tap(Tap::Composite, 0, x0, y0, gather(x0, y0, [&](int i, int j) { return compositor_.at(i, j).data(); }));
  });
  cull_.end_sheet();
}

template <class Observer, class Step>
void Model::classify(Observer& observer, Step step) {
  step([&](const SheetWord& sums, int x, int y) { compositor_.step(sums, x, y, counters_, observer); },
       [&](int left, int top, std::uint32_t sheet) {
         ++counters_.dirty_blocks;
         sheet_number_ = sheet;
         if (taps_ != nullptr) {
           tap(Tap::Composite, 0, left, top,
               gather(left, top, [&](int i, int j) { return compositor_.at(i, j).data(); }));
         }
       });
}

template <class Observer>
void Model::end_tile(Observer& observer) {
  if (halo_ > 0) classify(observer, [this](auto... takes) { densities_.end_tile(takes...); });
  ++counters_.tiles;
  sheet_number_ = 0;  // pixels belong to no sheet
  TilePixels out{
      .tile = tile_.tile, .x = tile_.x, .y = tile_.y, .width = tile_.width, .height = tile_.height, .words = {}};
  out.words.reserve(static_cast<std::size_t>(tile_.width) * tile_.height * 4);
  for (int y = 0; y < tile_.height; ++y) {
    for (int x = 0; x < tile_.width; ++x) {
      const auto words = pixel_out_(tile_.mode, compositor_.at(x, y), observer);
      if (taps_ != nullptr) tap(Tap::Pixel, 0, x, y, words);
      out.words.insert(out.words.end(), words.begin(), words.end());
    }
  }
  pixels_.on_tile(std::move(out));
}

void Model::tap(Tap kind, std::uint32_t tag, std::int32_t x, std::int32_t y,
                std::span<const std::uint32_t> payload) const {
  taps_->on_tap(
      {.tap = kind, .tile = tile_.tile, .sheet = sheet_number_, .tag = tag, .x = x, .y = y, .payload = payload});
}

template <class At>
std::span<const std::uint32_t> Model::gather(std::int32_t x, std::int32_t y, At at, int halo) {
  const int lanes = config_.lanes;
  const int left = std::clamp(-halo - x, 0, lanes), right = std::clamp(tile_.width + halo - x, 0, lanes);
  const int top = std::clamp(-halo - y, 0, lanes), bottom = std::clamp(tile_.height + halo - y, 0, lanes);
  if (right - left < lanes || bottom - top < lanes) std::ranges::fill(scratch_, 0);
  for (int j = top; j < bottom; ++j) {
    std::uint32_t* out = &scratch_[static_cast<std::size_t>(j) * lanes * 4];
    for (int i = left; i < right; ++i) std::copy_n(at(x + i, y + j), 4, out + 4 * i);
  }
  return scratch_;
}

}  // namespace fastsplat::cmodel
