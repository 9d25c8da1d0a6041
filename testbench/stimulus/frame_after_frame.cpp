#include "testbench/stimulus/frame_after_frame.hpp"

#include <algorithm>
#include <iterator>

#include "testbench/stimulus/cull_frames.hpp"
#include "testbench/stimulus/left_out.hpp"
#include "testbench/stimulus/random.hpp"
#include "testbench/stimulus/stimulus.hpp"

namespace fastsplat::testbench {
namespace {

using namespace cmodel;

constexpr const char* kBins[] = {"tables_that_look_like_records", "soft_reset_behind_a_reset"};

constexpr std::uint64_t kFrames = 12, kSplats = 60;
/// Reads, of two cycles, after which a sheet of some blocks is copied, or walked and through the pixel stage.
constexpr int kCopied = 60, kWalked = 60;
/// Cycles after which a sheet of a few blocks is composited and its table built.
constexpr int kLate = 64;

constexpr Opcode kOpcodes[] = {Opcode::BeginSheet, Opcode::LoadTable, Opcode::CullBlock, Opcode::Splat,
                               Opcode::BeginTile,  Opcode::EndSheet,  Opcode::EndTile,   Opcode::BeginFrame,
                               Opcode::Ellipse,    Opcode::EndFrame};

/// So many of them are asked for in turn: the test unit would go by them.
constexpr std::size_t kAskedFor = 3;

/// Beats of RLUT and RADIAL begin as records do: an opcode, then a small number. The first of RADIAL with the one asked
/// for, others with any.
void look_like_records(const Config& config, Random& random, LoadTable& table, Opcode first) {
  const bool radial = table.table == Table::Radial;
  if (!radial && table.table != Table::Rlut) return;
  const std::int64_t most = radial ? config.weight_format().max : config.rlut_rim();
  for (std::size_t i = 0; i + 1 < table.words.size(); i += kBeatWords) {
    const bool asked = radial && i == 0;
    if (!asked && !random.chance(30)) continue;
    const auto opcode = static_cast<std::uint32_t>(
        asked ? first : kOpcodes[random.between(0, static_cast<std::int64_t>(std::size(kOpcodes)) - 1)]);
    if (opcode > most) continue;
    table.words[i] = opcode;
    table.words[i + 1] =
        static_cast<std::uint32_t>(random.between(0, std::min<std::int64_t>(most, config.rlut_sets - 1)));
  }
}

void frames_that_look_like_records(const Config& config, Frames& frames, Check& check) {
  const auto bin = check.bin("refusal", kBins[0]);
  for (std::uint64_t seed = 0; seed < kFrames; ++seed) {
    Random random(seed);
    const Opcode first = kOpcodes[seed % kAskedFor];
    const std::string what = "frame " + std::to_string(seed) + " whose tables look like records";
    StreamDocument document = make_stimulus(config, StimulusClass::Mixed, 1000 + seed, kSplats).document;
    for (LoadTable& table : document.tables) look_like_records(config, random, table, first);
    frames.good(what, write_document(config, document), bin);
    if (!config.culls()) continue;
    document = sets_frame(config, random);
    for (LoadTable& table : document.tables) look_like_records(config, random, table, first);
    const Beats all = write_document(config, document), sent = without_hidden_sets(config, all);
    frames.good(what + ", of sets", all, bin);
    frames.good(what + ", of sets that are left out", sent, bin);
  }
}

/// A tile ends, sooner and later, while the table of its last sheet is built.
void end_while_tables_are_built(const Config& config, Frames& frames, Check& check) {
  const auto bin = check.bin("refusal", kBins[0]);
  for (int cycles = 1; cycles <= kLate; ++cycles) {
    Random random(static_cast<std::uint64_t>(cycles));
    const Beats beats = write_document(config, frozen_frame(config, random));
    const auto records = records_of(beats);
    const std::size_t end = std::ranges::find(records, Opcode::EndTile, &testbench::Record::opcode)->at;
    frames.good("a tile that ends " + std::to_string(cycles) + " cycles later", beats, bin,
                {end, [&] { frames.device().takes_half_write(WriteHalf::Address, kRegControl.address, 0, cycles); }});
  }
}

/// A table that the frame before loaded, as its last, is none of this frame's.
void refuse_missing_tables(const Config& config, Frames& frames, Check& check) {
  const auto good = check.bin("refusal", kBins[0]), bin = check.bin("refusal", "rule_LOADED");
  StreamDocument document = read_document(config, small_densities(config).first);
  for (const Table table : {Table::Classify, Table::Root, Table::Glint, Table::Lighting, Table::Sheets}) {
    const std::string what = "table " + std::to_string(static_cast<int>(table));
    StreamDocument whole = document;
    const auto others =
        std::ranges::stable_partition(whole.tables, [&](const LoadTable& one) { return one.table != table; });
    frames.good("a frame that loads " + what + " last", write_document(config, whole), good);
    whole.tables.erase(others.begin(), others.end());
    const Beats beats = write_document(config, whole);
    const auto expected = refused_by_model(config, beats);
    check.equal("a frame without " + what + ": the model's rule", static_cast<std::uint64_t>(StreamRule::Loaded),
                expected ? static_cast<std::uint64_t>(expected->rule) : 0, bin);
    if (!expected) continue;
    frames.bad("a frame without " + what, beats, *expected, bin);
    frames.write(kRegIrq, kIrqError);
    frames.device().soft_reset();
  }
}

/// The end of a tile of densities is refused when its sheet was copied long ago, and waits.
void refuse_late_ends(const Config& config, Frames& frames, Check& check) {
  const auto [beats, end] = small_densities(config);
  for (const auto& [what, field] : {std::pair{"the end of another tile, late", layout::kEndTileNumber},
                                    std::pair{"the end of a tile of more sheets, late", layout::kEndTileSheets}}) {
    Beats spoiled = beats;
    const auto right = static_cast<std::uint64_t>(get(spoiled[end], field));
    spoiled[end][static_cast<std::size_t>(field.word)] &= ~field_mask(field);
    put(spoiled[end], field, right + 1);
    const auto expected = refused_by_model(config, spoiled);
    const auto bin =
        check.bin("refusal", field.word == layout::kEndTileNumber.word ? "rule_END_NUMBER" : "rule_END_COUNT");
    check.equal(std::string(what) + ": the model refuses beat", end, expected ? expected->beat : 0, bin);
    if (!expected) continue;
    frames.bad(what, spoiled, *expected, bin, [&] {
      for (int i = 0; i < kCopied; ++i) frames.read(kRegStatus);
    });
    frames.write(kRegIrq, kIrqError);
    frames.device().soft_reset();
  }
}

/// A soft reset that is asked for as soon as a hard one is over has nothing to wait for.
void reset_at_once(Frames& frames, std::span<const Beat> beats, int most_waits, Check& check) {
  const auto bin = check.bin("refusal", kBins[1]);
  for (int wait = 0; wait < most_waits; ++wait) {
    frames.drop(beats, 1, wait);
    frames.device().soft_reset(false);
    for (int i = 0; i < 3; ++i)
      check.equal(
          "STATUS behind two resets, " + std::to_string(wait) + " reads behind the tile, read " + std::to_string(i), 0,
          frames.read(kRegStatus), bin);
    frames.device().soft_reset();
  }
}

}  // namespace

std::span<const char* const> frame_after_frame_bins() { return kBins; }

void check_frame_after_frame(const Config& config, Frames& frames, const Beats& beats, Check& check) {
  frames_that_look_like_records(config, frames, check);
  if (config.culls()) end_while_tables_are_built(config, frames, check);
  const auto records = records_of(beats);
  const auto end = std::ranges::find(records, Opcode::EndTile, &testbench::Record::opcode)->at;
  reset_at_once(frames, std::span(beats).first(end + 1), 4, check);
  if (config.classifies()) {
    refuse_missing_tables(config, frames, check);
    refuse_late_ends(config, frames, check);
    const auto [densities, end_of_tile] = small_densities(config);
    reset_at_once(frames, std::span(densities).first(end_of_tile + 1), kWalked, check);
  }
  frames.good("a frame after frames", beats, check.bin("refusal", kBins[0]));
}

}  // namespace fastsplat::testbench
