// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/violations.hpp"

#include <bit>

#include "cmodel/stream/records.hpp"
#include "testbench/stimulus/stimulus_tables.hpp"

namespace fastsplat::testbench {
namespace {

using cmodel::Beat;
using cmodel::Opcode;
using cmodel::StreamRule;
namespace layout = cmodel::layout;

class List {
 public:
  List(const cmodel::Config& config, const Beats& beats)
      : config_(config), beats_(beats), records_(records_of(beats)) {}

  std::vector<Violation> take() && { return std::move(out_); }

  void all() {
    opcodes();
    order();
    reserved();
    frame();
    tables();
    words();
    tile();
    sheet();
    splat();
    ellipse();
    ends();
    if (config_.classifies()) densities();
  }

 private:
  void add(StreamRule rule, std::string name, std::function<void(Beats&)> commit) {
    out_.push_back({std::move(name), rule, std::move(commit)});
  }
  /// The beat of the record, `nth` of its kind.
  std::size_t at(Opcode opcode, std::size_t nth = 0) const {
    for (const Record& record : records_) {
      if (record.opcode == opcode && nth-- == 0) return record.at;
    }
    return beats_.size();  // the stream lacks it: nothing is changed
  }
  std::size_t table(cmodel::Table which) const {
    for (const Record& record : records_) {
      if (record.opcode == Opcode::LoadTable &&
          get(beats_[record.at], layout::kTableId) == static_cast<std::int64_t>(which))
        return record.at;
    }
    return beats_.size();
  }
  void change(StreamRule rule, const std::string& name, std::size_t beat, const cmodel::Field& field,
              std::uint64_t value) {
    if (beat < beats_.size()) add(rule, name, [=](Beats& b) { overwrite(b[beat], field, value); });
  }
  /// One more and one less: a check with an inequality accepts one of them.
  void beside(StreamRule rule, const std::string& name, std::size_t beat, const cmodel::Field& field) {
    if (beat >= beats_.size()) return;
    const auto right = static_cast<std::uint64_t>(get(beats_[beat], field));
    change(rule, name + " one more", beat, field, right + 1);
    change(rule, name + " one less", beat, field, right - 1);
  }
  /// The same of counts of splats and of tags: for a device that culls, higher ones mean splats that were not sent.
  void counted(StreamRule rule, const std::string& name, std::size_t beat, const cmodel::Field& field) {
    if (!config_.culls()) return beside(rule, name, beat, field);
    if (beat < beats_.size() && get(beats_[beat], field) > 0)
      change(rule, name + " one less", beat, field, static_cast<std::uint64_t>(get(beats_[beat], field)) - 1);
  }
  /// One side 0, the other unchanged, small, large and largest: a check of their product, sum or bits is not enough.
  void without_a_side(StreamRule rule, const std::string& name, std::size_t beat, const cmodel::Field& width,
                      const cmodel::Field& height) {
    change(rule, name + " without width", beat, width, 0);
    change(rule, name + " without height", beat, height, 0);
    if (beat >= beats_.size()) return;
    for (const std::uint64_t other : {0x1U, 0x8000U, 0xffffU}) {
      add(rule, name + " of 0 x " + std::to_string(other),
          [=](Beats& b) { overwrite(b[beat], width, 0), overwrite(b[beat], height, other); });
      add(rule, name + " of " + std::to_string(other) + " x 0",
          [=](Beats& b) { overwrite(b[beat], width, other), overwrite(b[beat], height, 0); });
    }
  }
  void word(StreamRule rule, const std::string& name, std::size_t beat, std::size_t which, std::uint32_t value) {
    if (beat < beats_.size()) add(rule, name, [=](Beats& b) { b[beat][which] = value; });
  }
  void copy(StreamRule rule, const std::string& name, std::size_t from, std::size_t before) {
    if (from < beats_.size() && before < beats_.size())
      add(rule, name, [=](Beats& b) { b.insert(b.begin() + static_cast<std::ptrdiff_t>(before), Beat(b[from])); });
  }
  void erase(StreamRule rule, const std::string& name, std::size_t from, std::size_t count) {
    if (from < beats_.size())
      add(rule, name, [=](Beats& b) {
        const auto first = b.begin() + static_cast<std::ptrdiff_t>(from);
        b.erase(first, first + static_cast<std::ptrdiff_t>(count));
      });
  }
  std::size_t payload(std::size_t header) const { return cmodel::announced_beats(beats_[header]); }

  void opcodes() {
    for (const Opcode opcode :
         {Opcode::BeginFrame, Opcode::LoadTable, Opcode::BeginTile, Opcode::Splat, Opcode::EndFrame})
      change(StreamRule::Opcode, "opcode 0x" + std::to_string(static_cast<int>(opcode)) + " with a stray bit",
             at(opcode), layout::kOpcode, static_cast<std::uint64_t>(opcode) ^ 0x80);
  }

  void order() {
    const auto rule = StreamRule::Order;
    const std::size_t tile = at(Opcode::BeginTile), sheet = at(Opcode::BeginSheet), splat = at(Opcode::Splat),
                      cull = at(Opcode::CullBlock), end_sheet = at(Opcode::EndSheet), end_tile = at(Opcode::EndTile),
                      end_frame = at(Opcode::EndFrame), load = at(Opcode::LoadTable);
    erase(rule, "no begin_frame", 0, 1);
    copy(rule, "begin_frame twice", 0, 1);
    copy(rule, "begin_frame in a sheet", 0, splat);
    copy(rule, "load_table in a tile", load, tile + 1);
    copy(rule, "load_table after a tile", load, end_tile + 1);
    copy(rule, "begin_tile in a tile", tile, tile + 1);
    copy(rule, "begin_tile in a sheet", tile, splat);
    copy(rule, "begin_sheet outside a tile", sheet, tile);
    copy(rule, "begin_sheet in a sheet", sheet, sheet + 1);
    copy(rule, "splat outside a sheet", splat, sheet);
    copy(rule, "splat outside a tile", splat, tile);
    copy(rule, "cull_block outside a sheet", cull, sheet);
    copy(rule, "end_sheet twice", end_sheet, end_sheet + 1);
    copy(rule, "end_tile in a sheet", end_tile, splat);
    copy(rule, "end_tile outside a tile", end_tile, tile);
    copy(rule, "end_frame in a tile", end_frame, tile + 1);
    copy(rule, "end_frame in a sheet", end_frame, splat);
  }

  void reserved() {
    for (const auto& record : cmodel::record_layouts()) {
      const std::size_t beat = at(record.opcode);
      if (beat == beats_.size()) continue;
      const Beat used = used_bits(record);
      for (std::size_t i = 0; i < used.size(); ++i) {
        const std::uint32_t free = ~used[i];
        if (free == 0) continue;
        for (const std::uint32_t bit : {free & (~free + 1), std::bit_floor(free)})
          add(StreamRule::Reserved,
              std::string(record.name) + " w" + std::to_string(i) + " bit " + std::to_string(std::countr_zero(bit)),
              [=](Beats& b) { b[beat][i] |= bit; });
      }
    }
  }

  void frame() {
    beside(StreamRule::Format, "magic", 0, layout::kFrameMagic);
    beside(StreamRule::Format, "version", 0, layout::kFrameVersion);
    beside(StreamRule::Configuration, "hash low", 0, layout::kFrameHashLow);
    beside(StreamRule::Configuration, "hash high", 0, layout::kFrameHashHigh);
    without_a_side(StreamRule::Image, "image", 0, layout::kFrameWidth, layout::kFrameHeight);
  }

  void tables() {
    const auto rule = StreamRule::Table;
    const std::size_t rlut = table(cmodel::Table::Rlut), radial = table(cmodel::Table::Radial),
                      factor = table(cmodel::Table::Factor);
    change(rule, "table 3", rlut, layout::kTableId, 3);
    change(rule, "table 255", radial, layout::kTableId, 255);
    change(rule, "set above the last", rlut, layout::kTableSet, static_cast<std::uint64_t>(config_.rlut_sets));
    change(rule, "set 2^31", rlut, layout::kTableSet, 1ULL << 31);
    change(rule, "rho 0", rlut, layout::kTableRho, 0);
    change(rule, "rho above the largest", rlut, layout::kTableRho,
           static_cast<std::uint64_t>(config_.rlut_columns) * static_cast<std::uint64_t>(config_.grid()) / 2 + 1);
    change(rule, "rho 2^31 + 1", rlut, layout::kTableRho, (1ULL << 31) + 1);
    if (rlut < beats_.size())
      add(rule, "rho 0 with no words",
          [=](Beats& b) { overwrite(b[rlut], layout::kTableRho, 0), overwrite(b[rlut], layout::kTableWords, 0); });
    // Bits beyond the width of a column's number.
    for (int bit = std::bit_width(static_cast<std::uint32_t>(config_.rlut_columns)); bit < 32; ++bit)
      change(rule, "base 2^" + std::to_string(bit), rlut, layout::kTableBase, 1ULL << bit);
    change(rule, "base between lanes", rlut, layout::kTableBase, 1);
    change(rule, "base at the end", rlut, layout::kTableBase, static_cast<std::uint64_t>(config_.rlut_columns));
    change(rule, "base near 2^32", rlut, layout::kTableBase, (1ULL << 32) - static_cast<std::uint64_t>(config_.lanes));
    for (const auto& [name, beat] :
         {std::pair{"RLUT", rlut}, std::pair{"RADIAL", radial}, std::pair{"FACTOR", factor}}) {
      beside(rule, std::string(name) + " words", beat, layout::kTableWords);
      change(rule, std::string(name) + " words 0", beat, layout::kTableWords, 0);
      if (beat == rlut) continue;
      change(rule, std::string(name) + " with a set", beat, layout::kTableSet, 1);
      change(rule, std::string(name) + " with a rho", beat, layout::kTableRho, 1);
      change(rule, std::string(name) + " with a base", beat, layout::kTableBase,
             static_cast<std::uint64_t>(config_.lanes));
    }
    const std::size_t tile = at(Opcode::BeginTile);
    if (tile == beats_.size()) return;
    for (const auto& [name, which] :
         {std::pair{"RADIAL", cmodel::Table::Radial}, std::pair{"FACTOR", cmodel::Table::Factor}}) {
      add(StreamRule::Loaded, std::string("tile without ") + name, [table = which](Beats& b) {
        for (std::size_t i = b.size(); i-- > 0;) {  // all of them
          const auto records = records_of(b);
          for (const Record& record : records) {
            if (record.at != i || record.opcode != Opcode::LoadTable ||
                get(b[i], layout::kTableId) != static_cast<std::int64_t>(table))
              continue;
            const auto first = b.begin() + static_cast<std::ptrdiff_t>(i);
            const std::size_t count = 1 + cmodel::announced_beats(b[i]);
            b.erase(first, first + static_cast<std::ptrdiff_t>(count));
            break;
          }
        }
      });
    }
  }

  void words() {
    const auto rule = StreamRule::Words;
    const auto each = [&](const char* name, std::size_t header, std::int64_t most) {
      if (header >= beats_.size()) return;
      const std::size_t last = header + payload(header), words = cmodel::announced_words(beats_[header]);
      const auto above = static_cast<std::uint32_t>(most + 1);
      for (std::size_t i = 0; i < std::min(words, cmodel::kBeatWords); ++i)
        word(rule, std::string(name) + " word " + std::to_string(i) + " too large", header + 1, i, above);
      word(rule, std::string(name) + " word 2^31", header + 1, 0, 1U << 31);
      word(rule, std::string(name) + " last word too large", last, (words - 1) % cmodel::kBeatWords, above);
      for (std::size_t i = words % cmodel::kBeatWords; i != 0 && i < cmodel::kBeatWords; ++i)
        word(rule, std::string(name) + " padding " + std::to_string(i), last, i, 1);
    };
    each("RLUT", table(cmodel::Table::Rlut), config_.rlut_rim());
    each("RADIAL", table(cmodel::Table::Radial), config_.weight_format().max);
    const std::size_t factor = table(cmodel::Table::Factor);
    each("FACTOR", factor, config_.factor_format().max);
    if (factor >= beats_.size()) return;
    const std::size_t count = cmodel::announced_words(beats_[factor]);
    for (std::size_t i = 1; i < count; ++i) {
      const auto& before = beats_[factor + 1 + (i - 1) / cmodel::kBeatWords][(i - 1) % cmodel::kBeatWords];
      if (before >= static_cast<std::uint32_t>(config_.factor_format().max)) continue;
      word(rule, "FACTOR rises at " + std::to_string(i), factor + 1 + i / cmodel::kBeatWords, i % cmodel::kBeatWords,
           before + 1);
    }
  }

  void tile() {
    const auto rule = StreamRule::Tile;
    const std::size_t tile = at(Opcode::BeginTile);
    if (tile == beats_.size()) return;
    const auto& frame = beats_[0];
    const auto width = get(beats_[tile], layout::kTileWidth), height = get(beats_[tile], layout::kTileHeight);
    for (const std::uint64_t mode : {3U, 6U, 7U})
      change(rule, "mode " + std::to_string(mode), tile, layout::kTileMode, mode);
    change(rule, "tile number beyond the count", tile, layout::kTileNumber,
           static_cast<std::uint64_t>(get(frame, layout::kFrameTiles)));
    change(rule, "tile number 2^32 - 1", tile, layout::kTileNumber, 0xffffffffU);
    without_a_side(rule, "tile", tile, layout::kTileWidth, layout::kTileHeight);
    // An image that would hold it: only the tile's own limit refuses it.
    add(rule, "tile too wide", [=, w = config_.tile_width](Beats& b) {
      overwrite(b[0], layout::kFrameWidth, 0xffff);
      overwrite(b[tile], layout::kTileWidth, static_cast<std::uint64_t>(w) + 1);
    });
    add(rule, "tile too high", [=, h = config_.tile_height](Beats& b) {
      overwrite(b[0], layout::kFrameHeight, 0xffff);
      overwrite(b[tile], layout::kTileHeight, static_cast<std::uint64_t>(h) + 1);
    });
    for (const std::uint64_t far : {0xffffffffULL, 0x80000000ULL, 0x7fffffffULL, 0x10000ULL}) {
      change(rule, "tile x " + std::to_string(far), tile, layout::kTileX, far);
      change(rule, "tile y " + std::to_string(far), tile, layout::kTileY, far);
    }
    smaller_image("narrower", layout::kFrameWidth, layout::kTileX, tile, static_cast<std::uint64_t>(width));
    smaller_image("lower", layout::kFrameHeight, layout::kTileY, tile, static_cast<std::uint64_t>(height));
    change(rule, "tile right of the image", tile, layout::kTileX,
           static_cast<std::uint64_t>(get(frame, layout::kFrameWidth) - width + 1));
    change(rule, "tile below the image", tile, layout::kTileY,
           static_cast<std::uint64_t>(get(frame, layout::kFrameHeight) - height + 1));
  }

  /// An image smaller than the tile, which lies at its edge: the difference of the two is below 0.
  void smaller_image(const std::string& how, const cmodel::Field& side, const cmodel::Field& begin, std::size_t tile,
                     std::uint64_t most) {
    for (const std::uint64_t size : {most / 2, most - 1}) {
      if (size > 0)
        add(StreamRule::Tile, "image " + how + " than the tile: " + std::to_string(size),
            [=](Beats& b) { overwrite(b[0], side, size), overwrite(b[tile], begin, 0); });
    }
  }

  void sheet() {
    // In the first tile that has two.
    std::size_t first = beats_.size();
    for (const Record& record : records_) {
      if (record.opcode == Opcode::BeginTile) first = beats_.size();
      if (record.opcode != Opcode::BeginSheet) continue;
      if (first < beats_.size()) {
        const auto number = static_cast<std::uint64_t>(get(beats_[first], layout::kSheetNumber));
        change(StreamRule::Sheet, "sheet number again", record.at, layout::kSheetNumber, number);
        if (number > 0) change(StreamRule::Sheet, "sheet number falls", record.at, layout::kSheetNumber, number - 1);
        return;
      }
      first = record.at;
    }
  }

  /// Tables of densities and the requirements of density tiles, for any tile of the stream.
  void densities() {
    using cmodel::Table;
    const std::size_t tile = at(Opcode::BeginTile), sheet = at(Opcode::BeginSheet);
    const auto of_densities = [=](Beats& b) {
      overwrite(b[tile], layout::kTileMode, 8);
      overwrite(b[tile], layout::kTileWidth, 1);
      overwrite(b[tile], layout::kTileHeight, 1);
    };
    for (const auto& [name, which] :
         {std::pair{"CLASSIFY", Table::Classify}, std::pair{"ROOT", Table::Root}, std::pair{"GLINT", Table::Glint},
          std::pair{"LIGHTING", Table::Lighting}, std::pair{"SHEETS", Table::Sheets}}) {
      const std::size_t beat = table(which);
      if (beat == beats_.size()) continue;
      beside(StreamRule::Table, std::string(name) + " words", beat, layout::kTableWords);
      change(StreamRule::Table, std::string(name) + " words 0", beat, layout::kTableWords, 0);
      change(StreamRule::Table, std::string(name) + " with a set", beat, layout::kTableSet, 1);
      change(StreamRule::Table, std::string(name) + " with a rho", beat, layout::kTableRho, 1);
      change(StreamRule::Table, std::string(name) + " with a base", beat, layout::kTableBase,
             static_cast<std::uint64_t>(config_.lanes));
      add(StreamRule::Loaded, std::string("no ") + name, [=, count = 1 + payload(beat)](Beats& b) {
        of_densities(b);
        const auto first = b.begin() + static_cast<std::ptrdiff_t>(beat);
        b.erase(first, first + static_cast<std::ptrdiff_t>(count));
      });
    }
    change(StreamRule::Table, "SHEETS of too many", table(Table::Sheets), layout::kTableWords, 2 * 4096 + 2);
    // The most words make a legal header: its first word is what is refused.
    if (const std::size_t beat = table(Table::Sheets); beat < beats_.size())
      add(StreamRule::Words, "SHEETS of the most, a word too large",
          [=](Beats& b) { overwrite(b[beat], layout::kTableWords, 2 * 4096), b[beat + 1][0] = 4097; });
    density_words();
    // An unknown mode is reported before the tables it would need.
    if (const std::size_t beat = table(Table::Root); beat < beats_.size())
      add(StreamRule::Tile, "mode 10 without ROOT", [=, count = 1 + payload(beat)](Beats& b) {
        overwrite(b[tile], layout::kTileMode, 10);
        const auto first = b.begin() + static_cast<std::ptrdiff_t>(beat);
        b.erase(first, first + static_cast<std::ptrdiff_t>(count));
      });
    for (const std::uint64_t mode : {10U, 12U, 15U})
      change(StreamRule::Tile, "mode " + std::to_string(mode), tile, layout::kTileMode, mode);
    for (const auto& [side, most] :
         {std::pair{layout::kTileWidth, config_.tile_width}, std::pair{layout::kTileHeight, config_.tile_height}}) {
      add(StreamRule::Tile, "tile of densities without room for a halo", [=, w = side, m = most](Beats& b) {
        of_densities(b);
        overwrite(b[0], layout::kFrameWidth, 0xffff);
        overwrite(b[0], layout::kFrameHeight, 0xffff);
        overwrite(b[tile], w, static_cast<std::uint64_t>(m) - 1);
      });
    }
    if (sheet == beats_.size()) return;
    for (const std::uint64_t number : {std::uint64_t{kScaledSheets}, std::uint64_t{0xffffffffU}}) {
      add(StreamRule::Sheet, "sheet without scales " + std::to_string(number), [=](Beats& b) {
        of_densities(b);
        overwrite(b[sheet], layout::kSheetNumber, number);
      });
    }
  }

  void density_words() {
    using cmodel::Table;
    const auto above = [&](Table which, const char* name, std::size_t at, std::uint32_t value) {
      const std::size_t header = table(which);
      if (header == beats_.size()) return;
      word(StreamRule::Words, std::string(name) + " word " + std::to_string(at) + " " + std::to_string(value),
           header + 1 + at / cmodel::kBeatWords, at % cmodel::kBeatWords, value);
    };
    const auto tau = static_cast<std::uint32_t>(config_.sheet_format().max) + 1;
    for (const std::size_t i : {0U, 1U, 2U, 4U, 9U}) above(Table::Classify, "CLASSIFY", i, 16385);
    for (const std::size_t i : {3U, 7U, 11U}) above(Table::Classify, "CLASSIFY", i, tau);
    for (const std::size_t i : {0U, 5U, 96U}) above(Table::Root, "ROOT", i, 16385);
    for (const std::size_t i : {0U, 5U, 128U}) above(Table::Glint, "GLINT", i, 4097);
    for (const std::size_t i : {0U, 1U, 2U, 3U, 4U, 5U}) {
      for (const std::uint32_t value : {16385U, 0x80000000U, 0xffffbfffU}) above(Table::Lighting, "LIGHTING", i, value);
    }
    for (const std::size_t i : {6U, 7U, 8U}) {
      for (const std::uint32_t value : {65536U, 0x80000000U}) above(Table::Lighting, "LIGHTING", i, value);
    }
    for (const std::size_t i : {0U, 2U, 10U}) {
      above(Table::Sheets, "SHEETS", i, 4097);
      above(Table::Sheets, "SHEETS", i, 4097U << 16);
    }
    for (const std::size_t i : {97U, 103U}) above(Table::Root, "ROOT padding", i, 1);
    for (const std::size_t i : {13U, 15U}) above(Table::Lighting, "LIGHTING padding", i, 1);
  }

  void not_loaded(std::int64_t set) {
    std::vector<std::size_t> loads;
    for (const Record& record : records_) {
      if (record.opcode == Opcode::LoadTable && get(beats_[record.at], layout::kTableId) == 0 &&
          get(beats_[record.at], layout::kTableSet) == set)
        loads.push_back(record.at);
    }
    if (loads.size() == 1) erase(StreamRule::Set, "set not loaded", loads[0], 1 + payload(loads[0]));
  }

  void splat() {
    const std::size_t splat = at(Opcode::Splat), later = at(Opcode::Splat, 3), cull = at(Opcode::CullBlock);
    change(StreamRule::Set, "set above the last", splat, layout::kSplatSet,
           static_cast<std::uint64_t>(config_.rlut_sets));
    change(StreamRule::Set, "set 255", splat, layout::kSplatSet, 255);
    if (splat < beats_.size()) not_loaded(get(beats_[splat], layout::kSplatSet));
    const auto positions = config_.position_format();
    for (const auto& [name, field] : {std::pair{"x", layout::kSplatX}, std::pair{"y", layout::kSplatY}}) {
      for (const std::int64_t value :
           {positions.max + 1, positions.min - 1, std::int64_t{0x7fffffff}, -std::int64_t{0x80000000}})
        change(StreamRule::Range, std::string(name) + " " + std::to_string(value), splat, field,
               static_cast<std::uint64_t>(value) & 0xffffffffU);
    }
    if (config_.colour_bits() < 16) {
      for (const auto& field : {layout::kSplatR, layout::kSplatG, layout::kSplatB, layout::kSplatTau})
        change(StreamRule::Range, "colour at w" + std::to_string(field.word), splat, field,
               1ULL << config_.colour_bits());
    }
    counted(StreamRule::Tag, "tag", later, layout::kSplatTag);
    if (!config_.culls()) beside(StreamRule::Tag, "first tag", splat, layout::kSplatTag);
    without_a_side(StreamRule::Cull, "cull_block", cull, layout::kCullWidth, layout::kCullHeight);
  }

  void ellipse() {
    const std::size_t ellipse = at(Opcode::Ellipse);
    if (ellipse == beats_.size()) return;
    const auto positions = config_.position_format();
    if (config_.position_int_bits + config_.position_frac_bits < cmodel::kEllipsePositionBits) {
      for (const auto& [name, field] : {std::pair{"x", layout::kEllipseX}, std::pair{"y", layout::kEllipseY}}) {
        for (const std::int64_t value : {positions.max + 1, positions.min - 1})
          change(StreamRule::Range, std::string("ellipse ") + name + " " + std::to_string(value), ellipse, field,
                 static_cast<std::uint64_t>(value) & ((1ULL << cmodel::kEllipsePositionBits) - 1));
      }
    }
    if (config_.colour_bits() < 16) {
      for (const auto& field : {layout::kEllipseR, layout::kEllipseG, layout::kEllipseBlue, layout::kEllipseTau})
        change(StreamRule::Range, "ellipse colour at w" + std::to_string(field.word), ellipse, field,
               1ULL << config_.colour_bits());
    }
    counted(StreamRule::Tag, "ellipse tag", ellipse, layout::kEllipseTag);
    copy(StreamRule::Order, "ellipse outside a sheet", ellipse, at(Opcode::BeginSheet));
  }

  void ends() {
    beside(StreamRule::EndNumber, "end of another sheet", at(Opcode::EndSheet), layout::kEndSheetNumber);
    counted(StreamRule::EndCount, "splats of the sheet", at(Opcode::EndSheet), layout::kEndSheetSplats);
    beside(StreamRule::EndNumber, "end of another tile", at(Opcode::EndTile), layout::kEndTileNumber);
    beside(StreamRule::EndCount, "sheets of the tile", at(Opcode::EndTile), layout::kEndTileSheets);
  }

  const cmodel::Config& config_;
  const Beats& beats_;
  std::vector<Record> records_;
  std::vector<Violation> out_;
};

}  // namespace

std::vector<Violation> violations(const cmodel::Config& config, const Beats& beats) {
  List list(config, beats);
  list.all();
  return std::move(list).take();
}

}  // namespace fastsplat::testbench
