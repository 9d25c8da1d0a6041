// SPDX-License-Identifier: Apache-2.0
#include "testbench/triage/explain.hpp"

#include <algorithm>

#include "cmodel/composite/compositor.hpp"
#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/numbers/observers.hpp"
#include "cmodel/splat/ellipse_unit.hpp"
#include "cmodel/splat/footprint.hpp"
#include "cmodel/splat/rlut.hpp"
#include "cmodel/splat/sheet_buffer.hpp"
#include "cmodel/splat/snap.hpp"
#include "testbench/device/words.hpp"

namespace fastsplat::testbench {
namespace {

/// Walks the stream through the model's units up to the event and writes down what meets there.
class Walk {
 public:
  Walk(const cmodel::Config& config, const Divergence& divergence)
      : config_(config),
        at_(*divergence.model),
        word_(divergence.word),
        decode_(config, cmodel::StreamScope::Subset),
        rlut_(config),
        radial_(config),
        sheet_(config),
        lane_(config),
        compositor_(config) {}

  void feed(std::span<const cmodel::Beat> beats) {
    for (const auto& beat : beats) {
      if (found_) return;
      if (const auto* record = decode_.feed(beat)) take(*record);
    }
  }
  const std::string& text() const { return text_; }

 private:
  std::size_t lanes() const { return static_cast<std::size_t>(config_.lanes); }

  void take(const cmodel::Record& record) {
    if (const auto* table = std::get_if<cmodel::LoadTable>(&record)) {
      load(*table);
    } else if (const auto* tile = std::get_if<cmodel::BeginTile>(&record)) {
      tile_ = *tile;
      sheet_.begin_tile(tile->width, tile->height);
      compositor_.begin_tile(tile->mode, tile->width, tile->height);
    } else if (const auto* begin = std::get_if<cmodel::BeginSheet>(&record)) {
      number_ = begin->sheet;
    } else if (const auto* found = std::get_if<cmodel::SplatRecord>(&record)) {
      splat(*found);
    } else if (const auto* shaped = std::get_if<cmodel::EllipseRecord>(&record)) {
      ellipse(*shaped);
    } else if (std::holds_alternative<cmodel::EndSheet>(record)) {
      end_sheet();
    } else if (std::holds_alternative<cmodel::EndTile>(record)) {
      if (at_.tap == cmodel::Tap::Pixel && at_.tile == tile_.tile) pixel();
    }
  }

  void load(const cmodel::LoadTable& table) {
    if (table.table == cmodel::Table::Rlut) {
      rlut_.load(table);
    } else if (table.table == cmodel::Table::Radial) {
      radial_.load(table.words);
    } else {
      compositor_.opacity().load(table.words);
    }
  }

  bool here(cmodel::Tap tap, std::uint32_t tag) const {
    return at_.tap == tap && at_.tile == tile_.tile && at_.sheet == number_ && at_.tag == tag;
  }

  /// Adds a window's products to the sheet or, every sample, to the picture; true once the requested word was
  /// explained.
  template <class Record>
  bool window(const Record& record, std::int32_t left, std::int32_t top, const std::vector<std::uint32_t>& weights) {
    const bool wanted = at_.x == left && at_.y == top;
    cmodel::Counters unused;
    if (!cmodel::every_sample(tile_.mode)) {
      if (wanted && here(cmodel::Tap::Sheet, record.tag)) return sum(record, left, top, weights), true;
      sheet_.accumulate(left, top, weights, record.colour, unused, nobody_);
      return false;
    }
    const bool wanted_here = wanted && here(cmodel::Tap::Composite, record.tag);
    for (std::size_t lane = 0; lane < weights.size(); ++lane) {
      const std::int32_t x = left + static_cast<std::int32_t>(lane % lanes());
      const std::int32_t y = top + static_cast<std::int32_t>(lane / lanes());
      cmodel::SheetWord products{};
      for (std::size_t c = 0; c < 4; ++c) products[c] = lane_.product(record.colour[c], weights[lane], nobody_);
      if (wanted_here && lane == word_ / 4) return composite(x, y, products, "sample"), true;
      if (weights[lane] != 0 && sheet_.inside(x, y)) compositor_.step(products, x, y, unused, nobody_);
    }
    return false;
  }

  void found(std::string text) {
    text_ = std::move(text);
    found_ = true;
  }

  void splat(const cmodel::SplatRecord& record) {
    const std::uint32_t rho = rlut_.rho(record.set);
    const auto x = cmodel::snap(config_, record.x, rho), y = cmodel::snap(config_, record.y, rho);
    if (here(cmodel::Tap::Snap, record.tag)) {
      return found("centre x=" + hex(record.x) + " y=" + hex(record.y) + " (S " +
                   std::to_string(config_.position_int_bits) + "." + std::to_string(config_.position_frac_bits) +
                   "), set " + std::to_string(record.set) + " rho=" + std::to_string(rho) +
                   ": x0=" + std::to_string(x.origin) + " mx=" + std::to_string(x.phase) +
                   ", y0=" + std::to_string(y.origin) + " my=" + std::to_string(y.phase));
    }
    std::vector<std::uint32_t> weights(lanes() * lanes());
    const std::uint32_t extent = rlut_.extent(record.set), step = static_cast<std::uint32_t>(config_.lanes);
    for (std::uint32_t row = 0; row < extent; row += step) {
      for (std::uint32_t column = 0; column < extent; column += step) {
        const auto columns = rlut_.read(record.set, x.phase, column), rows = rlut_.read(record.set, y.phase, row);
        cmodel::footprint(radial_, columns, rows, weights, nobody_);
        const std::int32_t left = x.origin + static_cast<std::int32_t>(column);
        const std::int32_t top = y.origin + static_cast<std::int32_t>(row);
        if (at_.x == left && at_.y == top && here(cmodel::Tap::Footprint, record.tag))
          return found(weight(record, columns[word_ % lanes()], rows[word_ / lanes()], x.phase, y.phase,
                              column + word_ % lanes(), row + word_ / lanes()));
        if (window(record, left, top, weights)) return;
      }
    }
  }

  void ellipse(const cmodel::EllipseRecord& record) {
    const auto x = cmodel::ellipse_axis(config_, record.x, record.windows.left);
    const auto y = cmodel::ellipse_axis(config_, record.y, record.windows.top);
    const cmodel::EllipseShape& shape = record.shape;
    if (here(cmodel::Tap::Snap, record.tag)) {
      return found("ellipse, centre x=" + hex(record.x) + " y=" + hex(record.y) +
                   ", left=" + std::to_string(record.windows.left) + " top=" + std::to_string(record.windows.top) +
                   ": x0=" + std::to_string(x.origin) + " X=" + std::to_string(x.distance) +
                   ", y0=" + std::to_string(y.origin) + " Y=" + std::to_string(y.distance));
    }
    const cmodel::EllipseUnit unit(config_);
    const auto f = unit.coefficients(shape, x.distance, y.distance);
    std::vector<std::uint32_t> weights(lanes() * lanes());
    const auto step = static_cast<std::uint32_t>(config_.lanes);
    for (std::uint32_t row = 0; row < record.windows.rows * step; row += step) {
      for (std::uint32_t column = 0; column < record.windows.columns * step; column += step) {
        unit.window(f, column, row, radial_, weights, nobody_);
        const std::int32_t left = x.origin + static_cast<std::int32_t>(column);
        const std::int32_t top = y.origin + static_cast<std::int32_t>(row);
        if (at_.x == left && at_.y == top && here(cmodel::Tap::Footprint, record.tag)) {
          const std::size_t i = column + word_ % lanes(), j = row + word_ / lanes();
          return found(
              "A=" + std::to_string(shape.a) + " B=" + std::to_string(shape.b) + " C=" + std::to_string(shape.c) +
              " h=" + std::to_string(shape.shift) + ": u0=" + std::to_string(f.u0) + " u1=" + std::to_string(f.u1) +
              " u2=" + std::to_string(f.u2) + " v1=" + std::to_string(f.v1) + " v2=" + std::to_string(f.v2) +
              " e=" + std::to_string(f.e) + "; pixel " + std::to_string(i) + "," + std::to_string(j) +
              ": index=" + std::to_string(unit.index(f, static_cast<std::int64_t>(i), static_cast<std::int64_t>(j))));
        }
        if (window(record, left, top, weights)) return;
      }
    }
  }

  std::string weight(const cmodel::SplatRecord& record, std::uint32_t column, std::uint32_t row, std::uint32_t mx,
                     std::uint32_t my, std::size_t i, std::size_t j) {
    const std::uint32_t q = column + row, index = cmodel::radial_index(q, config_.rlut_guard_bits);
    const auto name = [&](std::uint32_t phase, std::size_t at) {
      return "RLUT[" + std::to_string(record.set) + "][" + std::to_string(phase) + "][" + std::to_string(at) + "]";
    };
    const bool inside = index < static_cast<std::uint32_t>(config_.radial_entries);
    return name(mx, i) + "=" + hex(column) + " + " + name(my, j) + "=" + hex(row) + ": q=" + hex(q) +
           ", index=" + std::to_string(index) +
           (inside ? ", RADIAL=" + hex(radial_.weight(q, nobody_)) : ", at or beyond the footprint's edge: 0");
  }

  template <class Record>
  void sum(const Record& record, std::int32_t left, std::int32_t top, const std::vector<std::uint32_t>& weights) {
    const std::size_t lane = word_ / 4, channel = word_ % 4;
    const std::int32_t x = left + static_cast<std::int32_t>(lane % lanes());
    const std::int32_t y = top + static_cast<std::int32_t>(lane / lanes());
    if (!sheet_.inside(x, y))
      return found("pixel (" + std::to_string(x) + "," + std::to_string(y) + ") is outside the tile");
    const auto product = cmodel::narrowing(
        config_, cmodel::Site::Product)(static_cast<std::int64_t>(record.colour[channel]) * weights[lane]);
    found("pixel (" + std::to_string(x) + "," + std::to_string(y) + "): sum before " + hex(sheet_.at(x, y)[channel]) +
          ", colour " + kChannels[channel] + "=" + hex(record.colour[channel]) + " x weight " + hex(weights[lane]) +
          " = product " + hex(product.word) + (product.overflow ? " (saturated)" : ""));
  }

  void end_sheet() {
    const bool wanted = here(cmodel::Tap::Composite, 0);
    const int block = config_.lanes;
    sheet_.drain([&](int bx, int by) {
      if (wanted && !found_ && at_.x == bx * block && at_.y == by * block) {
        const int x = at_.x + static_cast<int>(word_ / 4 % lanes()), y = at_.y + static_cast<int>(word_ / 4 / lanes());
        return composite(x, y, sheet_.inside(x, y) ? sheet_.at(x, y) : cmodel::SheetWord{}, "sheet");
      }
      for (int y = by * block; y < std::min(tile_.height, (by + 1) * block); ++y) {
        for (int x = bx * block; x < std::min(tile_.width, (bx + 1) * block); ++x) {
          cmodel::Counters unused;
          compositor_.step(sheet_.at(x, y), x, y, unused, nobody_);
        }
      }
    });
  }

  /// Explains a pixel before the sums of `what` are composited.
  void composite(int x, int y, const cmodel::SheetWord& sums, const char* what) {
    if (!sheet_.inside(x, y))
      return found("pixel (" + std::to_string(x) + "," + std::to_string(y) + ") is outside the tile");
    const auto& state = compositor_.at(x, y);
    std::string text = "pixel (" + std::to_string(x) + "," + std::to_string(y) + ") before: ";
    const bool summing = tile_.mode == cmodel::Mode::Sum;
    for (std::size_t c = 0; c < 4; ++c)
      text += std::string(c > 0 ? " " : "") +
              (summing  ? "X_"
               : c == 3 ? ""
                        : "C_") +
              (c == 3 && !summing ? "T" : kChannels[c]) + "=" + hex(state[c]);
    text += std::string("; ") + what;
    for (std::size_t c = 0; c < 4; ++c) text += std::string(" ") + kChannels[c] + "=" + hex(sums[c]);
    if (!summing) {
      const bool exponential = cmodel::slab_mode(tile_.mode) == cmodel::Mode::Exponential;
      const auto& opacity = compositor_.opacity();
      const auto slab = exponential ? opacity.exponential(sums, nobody_) : opacity.additive(sums, nobody_);
      if (exponential) text += "; factor " + hex(opacity.factor(sums[3], nobody_));
      text += "; slab R=" + hex(slab.colour[0]) + " G=" + hex(slab.colour[1]) + " B=" + hex(slab.colour[2]) +
              " opacity=" + hex(slab.opacity);
      if (state[3] < static_cast<std::uint32_t>(config_.freeze_below))
        text += "; frozen (T < " + hex(config_.freeze_below) + ")";
    }
    found(text);
  }

  void pixel() {
    const auto& state = compositor_.at(at_.x, at_.y);
    std::string text = "state";
    for (const std::uint32_t word : state) text += " " + hex(word);
    found(text + (tile_.mode == cmodel::Mode::Sum ? " (X-ray sums)" : " (C_R C_G C_B T)"));
  }

  const cmodel::Config& config_;
  const TapCopy& at_;
  std::size_t word_;
  cmodel::StreamDecode decode_;
  cmodel::Rlut rlut_;
  cmodel::RadialTable radial_;
  cmodel::SheetBuffer sheet_;
  cmodel::Lane lane_;
  cmodel::Compositor compositor_;
  cmodel::Nothing nobody_;
  cmodel::BeginTile tile_;
  std::uint32_t number_ = 0;
  std::string text_;
  bool found_ = false;
};

}  // namespace

std::string explain(const BeatSource& source, const cmodel::Config& config, const Divergence& divergence) {
  if (!divergence.model) return {};
  Walk walk(config, divergence);
  source([&](std::span<const cmodel::Beat> beats) { walk.feed(beats); });
  return walk.text();
}

}  // namespace fastsplat::testbench
