#include "cmodel/stream_decode.hpp"

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "cmodel/window_geometry.hpp"

namespace fastsplat::cmodel {

StreamDecode::StreamDecode(const Config& config, StreamScope scope)
    : config_(config),
      scope_(scope),
      config_hash_(config_hash(config)),
      sets_loaded_(static_cast<std::size_t>(config.rlut_sets), false) {}

void StreamDecode::refuse(const char* what, const std::string& expected, const std::string& got) const {
  throw_input({.where = "beat " + std::to_string(beats_) + " (byte offset " + std::to_string(beats_ * kBeatBytes) + ")",
               .what = what,
               .expected = expected,
               .got = got,
               .fix = "record the stream again with this configuration"});
}

void StreamDecode::expect(bool holds, const char* what, std::int64_t expected, std::int64_t got) const {
  if (!holds) refuse(what, std::to_string(expected), std::to_string(got));
}

void StreamDecode::expect_within(std::int64_t got, std::int64_t least, std::int64_t most, const char* what) const {
  if (got < least || got > most) refuse(what, std::to_string(least) + ".." + std::to_string(most), std::to_string(got));
}

void StreamDecode::check_reserved(const Beat& beat, const RecordLayout& record) const {
  Beat used{};
  used[0] = field_mask(layout::kOpcode);
  for (const auto& named : record.fields) used[static_cast<std::size_t>(named.field.word)] |= field_mask(named.field);
  for (std::size_t i = 0; i < beat.size(); ++i) {
    const std::uint32_t stray = beat[i] & ~used[i];
    if (stray != 0) refuse("reserved bits are set", "0 in w" + std::to_string(i), std::to_string(stray));
  }
}

void StreamDecode::check_order(Opcode opcode, const char* name) const {
  const char* wanted = "";
  bool ok = false;
  switch (state_) {
    case State::Start:
      wanted = "begin_frame";
      ok = opcode == Opcode::BeginFrame;
      break;
    case State::Tables:
      wanted = "load_table, begin_tile or end_frame";
      ok = opcode == Opcode::BeginTile || opcode == Opcode::EndFrame ||
           (opcode == Opcode::LoadTable && tiles_seen_ == 0);
      break;
    case State::Tile:
      wanted = "begin_sheet or end_tile";
      ok = opcode == Opcode::BeginSheet || opcode == Opcode::EndTile;
      break;
    case State::Sheet:
      wanted = "splat, cull_block or end_sheet";
      ok = opcode == Opcode::Splat || opcode == Opcode::CullBlock || opcode == Opcode::EndSheet;
      break;
    case State::Ended:
      wanted = "nothing after end_frame";
      break;
    case State::Payload:
      break;
  }
  if (!ok) refuse("record out of order", wanted, name);
}

void StreamDecode::check(const BeginFrame& record, const Beat& beat) {
  expect(get(beat, layout::kFrameMagic) == kStreamMagic, "not a FastSplat stream: wrong magic", kStreamMagic,
         get(beat, layout::kFrameMagic));
  expect(get(beat, layout::kFrameVersion) == kStreamVersion, "unknown stream version", kStreamVersion,
         get(beat, layout::kFrameVersion));
  if (record.config_hash != config_hash_) {
    refuse("stream was made for another configuration", hash_text(config_hash_) + " (" + config_.name + ")",
           hash_text(record.config_hash));
  }
  expect(record.width >= 1, "empty image width", 1, record.width);
  expect(record.height >= 1, "empty image height", 1, record.height);
  frame_ = record;
  state_ = State::Tables;
}

void StreamDecode::check(const LoadTable& header, std::uint32_t words) {
  std::int64_t expected_words = 0;
  if (header.table != Table::Rlut) {
    expect(header.radius.set == 0, "set of a table that has none", 0, header.radius.set);
    expect(header.radius.rho == 0, "rho of a table that has none", 0, header.radius.rho);
    expect(header.radius.base == 0, "base of a table that has none", 0, header.radius.base);
  }
  switch (header.table) {
    case Table::Rlut: {
      expect(header.radius.set < static_cast<std::uint32_t>(config_.rlut_sets), "radius set above the last",
             config_.rlut_sets - 1, header.radius.set);
      expect(header.radius.rho >= 1, "radius of nothing", 1, header.radius.rho);
      const auto limit = static_cast<std::uint32_t>(config_.rlut_columns) * static_cast<std::uint32_t>(config_.phases);
      expect(header.radius.rho <= limit, "radius above what the RLUT holds", limit, header.radius.rho);
      expect(header.radius.base % static_cast<std::uint32_t>(config_.lanes) == 0,
             "first RLUT column is no multiple of the lanes",
             header.radius.base / static_cast<std::uint32_t>(config_.lanes) * static_cast<std::uint32_t>(config_.lanes),
             header.radius.base);
      const std::uint32_t columns = window_geometry(config_, header.radius.rho).padded;
      const std::int64_t end = std::int64_t{header.radius.base} + columns;
      expect(end <= config_.rlut_columns, "RLUT columns past the end", config_.rlut_columns, end);
      expected_words = std::int64_t{columns} * config_.phases;
      break;
    }
    case Table::Radial:
      expected_words = config_.radial_entries;
      break;
    case Table::Factor:
      expected_words = std::int64_t{config_.opacity_segments} + 1;
      break;
    default:
      refuse("unknown table", "0, 1 or 2", std::to_string(static_cast<int>(header.table)));
  }
  expect(words == expected_words, "wrong number of table words", expected_words, words);
  words_left_ = words;
  state_ = State::Payload;
}

const Record* StreamDecode::payload(const Beat& beat) {
  auto& table = std::get<LoadTable>(record_);
  std::int64_t limit = 0;
  switch (table.table) {
    case Table::Rlut:
      limit = config_.rlut_rim();
      break;
    case Table::Radial:
      limit = config_.weight_format().max;
      break;
    case Table::Factor:
      limit = config_.factor_format().max;
      break;
  }
  for (const std::uint32_t word : beat) {
    if (words_left_ == 0) {
      expect(word == 0, "padding is not zero", 0, word);
      continue;
    }
    expect(word <= limit, "table word too large", limit, word);
    if (table.table == Table::Factor && !table.words.empty()) {
      expect(word <= table.words.back(), "slab factor table rises", table.words.back(), word);
    }
    table.words.push_back(word);
    --words_left_;
  }
  if (words_left_ > 0) return nullptr;
  state_ = State::Tables;
  if (table.table == Table::Rlut) sets_loaded_[table.radius.set] = true;
  if (table.table == Table::Radial) radial_loaded_ = true;
  if (table.table == Table::Factor) factor_loaded_ = true;
  return &record_;
}

void StreamDecode::check(const BeginTile& record) {
  if (!radial_loaded_) refuse("no radial table before the first tile", "load_table 1", "begin_tile");
  if (!factor_loaded_) refuse("no slab factor table before the first tile", "load_table 2", "begin_tile");
  expect(record.mode <= Mode::Sum, "unknown mode", 2, static_cast<int>(record.mode));
  if (scope_ == StreamScope::Whole) expect(record.tile == tiles_seen_, "tiles out of order", tiles_seen_, record.tile);
  expect(record.tile < frame_.tiles, "more tiles than announced", frame_.tiles, std::int64_t{record.tile} + 1);
  expect_within(record.width, 1, config_.tile_width, "tile width");
  expect_within(record.height, 1, config_.tile_height, "tile height");
  expect(record.x >= 0, "tile begins outside the image in x", 0, record.x);
  expect(record.y >= 0, "tile begins outside the image in y", 0, record.y);
  const std::int64_t end_x = std::int64_t{record.x} + record.width, end_y = std::int64_t{record.y} + record.height;
  expect(end_x <= frame_.width, "tile ends outside the image in x", frame_.width, end_x);
  expect(end_y <= frame_.height, "tile ends outside the image in y", frame_.height, end_y);
  tile_ = record.tile;
  ++tiles_seen_;
  sheets_seen_ = 0;
  next_tag_ = 0;
  state_ = State::Tile;
}

void StreamDecode::check(const BeginSheet& record) {
  if (sheets_seen_ > 0)
    expect(record.sheet > sheet_, "sheet numbers must rise", std::int64_t{sheet_} + 1, record.sheet);
  sheet_ = record.sheet;
  ++sheets_seen_;
  splats_seen_ = 0;
  state_ = State::Sheet;
}

void StreamDecode::check(const SplatRecord& record) {
  const Format position = config_.position_format();
  if (record.set >= sets_loaded_.size() || !sets_loaded_[record.set])
    refuse("radius set not loaded", "a loaded radius set", std::to_string(record.set));
  expect_within(record.x, position.min, position.max, "x does not fit the position format");
  expect_within(record.y, position.min, position.max, "y does not fit the position format");
  for (const std::uint32_t colour : record.colour) {
    expect(colour <= config_.colour_format().max, "colour does not fit its format", config_.colour_format().max,
           colour);
  }
  expect(record.tag == next_tag_, "tags out of order", next_tag_, record.tag);
  ++next_tag_;
  ++splats_seen_;
}

void StreamDecode::check(const CullBlock& record) {
  expect(record.width >= 1, "empty cull block", 1, record.width);
  expect(record.height >= 1, "empty cull block", 1, record.height);
}

void StreamDecode::check(const EndSheet& record) {
  expect(record.sheet == sheet_, "end of another sheet", sheet_, record.sheet);
  expect(record.splats == splats_seen_, "splats lost in a sheet", record.splats, splats_seen_);
  state_ = State::Tile;
}

void StreamDecode::check(const EndTile& record) {
  expect(record.tile == tile_, "end of another tile", tile_, record.tile);
  expect(record.sheets == sheets_seen_, "sheets lost in a tile", record.sheets, sheets_seen_);
  state_ = State::Tables;
}

void StreamDecode::check(const EndFrame& record) {
  if (scope_ == StreamScope::Whole) {
    expect(tiles_seen_ == frame_.tiles, "tiles missing", frame_.tiles, tiles_seen_);
    expect(record.beats == beats_, "beats lost", static_cast<std::int64_t>(record.beats),
           static_cast<std::int64_t>(beats_));
    expect(record.crc == crc_.value(), "corrupt: checksum of the beats before is wrong", record.crc, crc_.value());
  }
  state_ = State::Ended;
}

const Record* StreamDecode::feed(const Beat& beat) {
  const Record* done = nullptr;
  if (state_ == State::Payload) {
    done = payload(beat);
  } else if (state_ == State::Sheet && get(beat, layout::kOpcode) == static_cast<std::int64_t>(Opcode::Splat)) {
    // All bits of a splat but w0[31:16] are fields: the common case skips the general check.
    expect((beat[0] >> 16) == 0, "reserved bits are set", 0, beat[0] >> 16);
    record_ = to_splat(beat);
    check(std::get<SplatRecord>(record_));
    done = &record_;
  } else {
    const auto opcode = static_cast<std::uint32_t>(get(beat, layout::kOpcode));
    const RecordLayout* found = find_layout(opcode);
    if (found == nullptr)
      refuse("unknown opcode", state_ == State::Start ? "a FastSplat stream (begin_frame, 70)" : "a known opcode",
             std::to_string(opcode));
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
  if (scope_ == StreamScope::Whole && state_ != State::Ended)
    refuse("stream ends too early", "end_frame", "end of data");
  if (scope_ == StreamScope::Subset && state_ != State::Tables && state_ != State::Start && state_ != State::Ended) {
    refuse("stream ends inside a tile or table", "end_tile", "end of data");
  }
}

}  // namespace fastsplat::cmodel
