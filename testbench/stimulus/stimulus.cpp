// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/stimulus.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/numbers/window_geometry.hpp"
#include "testbench/stimulus/ellipse_stimulus.hpp"
#include "testbench/stimulus/random.hpp"
#include "testbench/stimulus/random_cull_blocks.hpp"
#include "testbench/stimulus/stimulus_tables.hpp"
#include "testbench/stimulus/window_centre.hpp"

namespace fastsplat::testbench {
namespace {

struct ClassName {
  StimulusClass which;
  const char* name;
  const char* meaning;
};
constexpr std::array kNames{
    ClassName{StimulusClass::Mixed, "mixed", "any legal stream"},
    ClassName{StimulusClass::TableCorners, "table-corners", "RLUT sums on both sides of the ends of every table"},
    ClassName{StimulusClass::RoundingTies, "rounding-ties", "products exactly halfway between two words"},
    ClassName{StimulusClass::Saturation, "saturation",
              "each channel alone and all together, in every saturating stage"},
    ClassName{StimulusClass::Thresholds, "thresholds",
              "transmittance near the early-termination threshold, sums near the largest word"},
    ClassName{StimulusClass::BankPhases, "bank-phases", "every window origin modulo P"},
    ClassName{StimulusClass::ScreenEdges, "screen-edges", "windows across each edge and corner of partial tiles"},
    ClassName{StimulusClass::Hazards, "hazards", "the same words again after 1, 2, 3, ... windows"},
    ClassName{StimulusClass::SwapHazards, "swap-hazards", "the same words on both sides of a sheet swap"},
    ClassName{StimulusClass::SwapPhases, "swap-phases", "sheets of 0, 1, 2, ... splats"},
    ClassName{StimulusClass::EmptySheets, "empty-sheets", "empty sheets and tiles"},
    ClassName{StimulusClass::OffTile, "off-tile", "sheets whose splats all miss the tile"},
    ClassName{StimulusClass::SparseSheets, "sparse-sheets", "few splats far apart: bound by the compositor"},
    ClassName{StimulusClass::MultiWindow, "multi-window", "footprints of many windows"},
    ClassName{StimulusClass::PositionExtremes, "position-extremes", "centres at both ends of the position format"},
    ClassName{StimulusClass::Bubbles, "bubbles", "the source pauses"},
    ClassName{StimulusClass::BackPressure, "back-pressure", "the sink pauses"},
    ClassName{StimulusClass::Reset, "reset", "a warm reset in the middle, then the whole stream"},
};

/// Windows per side that footprints go up to: more are repetitions.
constexpr std::uint64_t kMostWindows = 6;

/// Sheets of 0, 1, ... splats: longer than pipe and walk of a few blocks together.
constexpr std::int64_t kSheetSizes = 41;

class Generator {
 public:
  Generator(const cmodel::Config& config, StimulusClass which, std::uint64_t seed)
      : config_(config), which_(which), seed_(seed), random_(mix(seed) + static_cast<std::uint64_t>(which)) {}

  Stimulus make(std::uint64_t splats) {
    Stimulus out;
    auto& document = out.document;
    document.width = config_.tile_width * 4;
    // The picture's edges matter to densities: its sides differ.
    image_height_ = config_.tile_height * (config_.classifies() ? 5 : 4);
    document.height = image_height_;
    make_tables(document);
    left_ = std::max<std::uint64_t>(splats, 1);
    while (left_ > 0) document.tiles.push_back(make_tile());
    if (which_ == StimulusClass::EmptySheets) {
      // Tiles without a sheet, of one beat: the picture goes out while the next record is already offered.
      TileDocument empty{begin_tile(), {}};
      empty.begin.width = static_cast<int>(random_.between(1, config_.lanes));
      empty.begin.height = 1;
      empty.begin.x = std::min(empty.begin.x, document.width - empty.begin.width);  // at the edge it may have grown
      document.tiles.insert(document.tiles.begin(), 3, empty);
      document.tiles.push_back(empty);
    }
    if (which_ == StimulusClass::Bubbles) out.input = pick({"random-50", "burst-16", "every-3", "alternate-7"});
    if (which_ == StimulusClass::BackPressure) out.ready = pick({"random-10", "burst-64", "every-5", "alternate-500"});
    if (which_ == StimulusClass::Reset) {
      out.reset_after = reset_point(write_document(config_, document));
    }
    return out;
  }

 private:
  /// Beats before the reset: any number, or so that it falls into the tables, a tile's begin, a walk or a picture.
  std::uint64_t reset_point(const std::vector<cmodel::Beat>& beats) {
    std::vector<std::size_t> tiles, sheets, pictures;
    cmodel::StreamDecode decode(config_, cmodel::StreamScope::Whole);
    for (std::size_t i = 0; i < beats.size(); ++i) {
      const cmodel::Record* record = decode.feed(beats[i]);
      if (record == nullptr) continue;
      if (std::holds_alternative<cmodel::BeginTile>(*record)) tiles.push_back(i + 1);
      if (std::holds_alternative<cmodel::EndSheet>(*record)) sheets.push_back(i + 1);
      if (std::holds_alternative<cmodel::EndTile>(*record)) pictures.push_back(i + 1);
    }
    const auto draw = [this](std::size_t low, std::size_t high) {
      return static_cast<std::size_t>(random_.between(static_cast<std::int64_t>(low), static_cast<std::int64_t>(high)));
    };
    const auto one_of = [&](const std::vector<std::size_t>& places) { return places[draw(0, places.size() - 1)]; };
    std::size_t after = 0;
    switch (random_.between(0, 4)) {
      case 0:
        after = draw(1, random_.chance(50) ? tiles.front() : 2);
        break;
      case 1:
        after = one_of(tiles);
        after += draw(0, 2);  // check holds the last two, decode the one before
        break;
      case 2:
        after = sheets.empty() ? 0 : one_of(sheets);
        after += draw(8, 30);  // the walk begins 12 cycles later
        break;
      case 3:
        after = one_of(pictures);
        after += draw(1, 3);
        break;
      default:
        after = draw(1, beats.size());
    }
    return std::min(after, beats.size());
  }

  const char* pick(std::initializer_list<const char*> names) {
    return names.begin()[random_.between(0, static_cast<std::int64_t>(names.size()) - 1)];
  }

  TableStyle style() const {
    switch (which_) {
      case StimulusClass::TableCorners:
        return TableStyle::Corners;
      case StimulusClass::RoundingTies:
        return TableStyle::Powers;
      case StimulusClass::Saturation:
        return TableStyle::Largest;
      case StimulusClass::Thresholds:
        return TableStyle::Unit;
      default:
        return TableStyle::Any;
    }
  }

  void make_tables(StreamDocument& document) {
    int least = 1, most = random_.chance(30) ? 3 : 1;
    // Each size in turn, over the seeds.
    if (which_ == StimulusClass::MultiWindow) least = most = 1 + static_cast<int>(seed_ % kMostWindows);
    // A set's load takes thousands of beats in the large configurations; more sets than this add no new case.
    sets_ = static_cast<std::uint32_t>(random_.between(1, std::min(config_.rlut_sets, 4)));
    first_set_ = static_cast<std::uint32_t>(random_.between(0, config_.rlut_sets - static_cast<int>(sets_)));
    for (std::uint32_t i = 0; i < sets_; ++i)
      document.tables.push_back(random_rlut(config_, random_, style(), first_set_ + i, least, most));
    document.tables.push_back(random_radial(config_, random_, style()));
    document.tables.push_back(random_factor(config_, random_, style()));
    if (config_.classifies()) {
      // In any order: what one table's words are must not reach another's.
      std::array tables{cmodel::Table::Classify, cmodel::Table::Root, cmodel::Table::Glint, cmodel::Table::Lighting,
                        cmodel::Table::Sheets};
      for (std::size_t last = tables.size() - 1; last > 0; --last)
        std::swap(tables[last], tables[static_cast<std::size_t>(random_.between(0, static_cast<std::int64_t>(last)))]);
      for (const auto table : tables) document.tables.push_back(random_density_table(config_, random_, table));
    }
    if (random_.chance(30)) {
      // The words loaded last count.
      const std::uint32_t again = first_set_ + static_cast<std::uint32_t>(random_.between(0, sets_ - 1));
      document.tables.push_back(random_rlut(config_, random_, style(), again, least, most));
    }
    for (const auto& table : document.tables) {
      if (table.table == cmodel::Table::Rlut) rho_[table.radius.set] = table.radius.rho;
    }
  }

  cmodel::BeginTile begin_tile() {
    // Small tiles mostly: a tile costs its pixels, with or without splats.
    const auto side = [this](int most) {
      // Narrower than a window: it reaches over both edges.
      if (which_ == StimulusClass::ScreenEdges && random_.chance(25))
        return static_cast<int>(random_.between(1, std::max(1, config_.lanes - 2)));
      if (random_.chance(which_ == StimulusClass::ScreenEdges ? 40 : 10)) return most;
      return static_cast<int>(random_.between(1, random_.between(1, most)));
    };
    cmodel::BeginTile tile{.mode = static_cast<cmodel::Mode>(random_.between(0, 2)),
                           .tile = 0,
                           .x = 0,
                           .y = 0,
                           .width = side(config_.tile_width),
                           .height = side(config_.tile_height)};
    if (config_.composite_every_sample != 0 && tile.mode != cmodel::Mode::Sum && random_.chance(70))
      tile.mode =
          tile.mode == cmodel::Mode::Exponential ? cmodel::Mode::SampleExponential : cmodel::Mode::SampleAdditive;
    tile.x = static_cast<std::int32_t>(random_.between(0, 3 * config_.tile_width));
    tile.y = static_cast<std::int32_t>(random_.between(0, 3 * config_.tile_height));
    if (config_.classifies() && tile.mode != cmodel::Mode::Sum && random_.chance(70)) densities(tile);
    return tile;
  }

  /// A tile of densities: smaller by the halo, mostly at the picture's edges, where neighbours are missing.
  void densities(cmodel::BeginTile& tile) {
    tile.mode =
        tile.mode == cmodel::Mode::Exponential ? cmodel::Mode::DensityExponential : cmodel::Mode::DensityAdditive;
    tile.width = std::min(tile.width, config_.tile_width - 2);
    tile.height = std::min(tile.height, config_.tile_height - 2);
    const std::int64_t edge = random_.between(0, 8);
    if (edge % 3 == 1) tile.x = 0;
    if (edge % 3 == 2) tile.x = 4 * config_.tile_width - tile.width;
    if (edge / 3 == 1) tile.y = 0;
    if (edge / 3 == 2) tile.y = image_height_ - tile.height;
  }

  TileDocument make_tile() {
    tile_ = begin_tile();
    TileDocument tile{tile_, {}};
    // Events that happen once in a pixel's life need many tiles.
    const bool many_tiles = which_ == StimulusClass::Thresholds;
    const auto tile_splats = static_cast<std::uint64_t>(random_.between(20, many_tiles ? 60 : 600));
    std::uint64_t in_tile = std::min(left_, tile_splats);
    left_ -= in_tile;
    auto number = static_cast<std::uint32_t>(random_.between(0, 5));
    hot_ = before_ = last_ = place();
    auto sheet = static_cast<std::uint64_t>(random_.between(0, kSheetSizes - 1));
    while (in_tile > 0) {
      const std::uint64_t count = std::min(in_tile, sheet_size(sheet++));
      tile.sheets.push_back(make_sheet(number, count));
      in_tile -= count;
      if (cmodel::holds_densities(tile_.mode)) {
        number += static_cast<std::uint32_t>(random_.chance(90) ? 1 : random_.between(1, 3));
        if (number < kScaledSheets) continue;
        left_ += in_tile;  // no more sheets have scales
        break;
      }
      number += static_cast<std::uint32_t>(random_.chance(90) ? 1 : random_.between(1, 1000));
    }
    return tile;
  }

  std::uint64_t sheet_size(std::uint64_t sheet) {
    const auto draw = [this](int low, int high) { return static_cast<std::uint64_t>(random_.between(low, high)); };
    switch (which_) {
      case StimulusClass::EmptySheets:
        return random_.chance(70) ? 0 : draw(1, 5);
      case StimulusClass::SwapHazards:
        return draw(1, 4);
      case StimulusClass::SwapPhases:
        return sheet % kSheetSizes;
      case StimulusClass::SparseSheets:
        return draw(1, 6);
      case StimulusClass::OffTile:
        return draw(0, 8);
      case StimulusClass::Thresholds:
        return threshold_splats();
      case StimulusClass::Hazards:
        return draw(20, 200);
      default:
        return random_.chance(20) ? draw(0, 4) : draw(5, 100);
    }
  }

  /// Weights and factors pass words on evenly, so the sum of a sheet's splats can be aimed at a word. It is the optical
  /// depth that takes the transmittance from 1.0 to within two steps of the threshold, or the largest word of each
  /// channel, or one more.
  std::uint64_t threshold_splats() {
    missing_.fill(-1);  // anything
    if (random_.chance(60)) {
      const int up = config_.sheet_frac_bits - config_.composite_frac_bits;
      const std::int64_t opacity = config_.transmittance_format().max - config_.freeze_below + random_.between(-2, 2);
      missing_[3] = up >= 0 ? opacity << up : opacity >> -up;
    } else {
      for (auto& channel : missing_) channel = config_.sheet_format().max + random_.between(0, 1);
    }
    const std::int64_t most = product(static_cast<std::uint32_t>(config_.colour_format().max));
    return static_cast<std::uint64_t>((missing_[3] + most - 1) / most);
  }

  int product_shift() const { return config_.colour_frac_bits + config_.radial_frac_bits - config_.sheet_frac_bits; }
  /// The sheet word that a colour becomes under the unit weight.
  std::int64_t product(std::uint32_t colour) const {
    return (std::int64_t{colour} * unit_weight(config_) + (std::int64_t{1} << product_shift() >> 1)) >> product_shift();
  }
  /// The colour for a sheet word, or the largest colour.
  std::uint32_t colour_for(std::int64_t word) const {
    const std::int64_t exact = ((word << product_shift()) + unit_weight(config_) - 1) / unit_weight(config_);
    return static_cast<std::uint32_t>(std::min(exact, config_.colour_format().max));
  }

  struct Place {
    std::uint32_t set = 0;
    std::int32_t x = 0, y = 0;
  };

  /// The centre word whose window starts at pixel `origin` with phase `phase`, within the position format.
  std::int32_t centre(std::uint32_t set, std::int64_t origin, std::int64_t phase) const {
    return window_centre(config_, rho_[set], origin, phase);
  }

  std::int64_t extent(std::uint32_t set) const { return cmodel::window_geometry(config_, rho_[set]).padded; }

  std::int32_t coordinate(std::uint32_t set, int side) {
    const std::int64_t wide = extent(set), phase = random_.between(0, config_.phases - 1);
    const auto format = config_.position_format();
    switch (which_) {
      case StimulusClass::ScreenEdges:
        return centre(set, random_.chance(50) ? random_.between(-wide, 1) : side - random_.between(-1, wide), phase);
      case StimulusClass::OffTile:
        return centre(set, random_.chance(50) ? -wide - random_.between(0, 9) : side + random_.between(0, 9), phase);
      case StimulusClass::PositionExtremes: {
        const std::int64_t near = random_.between(0, random_.chance(50) ? 2 : 200);
        return static_cast<std::int32_t>(random_.chance(50) ? format.min + near : format.max - near);
      }
      default:
        if (random_.chance(1)) return static_cast<std::int32_t>(random_.between(format.min, format.max));
        return centre(set, random_.between(-wide + 1, side), phase);
    }
  }

  Place place() {
    Place at;
    at.set = first_set_ + static_cast<std::uint32_t>(random_.between(0, sets_ - 1));
    at.x = coordinate(at.set, tile_.width);
    at.y = coordinate(at.set, tile_.height);
    if (which_ == StimulusClass::BankPhases) {
      const std::int64_t lanes = config_.lanes, phase = random_.between(0, config_.phases - 1);
      const std::int64_t turn = phase_++;
      at.x = centre(at.set, turn % lanes + lanes * random_.between(0, tile_.width / config_.lanes), phase);
      at.y = centre(at.set, turn / lanes % lanes + lanes * random_.between(0, tile_.height / config_.lanes), phase);
    }
    return at;
  }

  std::uint32_t colour() {
    const std::int64_t most = config_.colour_format().max;
    switch (random_.between(0, 4)) {
      case 0:
        return static_cast<std::uint32_t>(random_.between(0, most));
      case 1:
        return static_cast<std::uint32_t>(random_.between(0, 2));
      case 2:
        return static_cast<std::uint32_t>(most - random_.between(0, 2));
      default:
        return static_cast<std::uint32_t>(random_.between(0, most) >> random_.between(0, 8));
    }
  }

  std::array<std::uint32_t, 4> colours() {
    std::array<std::uint32_t, 4> words{colour(), colour(), colour(), colour()};
    if (which_ == StimulusClass::Thresholds) {
      for (std::size_t c = 0; c < 4; ++c) {
        if (missing_[c] < 0) continue;
        words[c] = colour_for(missing_[c]);
        missing_[c] -= product(words[c]);
      }
    } else if (which_ == StimulusClass::RoundingTies) {
      // Small odd numbers times powers of two.
      for (auto& word : words) {
        const std::int64_t odd = 2 * random_.between(0, 7) + 1;
        word = static_cast<std::uint32_t>((odd << random_.between(0, config_.colour_frac_bits)) &
                                          config_.colour_format().max);
      }
    } else if (which_ == StimulusClass::Saturation) {
      const auto bright = static_cast<std::size_t>(random_.between(0, 4));  // one channel, or all
      for (std::size_t c = 0; c < 4; ++c) {
        if (bright == 4 || c == bright)
          words[c] = static_cast<std::uint32_t>(config_.colour_format().max);
        else if (random_.chance(60))
          words[c] = 0;
      }
    }
    return words;
  }

  /// The hot spot, moved by up to a window's side: windows just overlap the previous ones, or just miss them.
  Place beside_hot() {
    Place at = hot_;
    const auto format = config_.position_format();
    for (std::int32_t* word : {&at.x, &at.y}) {
      const std::int64_t pixels = random_.between(-config_.lanes, config_.lanes);
      *word = static_cast<std::int32_t>(
          std::clamp(*word + pixels * (std::int64_t{1} << config_.position_frac_bits), format.min, format.max));
    }
    return at;
  }

  /// The place before the last one, moved by a whole tile of the device: outside where the other is inside. Its block
  /// numbers differ only in bits that addresses do not have.
  Place opposite() {
    Place at = before_;
    const auto format = config_.position_format();
    const auto across = [&](std::int32_t& word, int side) {
      const std::int64_t whole = std::int64_t{side} << config_.position_frac_bits;
      word = static_cast<std::int32_t>(std::clamp(word + (2 * word < whole ? whole : -whole), format.min, format.max));
    };
    if (random_.chance(50))
      across(at.x, config_.tile_width);
    else
      across(at.y, config_.tile_height);
    return at;
  }

  Place next_place(std::uint64_t index) {
    const Place at = drawn_place(index);
    before_ = last_;
    return last_ = at;
  }

  Place drawn_place(std::uint64_t index) {
    const bool swap = which_ == StimulusClass::SwapHazards || which_ == StimulusClass::SwapPhases;
    if (which_ == StimulusClass::Hazards || swap) {
      if (cmodel::every_sample(tile_.mode) && random_.chance(40)) return beside_hot();
      if (random_.chance(2)) hot_ = place();
      // Back at the hot spot after 1, 2, 3, ... 8 windows.
      if (index % distance_ != 0) return place();
      if (random_.chance(25)) distance_ = static_cast<std::uint64_t>(random_.between(1, 8));
      return hot_;
    }
    if (which_ == StimulusClass::Thresholds) return hot_;
    if (which_ == StimulusClass::ScreenEdges && cmodel::every_sample(tile_.mode) && random_.chance(75))
      return opposite();
    if (random_.chance(which_ == StimulusClass::Saturation ? 80 : 10)) return hot_;
    return place();
  }

  /// Classes that aim at words of tables, products or sums, or past the tile, use circles only.
  bool ellipses() const {
    if (!config_.has_ellipses()) return false;
    switch (which_) {
      case StimulusClass::TableCorners:
      case StimulusClass::RoundingTies:
      case StimulusClass::Saturation:
      case StimulusClass::Thresholds:
      case StimulusClass::OffTile:
        return false;
      default:
        return true;
    }
  }
  std::int64_t most_ellipse_windows() const {
    return which_ == StimulusClass::MultiWindow ? static_cast<std::int64_t>(kMostWindows) : 2;
  }

  SheetDocument make_sheet(std::uint32_t number, std::uint64_t count) {
    SheetDocument sheet{number, {}};
    const bool hints = !config_.culls();
    for (std::uint64_t i = 0; i < count; ++i) {
      if (hints && random_.chance(2)) sheet.records.emplace_back(cull());
      const Place at = next_place(i);
      if (ellipses() && random_.chance(40)) {
        cmodel::EllipseRecord shaped = random_ellipse(config_, random_, at.x, at.y, most_ellipse_windows());
        shaped.colour = colours();
        sheet.records.emplace_back(shaped);
        continue;
      }
      sheet.records.emplace_back(
          cmodel::SplatRecord{.set = at.set, .tag = 0, .x = at.x, .y = at.y, .colour = colours()});
    }
    if (hints && random_.chance(2)) sheet.records.emplace_back(cull());
    if (!hints && walls() && random_.chance(30)) wall(sheet);
    if (!hints) add_cull_blocks(config_, random_, tile_, rho_, sheet);
    return sheet;
  }

  /// Classes whose sheets have a purpose of their own are left as they are.
  bool walls() const {
    return which_ != StimulusClass::Thresholds && which_ != StimulusClass::OffTile &&
           which_ != StimulusClass::EmptySheets && which_ != StimulusClass::SparseSheets;
  }
  /// Bright splats side by side over the tile or a part of it, for devices that cull: they terminate pixels.
  void wall(SheetDocument& sheet) {
    const std::int64_t from = random_.chance(50) ? 0 : random_.between(0, tile_.height - 1), lanes = config_.lanes;
    const auto most = static_cast<std::uint32_t>(config_.colour_format().max);
    for (std::int64_t y = from; y < tile_.height; y += lanes) {
      for (std::int64_t x = 0; x < tile_.width; x += lanes) {
        const std::uint32_t set = first_set_ + static_cast<std::uint32_t>(random_.between(0, sets_ - 1));
        sheet.records.emplace_back(cmodel::SplatRecord{.set = set,
                                                       .tag = 0,
                                                       .x = centre(set, x, 0),
                                                       .y = centre(set, y, 0),
                                                       .colour = {colour(), colour(), colour(), most}});
      }
    }
  }

  cmodel::CullBlock cull() {
    return {.tag = static_cast<std::uint32_t>(random_.between(0, 100)),
            .x = static_cast<std::int32_t>(random_.between(-100, 100)),
            .y = static_cast<std::int32_t>(random_.between(-100, 100)),
            .width = static_cast<int>(random_.between(1, 65535)),
            .height = static_cast<int>(random_.between(1, 65535)),
            .splats = static_cast<std::uint32_t>(random_.next())};
  }

  const cmodel::Config& config_;
  StimulusClass which_;
  std::uint64_t seed_;
  Random random_;
  std::uint32_t first_set_ = 0, sets_ = 1;
  std::array<std::uint32_t, 256> rho_{};
  cmodel::BeginTile tile_;
  Place hot_, before_, last_;
  int image_height_ = 0;
  std::uint64_t left_ = 0, distance_ = 1;
  std::int64_t phase_ = 0;
  std::array<std::int64_t, 4> missing_{};  ///< of the words that a sheet aims at; negative: any colour
};

}  // namespace

const std::vector<StimulusClass>& stimulus_classes() {
  static const std::vector<StimulusClass> classes = [] {
    std::vector<StimulusClass> all;
    for (const auto& entry : kNames) all.push_back(entry.which);
    return all;
  }();
  return classes;
}

const char* to_string(StimulusClass which) { return kNames[static_cast<std::size_t>(which)].name; }
const char* meaning(StimulusClass which) { return kNames[static_cast<std::size_t>(which)].meaning; }

StimulusClass stimulus_class_from(const std::string& name) {
  std::string known;
  for (const auto& entry : kNames) {
    if (name == entry.name) return entry.which;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw_usage({.where = "--class",
               .what = "unknown stimulus class '" + name + "'",
               .expected = "all, " + known,
               .got = {},
               .fix = "see docs/verify.md for what each class covers"});
}

Stimulus make_stimulus(const cmodel::Config& config, StimulusClass which, std::uint64_t seed, std::uint64_t splats) {
  return Generator(config, which, seed).make(splats);
}

}  // namespace fastsplat::testbench
