// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/frame_after_frame.hpp"

#include <algorithm>
#include <iterator>
#include <tuple>

#include "testbench/stimulus/cull_frames.hpp"
#include "testbench/stimulus/directed_stream.hpp"
#include "testbench/stimulus/left_out.hpp"
#include "testbench/stimulus/random.hpp"
#include "testbench/stimulus/stimulus.hpp"

namespace fastsplat::testbench {
namespace {

using namespace cmodel;

constexpr const char* kFrameAfterFrameBins[] = {"tables_that_look_like_records", "frames_behind_each_other",
                                                "soft_reset_behind_a_reset", "beats_dropped_before_a_frame"};

constexpr std::uint64_t kFrames = 12, kSplats = 60;
/// Reads, of two cycles, after which a sheet of some blocks is copied, or walked and through the pixel stage.
constexpr int kCopied = 60, kWalked = 60;
/// Cycles after which a sheet of a few blocks is composited and its table built.
constexpr int kLate = 64;

constexpr Opcode kOpcodes[] = {Opcode::BeginSheet, Opcode::LoadTable, Opcode::CullBlock, Opcode::Splat,
                               Opcode::BeginTile,  Opcode::EndSheet,  Opcode::EndTile,   Opcode::BeginFrame,
                               Opcode::Ellipse,    Opcode::EndFrame};

/// Hidden cull groups of sets_frame(): two beside its first tile, one over the opaque half.
constexpr std::uint64_t kHiddenSets = 3;

/// So many of kOpcodes take turns as the first: the test unit would act on them.
constexpr std::size_t kAskedFor = 3;

/// Makes beats of RLUT and RADIAL look like records (an opcode, then a small number) where the range of their words
/// allows it. The first beat of RADIAL gets `first`; with `others` later ones get any opcode. Returns their number.
int look_like_records(const Config& config, Random& random, LoadTable& table, Opcode first, bool others) {
  const bool radial = table.table == Table::Radial;
  if (!radial && (!others || table.table != Table::Rlut)) return 0;
  const std::int64_t most = radial ? config.weight_format().max : config.rlut_rim();
  int changed = 0;
  for (std::size_t i = 0; i + 1 < table.words.size() && (others || i == 0); i += kBeatWords) {
    const bool asked = radial && i == 0;
    if (!asked && !random.chance(30)) continue;
    const auto opcode = static_cast<std::uint32_t>(
        asked ? first : kOpcodes[random.between(0, static_cast<std::int64_t>(std::size(kOpcodes)) - 1)]);
    if (opcode > most) continue;
    table.words[i] = opcode;
    table.words[i + 1] =
        static_cast<std::uint32_t>(random.between(0, std::min<std::int64_t>(most, config.rlut_sets - 1)));
    ++changed;
  }
  return changed;
}
int look_like_records(const Config& config, Random& random, StreamDocument& document, Opcode first, bool others) {
  int changed = 0;
  for (LoadTable& table : document.tables) changed += look_like_records(config, random, table, first, others);
  return changed;
}

void frames_that_look_like_records(const Config& config, Frames& frames, Check& check) {
  const auto other = check.bin("refusal", kFrameAfterFrameBins[1]);
  for (std::uint64_t seed = 0; seed < kFrames; ++seed) {
    Random random(seed);
    const Opcode first = kOpcodes[seed % kAskedFor];
    const std::string what = "frame " + std::to_string(seed) + " whose tables look like records";
    // If the device's words are too small for an opcode, it is an ordinary frame.
    const auto bin = [&](StreamDocument& document, bool others) {
      return look_like_records(config, random, document, first, others) > 0
                 ? check.bin("refusal", kFrameAfterFrameBins[0])
                 : other;
    };
    StreamDocument document = make_stimulus(config, StimulusClass::Mixed, 1000 + seed, kSplats).document;
    const auto mixed = bin(document, true);
    frames.good(what, write_document(config, document), mixed);
    if (!config.culls()) continue;
    document = sets_frame(config, random);
    const auto of_sets = bin(document, false);
    const Beats all = write_document(config, document), sent = without_hidden_sets(config, all);
    check.equal(what + ": splats of hidden sets, some", 1, sent.size() < all.size() ? 1 : 0, of_sets);
    for (const Beats* beats : {&all, &sent}) {
      frames.good(what + (beats == &all ? ", of sets" : ", of sets that are left out"), *beats, of_sets);
      check.equal(what + ": sets that have to be hidden", 1,
                  frames.device().cycle_counters().hidden_sets >= kHiddenSets ? 1 : 0, of_sets);
    }
  }
}

/// A tile ends, sooner and later, while the table of its last sheet is built.
void end_while_tables_are_built(const Config& config, Frames& frames, Check& check) {
  const auto bin = check.bin("refusal", kFrameAfterFrameBins[1]);
  for (int cycles = 1; cycles <= kLate; ++cycles) {
    Random random(static_cast<std::uint64_t>(cycles));
    const Beats beats = write_document(config, frozen_frame(config, random));
    const std::size_t end = first_of(beats, Opcode::EndTile);
    frames.good("a tile that ends " + std::to_string(cycles) + " cycles later", beats, bin,
                {end, [&] { frames.device().takes_half_write(WriteHalf::Address, kRegControl.address, 0, cycles); }});
  }
}

/// A table that the frame before loaded last does not count as loaded in this frame.
void refuse_missing_tables(const Config& config, Frames& frames, Check& check) {
  const auto good = check.bin("refusal", kFrameAfterFrameBins[1]), bin = check.bin("refusal", "rule_LOADED");
  StreamDocument document = read_document(config, small_densities(config).first);
  for (const Table table : {Table::Classify, Table::Root, Table::Glint, Table::Lighting, Table::Sheets}) {
    const std::string what = "table " + std::to_string(static_cast<int>(table));
    StreamDocument whole = document;
    // From <algorithm>: clang 14 with libstdc++ 12 cannot compile the subrange that std::ranges' one returns.
    const auto others = std::stable_partition(whole.tables.begin(), whole.tables.end(),
                                              [&](const LoadTable& one) { return one.table != table; });
    frames.good("a frame that loads " + what + " last", write_document(config, whole), good);
    whole.tables.erase(others, whole.tables.end());
    const Beats beats = write_document(config, whole);
    const auto expected = refused_by_model(config, beats);
    check.equal("a frame without " + what + ": the model's rule", static_cast<std::uint64_t>(StreamRule::Loaded),
                expected ? static_cast<std::uint64_t>(expected->rule) : 0, bin);
    if (!expected) continue;
    frames.bad("a frame without " + what, beats, *expected, bin);
    frames.forgive();
  }
}

/// The end of a tile of densities is refused when its sheet was copied long ago, and waits.
void refuse_late_ends(const Config& config, Frames& frames, Check& check) {
  const auto [beats, end] = small_densities(config);
  for (const auto& [what, field, rule] :
       {std::tuple{"the end of another tile, late", layout::kEndTileNumber, "rule_END_NUMBER"},
        std::tuple{"the end of a tile of more sheets, late", layout::kEndTileSheets, "rule_END_COUNT"}}) {
    Beats spoiled = beats;
    overwrite(spoiled[end], field, static_cast<std::uint64_t>(get(beats[end], field)) + 1);
    const auto expected = refused_by_model(config, spoiled);
    const auto bin = check.bin("refusal", rule);
    check.equal(std::string(what) + ": the model refuses beat", end, expected ? expected->beat : 0, bin);
    if (!expected) continue;
    frames.bad(what, spoiled, *expected, bin, [&] {
      for (int i = 0; i < kCopied; ++i) frames.read(kRegStatus);
    });
    frames.forgive();
  }
}

/// A soft reset that is requested as soon as a hard one is over has nothing to wait for.
void reset_at_once(Frames& frames, std::span<const Beat> beats, int most_waits, Check& check) {
  const auto bin = check.bin("refusal", kFrameAfterFrameBins[2]);
  for (int wait = 0; wait < most_waits; ++wait) {
    frames.drop(beats, 1, wait);
    frames.device().soft_reset(false);
    for (int i = 0; i < 3; ++i)
      check.equal(
          "STATUS after two resets, " + std::to_string(wait) + " reads after the tile, read " + std::to_string(i), 0,
          frames.read(kRegStatus), bin);
    frames.device().soft_reset();
  }
}

/// `begin` with one bit of its opcode or magic flipped: the decoder must not take it for a begin_frame.
Beat beside(const Beat& begin, const cmodel::Field& field, int bit) {
  Beat out = begin;
  overwrite(out, field, static_cast<std::uint64_t>(get(begin, field)) ^ (std::uint64_t{1} << bit));
  return out;
}

/// For a device with slices: after a reset beats are dropped up to the next begin_frame, and all while CONTROL requests
/// it.
void drop_what_a_reset_leaves(Frames& frames, std::span<const Beat> beats, Check& check) {
  const auto bin = check.bin("refusal", kFrameAfterFrameBins[3]);
  const std::size_t part = beats.size() / 2;
  Beats left(beats.begin() + static_cast<std::ptrdiff_t>(part), beats.end());
  for (int bit = 0; bit < 8; ++bit) left.push_back(beside(beats[0], layout::kOpcode, bit));
  for (int bit = 0; bit < 32; ++bit) left.push_back(beside(beats[0], layout::kFrameMagic, bit));
  const auto next = [&](const std::string& what) {
    check.equal(what + ": STATUS", 0, frames.read(kRegStatus), bin);
    check.equal(what + ": IRQ, error", 0, frames.read(kRegIrq) & kIrqError, bin);
    frames.good("a frame after " + what, Beats(beats.begin(), beats.end()), bin);
  };
  frames.drop(beats.first(part), 1);
  frames.device().drop(left);
  // At once: the core wipes its memories. The slice is not ready in the first cycle after a reset.
  check.equal("cycles in which beats are dropped after a hard reset", left.size() + 1, frames.device().cycles(), bin);
  next("beats that a hard reset left");
  frames.cut("an aborted frame", beats.first(part), 1, bin);
  frames.device().drop(left);
  next("beats that a soft reset left");
  for (const std::uint32_t control : {kControlReset | kControlDrop, kControlReset | kControlDrop | kControlClear}) {
    frames.write(kRegControl, control);
    frames.device().drop(beats);
    frames.write(kRegIrq, 0);  // another register: beats are still dropped
    frames.device().drop(beats.first(part));
    frames.write(kRegControl, 0);
    frames.device().drop(left);
    next("beats that CONTROL dropped");
  }
  // DROP alone does nothing: the frame goes on.
  frames.good("a frame in which DROP is written without RESET", Beats(beats.begin(), beats.end()), bin,
              {part, [&] { frames.write(kRegControl, kControlDrop); }});
}

}  // namespace

std::span<const char* const> frame_after_frame_bins() { return kFrameAfterFrameBins; }

void check_frame_after_frame(const Config& config, Frames& frames, const Beats& beats, Check& check) {
  frames_that_look_like_records(config, frames, check);
  if (config.culls()) end_while_tables_are_built(config, frames, check);
  reset_at_once(frames, std::span(beats).first(first_of(beats, Opcode::EndTile) + 1), 4, check);
  if (config.classifies()) {
    refuse_missing_tables(config, frames, check);
    refuse_late_ends(config, frames, check);
    const auto [densities, end_of_tile] = small_densities(config);
    reset_at_once(frames, std::span(densities).first(end_of_tile + 1), kWalked, check);
  }
  if (frames.device().sliced()) drop_what_a_reset_leaves(frames, beats, check);
  frames.good("a frame after frames", beats, check.bin("refusal", kFrameAfterFrameBins[1]));
}

}  // namespace fastsplat::testbench
