// SPDX-License-Identifier: Apache-2.0
#include "cmodel/rtl_package/sv_package.hpp"

#include <algorithm>
#include <bit>
#include <cctype>

#include "base/hash_text.hpp"
#include "cmodel/classify/classify_tables.hpp"
#include "cmodel/cull/cull_sets.hpp"
#include "cmodel/cycles/cycle_stages.hpp"
#include "cmodel/decode/stream_decode.hpp"
#include "cmodel/io/register_fields.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/numbers/sites.hpp"
#include "cmodel/numbers/stall_counters.hpp"
#include "cmodel/stream/stream_layout.hpp"
#include "cmodel/stream/stream_rules.hpp"

namespace fastsplat::cmodel {
namespace {

/// For densities: interpolation narrows to S 8.f (N-6.2-7), and the RTL has no bits for more.
constexpr int kDensityMostInt = 7;

/// Bits that hold 0..largest, at least one.
int bits_for(std::int64_t largest) {
  const int bits = std::bit_width(static_cast<std::uint64_t>(largest));
  return bits > 0 ? bits : 1;
}

class Package {
 public:
  void number(const std::string& name, std::int64_t value) {
    text_ += "  localparam int " + name + " = " + std::to_string(value) + ";\n";
  }
  void vector(const std::string& name, int bits, std::uint64_t value) {
    text_ += "  localparam logic [" + std::to_string(bits - 1) + ":0] " + name + " = " + std::to_string(bits) + "'h" +
             hash_text(value).substr(16 - static_cast<std::size_t>((bits + 3) / 4)) + ";\n";
  }
  /// All bits of a beat.
  void beat(const std::string& name, const Beat& value) {
    text_ += "  localparam logic [" + std::to_string(kBeatBits - 1) + ":0] " + name + " = " +
             std::to_string(kBeatBits) + "'h";
    for (std::size_t i = value.size(); i-- > 0;) text_ += hash_text(value[i]).substr(8) + (i > 0 ? "_" : ";\n");
  }
  void section(const std::string& title) { text_ += "\n  // " + title + "\n"; }
  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

std::optional<ErrorParts> rtl_violation(const Config& config) {
  const auto refuse = [](const char* key, const char* what, std::string expected, int got) {
    return ErrorParts{.where = key,
                      .what = what,
                      .expected = std::move(expected),
                      .got = std::to_string(got),
                      .fix = "use the model for this configuration"};
  };
  if (config.index() != IndexKind::Rlut) {
    return ErrorParts{.where = "index.kind",
                      .what = "the RTL supports index.kind rlut only",
                      .expected = "rlut",
                      .got = text_of(config, *find_key("index.kind")),
                      .fix = "use the model for this configuration"};
  }
  if (config.has_patterns())
    return refuse("pattern.node_bits", "the RTL does not support solid patterns", "0", config.pattern_node_bits);
  if (config.classifies() && config.composite_every_sample != 0) {
    return refuse("composite.every_sample", "the RTL does not support every_sample together with densities",
                  "0 with classify.segment_bits", config.composite_every_sample);
  }
  if (config.classifies() && config.sheet_int_bits > kDensityMostInt) {
    return refuse("sheet.int_bits", "the RTL's transfer function must fall by less than 2^7 between two entries",
                  "at most " + std::to_string(kDensityMostInt) + " with classify.segment_bits", config.sheet_int_bits);
  }
  if (config.has_ellipses() && config.position_frac_bits < 1)
    return refuse("position.frac_bits", "the RTL's ellipses need a fraction bit", "at least 1",
                  config.position_frac_bits);
  if (config.phases < 2) return refuse("snap.phases", "the RTL needs a phase bit", "at least 2", config.phases);
  if (config.lanes < 2) return refuse("array.lanes", "the RTL needs a lane bit", "at least 2", config.lanes);
  if (config.opacity_segments < 2)
    return refuse("opacity.segments", "the RTL needs a segment bit", "at least 2", config.opacity_segments);
  if (config.opacity_remainder_bits() < 1) {
    return refuse("opacity.segments", "the RTL's interpolation needs at least one bit",
                  "sheet bits - log2(segments) >= 1", config.opacity_remainder_bits());
  }
  const int blocks = config.tile_width / config.lanes * (config.tile_height / config.lanes);
  if (blocks > 1024)
    return refuse("tile.width", "the RTL finds dirty blocks in one cycle", "at most 1024 blocks of P x P in a tile",
                  blocks);
  const int columns = config.tile_width / config.lanes;
  if (!std::has_single_bit(static_cast<unsigned>(columns))) {
    return refuse("tile.width", "the RTL addresses blocks with shifts", "tile.width / array.lanes a power of two",
                  columns);
  }
  return std::nullopt;
}

std::string sv_package(const Config& config) {
  const int blocks_x = config.tile_width / config.lanes, blocks_y = config.tile_height / config.lanes;
  const int sheet_bits = config.sheet_int_bits + config.sheet_frac_bits;
  const int transmittance_bits = config.composite_frac_bits + 1;
  const std::int64_t composited_bits = bits_for(config.composited_format().max);
  const int largest_side = config.tile_width > config.tile_height ? config.tile_width : config.tile_height;

  Package p;
  p.section("array and tile");
  p.number("LANES", config.lanes);
  p.number("LANE_LOG2", Config::log2_exact(config.lanes));
  p.number("BANKS", std::int64_t{config.lanes} * config.lanes);
  p.number("SIDE_BITS", bits_for(largest_side + config.lanes));
  p.number("TILE_WIDTH", config.tile_width);
  p.number("TILE_HEIGHT", config.tile_height);
  p.number("BLOCKS_X", blocks_x);
  p.number("BLOCKS_Y", blocks_y);
  p.number("BLOCKS", std::int64_t{blocks_x} * blocks_y);
  p.number("BLK_BITS", bits_for((blocks_x > blocks_y ? blocks_x : blocks_y) - 1));
  p.number("ADDR_BITS", bits_for(std::int64_t{blocks_x} * blocks_y - 1));

  p.section("position and snapping");
  p.number("POS_INT", config.position_int_bits);
  p.number("POS_FRAC", config.position_frac_bits);
  p.number("POS_BITS", config.position_int_bits + config.position_frac_bits);
  p.number("PHASES", config.phases);
  p.number("PHASE_LOG2", config.phase_bits());
  p.number("PHASE_BITS", config.phase_bits());
  p.number("ORG_BITS", config.origin_bits());

  p.section("RLUT and radial table");
  p.number("RLUT_SETS", config.rlut_sets);
  p.number("SET_BITS", bits_for(config.rlut_sets - 1));
  p.number("RLUT_COLUMNS", config.rlut_columns);
  p.number("COL_BITS", bits_for(config.rlut_columns));
  p.number("RHO_BITS", bits_for(std::int64_t{config.rlut_columns} * config.phases));
  p.number("GUARD", config.rlut_guard_bits);
  p.number("RLUT_BITS", bits_for(config.rlut_rim()));
  p.number("RADIAL_ENTRIES", config.radial_entries);
  p.number("RADIAL_LOG2", config.radial_index_bits());
  p.number("WEIGHT_BITS", config.radial_int_bits + config.radial_frac_bits);
  p.number("RADIAL_WORDS", config.radial_words());
  p.number("INTERPOLATE", config.radial_interpolate);
  p.number("RADIAL_BITS", (config.interpolates() ? 2 : 1) * (config.radial_int_bits + config.radial_frac_bits));
  p.number("WEIGHT_DELAY", static_cast<std::int64_t>(stages::weight_delay(config)));
  p.number("TABLE_BITS", std::max(bits_for(config.rlut_rim()), config.radial_int_bits + config.radial_frac_bits));
  p.number("COLOUR_BITS", config.colour_bits());

  p.section("ellipses: 0, or there are some; where there are none, words of one bit");
  const bool ellipses = config.has_ellipses();
  const int most_windows = kEllipseWindows * config.lanes;
  p.number("ELLIPSES", ellipses ? 1 : 0);
  p.number("ELLIPSE_FRAC", config.ellipse_frac_bits);
  p.number("ELLIPSE_BITS", ellipses ? config.ellipse_format().word_bits : 1);
  p.number("ELLIPSE_DELAY", static_cast<int>(stages::splat_delay(config)));
  p.number("SHAPE_BITS", ellipses ? 94 : 1);
  p.number("WINDOW_BITS", bits_for(ellipses ? std::max(config.rlut_columns, most_windows) : config.rlut_columns));
  p.number("WAY_BITS", ellipses ? 32 : config.phase_bits());

  p.section("sheet, slab opacity, compositing, pixels");
  p.number("SHEET_BITS", sheet_bits);
  p.number("SEGMENTS", config.opacity_segments);
  p.number("SEG_LOG2", Config::log2_exact(config.opacity_segments));
  p.number("REM_BITS", config.opacity_remainder_bits());
  p.number("FACTOR_BITS", config.opacity_frac_bits + 1);
  p.number("TRANS_BITS", transmittance_bits);
  p.number("TRANS_FRAC", config.composite_frac_bits);
  p.number("COLOUR_INT", config.colour_int_bits);
  p.number("STATE_BITS", std::max<std::int64_t>(sheet_bits, composited_bits));
  p.number("FREEZE_BELOW", config.freeze_below);
  p.number("COMPOSITE_LANES", config.composited_at_once());
  p.number("SLICES", config.slices());
  p.number("SLICE_BITS", bits_for(config.slices() - 1));
  p.number("EVERY_SAMPLE", config.composite_every_sample);
  p.number("PIXEL_BITS", config.pixel_int_bits + config.pixel_frac_bits);

  p.section("narrowing sites: fraction bits dropped, 0 TRN 1 RND 2 RND_CONV, 1 where the word is One.f");
  for (std::size_t i = 0; i < kSiteCount; ++i) {
    if (static_cast<Site>(i) == Site::AxisProduct) continue;  // not in the RTL
    const Narrowing site = narrowing(config, static_cast<Site>(i));
    const std::string name = upper(kSiteFacts[i].name);
    p.number("SHIFT_" + name, site.from_frac() - site.to().frac_bits);
    p.number("ROUND_" + name, static_cast<int>(site.rounding()));
    const bool is_signed = site.to().min < 0;  // the RTL fixes the format of signed sites
    if (!is_signed) p.number("UNIT_" + name, site.to().word_bits == 0 ? 1 : 0);
  }

  p.section("culling: 0 off, 1 block, 2 pixel; cells of a tile, words of a table, memory words of a row of them");
  const int cell = config.culls() ? config.cull_cell() : config.lanes;
  const std::int64_t cells_x = config.tile_width / cell, cells_y = config.tile_height / cell;
  const std::int64_t words = cell == config.lanes ? blocks_x : config.lanes;
  p.number("CULL_MAP", config.cull_map);
  p.number("CULL_CELL_LOG2", Config::log2_exact(cell));
  p.number("CULL_CELL_BITS", bits_for(std::max(cells_x, cells_y)));
  p.number("CULL_ROWS", cells_y);
  p.number("CULL_BITS", bits_for(cells_x * cells_y));
  p.number("CULL_WORDS", words);
  p.number("CULL_CHUNKS", cells_x / words);
  p.number("CULL_ADDR_BITS", bits_for(cells_y * (cells_x / words) - 1));
  p.number("CULL_SETS_BITS", bits_for(cull_sets(config) - 1));
  p.number("WINDOWS_X", std::int64_t{config.rlut_columns / config.lanes});

  p.section("densities: 0, or there are some; where there are none, words of one bit");
  const bool densities = config.classifies();
  p.number("DENSITIES", densities ? 1 : 0);
  p.number("CLASSIFY_LOG2", densities ? config.classify_segment_bits : 1);
  p.number("SHEET_FRAC", config.sheet_frac_bits);
  p.number("DENSITY_WORD", std::max(classify::kColour + 1, sheet_bits));
  p.number("DENSITY_ADDR", std::max(7, densities ? config.classify_segment_bits : 1));
  p.number("DENSITY_STEPS", static_cast<std::int64_t>(stages::density_steps(config)));
  p.number("DENSITY_STAGES", stages::kPixelStage);
  p.number("DENSITY_LATE", static_cast<std::int64_t>(stages::density_late(config)));
  p.number("SHEETS_LOG2", densities ? classify::kSheetsBits : 1);

  p.section("stream");
  const std::uint64_t hash = config_hash(config);
  p.vector("HASH_LOW", 32, hash & 0xffffffffU);
  p.vector("HASH_HIGH", 32, hash >> 32);
  p.vector("STREAM_MAGIC", 32, kStreamMagic);
  p.vector("STREAM_VERSION", 16, kStreamVersion);
  p.number("BEAT_WORDS", kBeatWords);
  p.number("BEAT_BITS", kBeatBits);
  for (const auto& record : record_layouts())
    p.vector("OP_" + upper(record.name), 8, static_cast<std::uint64_t>(record.opcode));
  p.vector("TABLE_RLUT", 8, static_cast<std::uint64_t>(Table::Rlut));
  p.vector("TABLE_RADIAL", 8, static_cast<std::uint64_t>(Table::Radial));
  p.vector("TABLE_FACTOR", 8, static_cast<std::uint64_t>(Table::Factor));
  p.vector("TABLE_CLASSIFY", 8, static_cast<std::uint64_t>(Table::Classify));
  p.vector("TABLE_ROOT", 8, static_cast<std::uint64_t>(Table::Root));
  p.vector("TABLE_GLINT", 8, static_cast<std::uint64_t>(Table::Glint));
  p.vector("TABLE_LIGHTING", 8, static_cast<std::uint64_t>(Table::Lighting));
  p.vector("TABLE_SHEETS", 8, static_cast<std::uint64_t>(Table::Sheets));

  p.section(
      "what a beat may hold: bits with a name, the last word first; rules in the order in which a record is checked");
  for (const auto& record : record_layouts()) p.beat("USED_" + upper(record.name), used_bits(record));
#define X(name, value, register_name, meaning) \
  if (checked_by_device(StreamRule::name)) p.number("RULE_" #register_name, value);
  FASTSPLAT_STREAM_RULES(X)
#undef X
  p.number("RHO_MOST", std::int64_t{config.rlut_columns} * config.grid() / 2);
  p.vector("RLUT_WORD_MOST", 32, static_cast<std::uint64_t>(config.rlut_rim()));
  p.vector("RADIAL_WORD_MOST", 32, static_cast<std::uint64_t>(config.weight_format().max));
  p.vector("FACTOR_WORD_MOST", 32, static_cast<std::uint64_t>(config.factor_format().max));
  p.vector("DENSITY_WORD_MOST", 32, static_cast<std::uint64_t>(config.sheet_format().max));
  const std::int64_t density_words =
      densities ? std::max(classify_words(config, Table::Classify), std::int64_t{2} << classify::kSheetsBits) : 0;
  p.number(
      "WORDS_BITS",
      bits_for(std::max({std::int64_t{kBeatWords}, density_words, std::int64_t{config.rlut_columns} * config.phases,
                         std::int64_t{config.radial_words()}, std::int64_t{config.opacity_segments} + 1})));

  p.section("counters, in the model's order, then cycles");
  std::int64_t counters = 0;
  for (const CounterEntry& counter : counter_entries()) p.number("CNT_" + counter.name, counters++);
  p.number("COUNTERS", static_cast<std::int64_t>(counters_of(config)));
  p.number("COUNTER_BITS", config.counter_bits);

  p.section("registers");
  for (const auto& reg : kRegisters) p.vector(std::string("REG_") + reg.name, 12, reg.address);
  for (const auto& [reg, word] : capabilities(config)) {
    p.vector(std::string("REG_") + reg.name, 12, reg.address);
    p.vector(reg.name, 32, word);
  }

  return "// Generated for configuration '" + config.name + "' (hash " + hash_text(hash) +
         "); do not edit.\npackage fastsplat_pkg;" + p.take() + "endpackage\n";
}

}  // namespace fastsplat::cmodel
