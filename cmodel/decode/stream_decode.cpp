// SPDX-License-Identifier: Apache-2.0
#include "cmodel/decode/stream_decode.hpp"

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "cmodel/classify/classify_tables.hpp"
#include "cmodel/classify/pattern_tables.hpp"
#include "cmodel/cull/cull_unit.hpp"
#include "cmodel/numbers/index_set.hpp"
#include "cmodel/numbers/window_geometry.hpp"
#include "cmodel/splat/ellipse_rule.hpp"
#include "cmodel/splat/ellipse_unit.hpp"
#include "cmodel/stream/stream_advice.hpp"

namespace fastsplat::cmodel {
namespace {

std::string at_least(std::int64_t bound) { return "at least " + std::to_string(bound); }
std::string at_most(std::int64_t bound) { return "at most " + std::to_string(bound); }

/// Bits of loaded_: the tables of densities, and those of patterns.
constexpr std::uint32_t kClassifyTables = 0xF8, kPatternTables = 0x300;

bool of_patterns(Table table) { return table > Table::Sheets; }

/// The tables of a device, as text for a refusal.
std::string known_tables(const Config& config) {
  if (!config.has_patterns()) return config.classifies() ? "0 to 7" : "0, 1 or 2";
  return config.classifies() ? "0 to 9" : "0, 1, 2, 8 or 9";
}

std::string hex(std::uint32_t word) { return "0x" + hash_text(word).substr(8); }
std::string hex_byte(std::uint32_t byte) { return "0x" + hash_text(byte).substr(14); }

}  // namespace

StreamDecode::StreamDecode(const Config& config, StreamScope scope)
    : config_(config),
      scope_(scope),
      config_hash_(config_hash(config)),
      sets_loaded_(static_cast<std::size_t>(config.rlut_sets), false),
      jumps_(scope == StreamScope::Subset && config.culls()),
      snap_(config),
      footprints_(static_cast<std::size_t>(config.rlut_sets)) {}

void StreamDecode::refuse(const std::string& what, const std::string& expected, const std::string& got,
                          const char* fix) const {
  throw StreamRefusal(rule_, beats_,
                      {.where = beat_place(beats_),
                       .what = what,
                       .expected = expected,
                       .got = got,
                       .fix = fix == nullptr ? kMiswrittenStream : fix});
}

void StreamDecode::expect(bool holds, const char* what, std::int64_t expected, std::int64_t got) const {
  if (!holds) refuse(what, std::to_string(expected), std::to_string(got));
}

void StreamDecode::expect_least(std::int64_t got, std::int64_t least, const char* what) const {
  if (got < least) refuse(what, at_least(least), std::to_string(got));
}

void StreamDecode::expect_most(std::int64_t got, std::int64_t most, const char* what) const {
  if (got > most) refuse(what, at_most(most), std::to_string(got));
}

void StreamDecode::expect_within(std::int64_t got, std::int64_t least, std::int64_t most, const char* what) const {
  if (got < least || got > most) refuse(what, std::to_string(least) + ".." + std::to_string(most), std::to_string(got));
}

void StreamDecode::check_reserved(const Beat& beat, const RecordLayout& record) const {
  rule_ = StreamRule::Reserved;
  const Beat used = used_bits(record);
  for (std::size_t i = 0; i < beat.size(); ++i) {
    const std::uint32_t stray = beat[i] & ~used[i];
    if (stray != 0) refuse("reserved bits are set", "0 in w" + std::to_string(i), hex(stray));
  }
}

const char* StreamDecode::wanted() const {
  switch (state_) {
    case State::Start:
      return "begin_frame";
    case State::Tables:
      return tiles_seen_ == 0 ? "load_table, begin_tile or end_frame" : "begin_tile or end_frame";
    case State::Payload:
      return "a beat of table words";
    case State::Tile:
      return "begin_sheet or end_tile";
    case State::Sheet:
      return "splat, cull_block or end_sheet";
    case State::Ended:
      return "nothing after end_frame";
  }
  return "";
}

void StreamDecode::check_order(Opcode opcode, const char* name) const {
  rule_ = StreamRule::Order;
  bool ok = false;
  switch (state_) {
    case State::Start:
      ok = opcode == Opcode::BeginFrame;
      break;
    case State::Tables:
      ok = opcode == Opcode::BeginTile || opcode == Opcode::EndFrame ||
           (opcode == Opcode::LoadTable && tiles_seen_ == 0);
      break;
    case State::Tile:
      ok = opcode == Opcode::BeginSheet || opcode == Opcode::EndTile;
      break;
    case State::Sheet:
      ok = opcode == Opcode::Splat || opcode == Opcode::Ellipse || opcode == Opcode::CullBlock ||
           opcode == Opcode::EndSheet;
      break;
    case State::Ended:
    case State::Payload:
      break;
  }
  if (!ok) refuse("record out of order", wanted(), name);
}

void StreamDecode::check(const BeginFrame& record, const Beat& beat) {
  rule_ = StreamRule::Format;
  if (const auto magic = static_cast<std::uint32_t>(get(beat, layout::kFrameMagic)); magic != kStreamMagic)
    refuse("not a FastSplat stream: wrong magic", hex(kStreamMagic), hex(magic), "name a stream file (.fss)");
  if (const std::int64_t version = get(beat, layout::kFrameVersion); version != kStreamVersion)
    refuse(version_message(version).c_str(), std::to_string(kStreamVersion), std::to_string(version), kOtherVersion);
  rule_ = StreamRule::Configuration;
  if (record.config_hash != config_hash_) {
    refuse("stream was made for another configuration", hash_text(config_hash_) + " (" + config_.name + ")",
           hash_text(record.config_hash), kForeignStream);
  }
  rule_ = StreamRule::Image;
  expect_least(record.width, 1, "empty image width");
  expect_least(record.height, 1, "empty image height");
  frame_ = record;
  state_ = State::Tables;
}

void StreamDecode::check(const LoadTable& header, std::uint32_t words) {
  rule_ = StreamRule::Table;
  std::int64_t expected_words = 0;
  const bool known = of_patterns(header.table) ? config_.has_patterns() && header.table <= Table::Pattern
                                               : config_.classifies() || header.table <= Table::Factor;
  if (!known) refuse("unknown table", known_tables(config_), std::to_string(static_cast<int>(header.table)));
  if (header.table != Table::Rlut) {
    expect(header.radius.set == 0, "set given for a table without sets", 0, header.radius.set);
    expect(header.radius.rho == 0, "rho given for a table without rho", 0, header.radius.rho);
    expect(header.radius.base == 0, "base given for a table without base", 0, header.radius.base);
  }
  switch (header.table) {
    case Table::Rlut: {
      expect_most(header.radius.set, config_.rlut_sets - 1, "radius set above the last");
      expect_least(header.radius.rho, 1, "radius is 0");
      // The columns hold a diameter, so the radius is at most half of them; K steps a pixel.
      expect_most(header.radius.rho, std::int64_t{config_.rlut_columns} * config_.grid() / 2,
                  "radius too large for the RLUT");
      if (!config_.has_columns())
        expect(header.radius.base == 0, "base given for a set without columns", 0, header.radius.base);
      if (header.radius.base % static_cast<std::uint32_t>(config_.lanes) != 0) {
        refuse("first RLUT column is not a multiple of the lanes", "a multiple of " + std::to_string(config_.lanes),
               std::to_string(header.radius.base));
      }
      const std::uint32_t columns = window_geometry(config_, header.radius.rho).padded;
      const std::int64_t end = std::int64_t{header.radius.base} + columns;
      expect_most(end, config_.rlut_columns, "RLUT columns past the end");
      expected_words = set_words(config_, header.radius.rho);
      break;
    }
    case Table::Radial:
      expected_words = config_.radial_words();
      break;
    case Table::Factor:
      expected_words = std::int64_t{config_.opacity_segments} + 1;
      break;
    case Table::Classify:
    case Table::Root:
    case Table::Glint:
    case Table::Lighting:
      expected_words = classify_words(config_, header.table);
      break;
    case Table::Sheets:  // number of sheets depends on the frame
      expect_least(words, classify::kSheetWords, "no scales of sheets");
      expect_most(words, std::int64_t{classify::kSheetWords} << classify::kSheetsBits, "scales of too many sheets");
      expected_words = words - words % classify::kSheetWords;
      break;
    case Table::Nodes:
    case Table::Pattern:
      expected_words = pattern_words(config_, header.table);
      break;
  }
  expect(words == expected_words, "wrong number of table words", expected_words, words);
  words_left_ = words;
  state_ = State::Payload;
}

const Record* StreamDecode::payload(const Beat& beat) {
  rule_ = StreamRule::Words;
  auto& table = std::get<LoadTable>(record_);
  WordRange range;
  switch (table.table) {
    case Table::Rlut:
      break;  // each word has its own range
    case Table::Radial:
      range.most = config_.weight_format().max;
      break;
    case Table::Factor:
      range.most = config_.factor_format().max;
      break;
    case Table::Classify:
    case Table::Root:
    case Table::Glint:
    case Table::Lighting:
    case Table::Sheets:
    case Table::Nodes:
    case Table::Pattern:
      break;  // each word has its own range
  }
  for (const std::uint32_t word : beat) {
    if (words_left_ == 0) {
      expect(word == 0, "padding is not zero", 0, word);
      continue;
    }
    if (table.table == Table::Rlut) range = set_word_range(config_, table.words.size());
    if (of_patterns(table.table))
      range = pattern_word_range(table.table, table.words.size());
    else if (table.table > Table::Factor)
      range = classify_word_range(config_, table.table, table.words.size());
    if (range.least < 0) {
      expect_within(static_cast<std::int32_t>(word), range.least, range.most, "table word out of range");
    } else {
      expect_most(word, range.most, "table word too large");
    }
    if (table.table == Table::Factor && !table.words.empty())
      expect_most(word, table.words.back(), "slab factor table increases");
    if (table.table == Table::Sheets && table.words.size() % classify::kSheetWords == 0) {
      const std::uint32_t most = std::uint32_t{1} << classify::kScale;
      expect_most(word & 0xFFFFU, most, "scale of differences too large");
      expect_most(word >> 16, most, "scale of differences too large");
    }
    table.words.push_back(word);
    --words_left_;
  }
  if (words_left_ > 0) return nullptr;
  if (table.table == Table::Rlut) {
    if (const auto wrong = set_violation(config_, table.words))
      refuse(wrong->what.c_str(), wrong->expected, wrong->got);
  }
  state_ = State::Tables;
  if (table.table == Table::Rlut) {
    sets_loaded_[table.radius.set] = true;
    footprints_[table.radius.set] = {table.radius.rho, window_geometry(config_, table.radius.rho).windows};
  }
  if (table.table == Table::Radial) radial_loaded_ = true;
  if (table.table == Table::Factor) factor_loaded_ = true;
  if (table.table > Table::Factor) loaded_ |= 1U << static_cast<unsigned>(table.table);
  if (table.table == Table::Sheets)
    scaled_sheets_ = static_cast<std::uint32_t>(table.words.size() / classify::kSheetWords);
  return &record_;
}

void StreamDecode::check(const BeginTile& record) {
  rule_ = StreamRule::Loaded;
  if (!radial_loaded_) refuse("the radial table is missing before the first tile", "load_table 1", "begin_tile");
  if (!factor_loaded_) refuse("the slab factor table is missing before the first tile", "load_table 2", "begin_tile");
  const bool densities = config_.classifies() && holds_densities(record.mode);
  if (densities && (loaded_ & kClassifyTables) != kClassifyTables)
    refuse("a density table is missing before the first tile of densities", "load_table 3 to 7", "begin_tile");
  if (const std::uint32_t of_pattern = loaded_ & kPatternTables; of_pattern != 0 && of_pattern != kPatternTables)
    refuse("only one of a pattern's two tables before the first tile", "load_table 8 and 9, or neither", "begin_tile");
  rule_ = StreamRule::Tile;
  if (record.mode > Mode::Sum && !(config_.composite_every_sample != 0 && every_sample(record.mode)) && !densities)
    refuse("unknown mode",
           std::string("0, 1") + (config_.composite_every_sample != 0 ? ", 2, 4" : "") +
               (config_.classifies() ? ", 8" : "") + " or " +
               (config_.classifies()                  ? "9"
                : config_.composite_every_sample != 0 ? "5"
                                                      : "2"),
           std::to_string(static_cast<int>(record.mode)));
  expect_most(std::int64_t{record.tile} + 1, frame_.tiles, "more tiles than announced");
  const int halo = densities ? 2 : 0;  // halo of a pixel on each side
  expect_within(record.width, 1, config_.tile_width - halo, "tile width");
  expect_within(record.height, 1, config_.tile_height - halo, "tile height");
  expect_least(record.x, 0, "tile begins outside the image in x");
  expect_least(record.y, 0, "tile begins outside the image in y");
  const std::int64_t end_x = std::int64_t{record.x} + record.width, end_y = std::int64_t{record.y} + record.height;
  expect_most(end_x, frame_.width, "tile ends outside the image in x");
  expect_most(end_y, frame_.height, "tile ends outside the image in y");
  rule_ = StreamRule::Whole;
  if (scope_ == StreamScope::Whole) expect(record.tile == tiles_seen_, "tiles out of order", tiles_seen_, record.tile);
  tile_ = record.tile;
  in_ = record;
  sets_.clear();
  ++tiles_seen_;
  sheets_seen_ = 0;
  next_tag_ = 0;
  state_ = State::Tile;
}

void StreamDecode::check(const BeginSheet& record) {
  rule_ = StreamRule::Sheet;
  if (sheets_seen_ > 0 && record.sheet <= sheet_)
    refuse("sheet numbers must rise", "more than " + std::to_string(sheet_), std::to_string(record.sheet));
  if (holds_densities(in_.mode))
    expect_most(std::int64_t{record.sheet} + 1, scaled_sheets_, "sheet without scales in load_table 7");
  sheet_ = record.sheet;
  ++sheets_seen_;
  splats_seen_ = 0;
  state_ = State::Sheet;
}

void StreamDecode::check(const SplatRecord& record) {
  rule_ = StreamRule::Set;
  if (record.set >= sets_loaded_.size() || !sets_loaded_[record.set])
    refuse("radius set not loaded", "a loaded radius set", std::to_string(record.set));
  check_splat(record.x, record.y, record.colour, record.tag);
  if (sets_.open() == 0) return;
  const auto [rho, windows] = footprints_[record.set];
  check_announced(record.tag, snap_(record.x, rho).origin, snap_(record.y, rho).origin, windows, windows);
}

void StreamDecode::check_splat(std::int32_t x, std::int32_t y, const std::array<std::uint32_t, 4>& colour,
                               std::uint32_t tag) {
  const Format position = config_.position_format();
  rule_ = StreamRule::Range;
  expect_within(x, position.min, position.max, "x does not fit the position format");
  expect_within(y, position.min, position.max, "y does not fit the position format");
  for (const std::uint32_t word : colour)
    expect_most(word, config_.colour_format().max, "colour does not fit its format");
  rule_ = StreamRule::Tag;
  expect(tag == next_tag_ || (jumps_ && tag > next_tag_), "tags out of order", next_tag_, tag);
  splats_seen_ += tag - next_tag_ + 1;
  next_tag_ = tag + 1;
}

void StreamDecode::check(const EllipseRecord& record) {
  check_splat(record.x, record.y, record.colour, record.tag);
  rule_ = StreamRule::Shape;
  if (const auto wrong = ellipse_violation(config_, record)) refuse(wrong->what.c_str(), wrong->expected, wrong->got);
  if (sets_.open() == 0) return;
  const EllipseWindows& windows = record.windows;
  check_announced(record.tag, ellipse_axis(config_, record.x, windows.left).origin,
                  ellipse_axis(config_, record.y, windows.top).origin, windows.columns, windows.rows);
}

void StreamDecode::check(const CullBlock& record) {
  rule_ = StreamRule::Cull;
  expect_least(record.width, 1, "empty cull block");
  expect_least(record.height, 1, "empty cull block");
  if (config_.culls()) check_announced(record);
}

void StreamDecode::check_announced(const CullBlock& record) {
  rule_ = StreamRule::Promise;
  expect(record.tag == static_cast<std::uint32_t>(next_tag_ + sets_.waiting()),
         "the tag of cull_block differs from that of its first splat",
         static_cast<std::int64_t>(next_tag_ + sets_.waiting()), record.tag);
  // With jumps_ skipped groups show only at the next splat, so their number is not limited (S-cull-11).
  expect_most(jumps_ ? 0 : static_cast<std::int64_t>(sets_.open()) + (record.splats > 0 ? 1 : 0), cull_sets(config_),
              "too many open cull_blocks for the device");
  constexpr std::int64_t kMostAnnounced = std::int64_t{1} << 31;  // tags are compared modulo 2^32
  expect_most((jumps_ ? 0 : std::int64_t{sets_.waiting()}) + record.splats, kMostAnnounced,
              "too many open splats of cull_blocks for the tags");
  sets_.announce(record.tag, record.splats, record);
}

void StreamDecode::check_announced(std::uint32_t tag, std::int32_t x, std::int32_t y, std::uint32_t columns,
                                   std::uint32_t rows) {
  rule_ = StreamRule::Promise;
  const CullBlock* one = sets_.next(tag);
  if (one == nullptr) return;
  const CullBlock& set = *one;
  const std::int64_t lanes = config_.lanes;
  const PixelBox windows = PixelBox{x, y, x + columns * lanes, y + rows * lanes}.clipped(in_.width, in_.height);
  const PixelBox announced = box_of(set);
  if (windows.empty() || announced.contains(windows)) return;
  const auto text = [](const PixelBox& box) {
    return "x " + std::to_string(box.x0) + ".." + std::to_string(box.x1 - 1) + ", y " + std::to_string(box.y0) + ".." +
           std::to_string(box.y1 - 1);
  };
  refuse("splat is outside the rectangle of cull_block " + std::to_string(set.tag), "within " + text(announced),
         text(windows));
}

void StreamDecode::check(const EndSheet& record) {
  const std::uint64_t missing = sets_.waiting();
  rule_ = StreamRule::EndNumber;
  expect(record.sheet == sheet_, "end of another sheet", sheet_, record.sheet);
  rule_ = StreamRule::EndCount;
  expect(record.splats == splats_seen_ || (jumps_ && record.splats > splats_seen_),
         "end_sheet has the wrong number of splats", splats_seen_, record.splats);
  rule_ = StreamRule::Promise;
  next_tag_ += record.splats - splats_seen_;
  if (jumps_) sets_.clear();
  if (missing > 0 && !jumps_) refuse("end_sheet before all splats of cull_block", "none open", std::to_string(missing));
  state_ = State::Tile;
}

void StreamDecode::check(const EndTile& record) {
  rule_ = StreamRule::EndNumber;
  expect(record.tile == tile_, "end of another tile", tile_, record.tile);
  rule_ = StreamRule::EndCount;
  expect(record.sheets == sheets_seen_, "end_tile has the wrong number of sheets", sheets_seen_, record.sheets);
  state_ = State::Tables;
}

void StreamDecode::check(const EndFrame& record) {
  if (scope_ == StreamScope::Whole) {
    rule_ = StreamRule::Whole;
    if (tiles_seen_ != frame_.tiles)
      refuse("tiles missing", std::to_string(frame_.tiles), std::to_string(tiles_seen_), kDamagedStream);
    if (record.beats != beats_) {
      refuse("end_frame has the wrong number of beats", std::to_string(beats_), std::to_string(record.beats),
             kDamagedStream);
    }
    if (record.crc != crc_.value())
      refuse("corrupt: wrong checksum of the preceding beats", hex(crc_.value()), hex(record.crc), kDamagedStream);
  }
  state_ = State::Ended;
}

const Record* StreamDecode::feed(const Beat& beat) {
  const Record* done = nullptr;
  if (state_ == State::Payload) {
    done = payload(beat);
  } else if (state_ == State::Sheet && get(beat, layout::kOpcode) == static_cast<std::int64_t>(Opcode::Splat)) {
    // A splat's w0[31:16], w6 and w7 have no name: a fast check for the common case.
    if (((beat[0] >> 16) | beat[6] | beat[7]) != 0)
      check_reserved(beat, *find_layout(static_cast<std::uint32_t>(Opcode::Splat)));
    record_ = to_splat(beat);
    check(std::get<SplatRecord>(record_));
    done = &record_;
  } else {
    const auto opcode = static_cast<std::uint32_t>(get(beat, layout::kOpcode));
    const RecordLayout* found = find_layout(opcode);
    rule_ = StreamRule::Opcode;
    if (found != nullptr && found->opcode == Opcode::Ellipse && !config_.has_ellipses()) {
      refuse("this configuration does not support ellipses", "ellipse.frac_bits above 0", "ellipse", kForeignStream);
    }
    if (found == nullptr)
      refuse("unknown opcode",
             state_ == State::Start
                 ? "a FastSplat stream (begin_frame, " + hex_byte(static_cast<std::uint32_t>(Opcode::BeginFrame)) + ")"
                 : "a known opcode",
             hex_byte(opcode), state_ == State::Start ? "name a stream file (.fss)" : kDamagedStream);
    check_order(found->opcode, found->name);
    check_reserved(beat, *found);
    record_ = from_beat(beat);
    if (auto* table = std::get_if<LoadTable>(&record_)) {
      check(*table, announced_words(beat));
    } else if (auto* frame = std::get_if<BeginFrame>(&record_)) {
      check(*frame, beat);
      done = &record_;
    } else {
      std::visit(
          [this](const auto& record) {
            using R = std::decay_t<decltype(record)>;
            if constexpr (!std::is_same_v<R, LoadTable> && !std::is_same_v<R, BeginFrame>) check(record);
          },
          record_);
      done = &record_;
    }
  }
  ++beats_;
  if (scope_ == StreamScope::Whole) crc_.add(beat);
  return done;
}

void StreamDecode::finish() const {
  rule_ = StreamRule::Whole;
  if (scope_ == StreamScope::Whole && state_ != State::Ended)
    refuse("stream ends too early", wanted(), "end of data", kDamagedStream);
  if (scope_ == StreamScope::Subset && state_ != State::Tables && state_ != State::Start && state_ != State::Ended)
    refuse("stream ends inside a tile or table", wanted(), "end of data", kDamagedStream);
}

}  // namespace fastsplat::cmodel
