// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/mid_frame.hpp"

#include <algorithm>
#include <set>

#include "cmodel/cycles/cycle_stages.hpp"
#include "cmodel/io/register_fields.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::testbench {
namespace {

using namespace cmodel;

constexpr const char* kMidFrameBins[] = {
    "register_writes_in_a_frame_are_refused",   "busy_while_a_beat_is_judged",
    "error_beat_after_a_hard_reset_in_a_frame", "error_beat_after_a_soft_reset_in_a_frame",
    "no_interrupt_before_the_last_pixels",      "no_interrupt_after_a_short_reset"};
/// Reads after which a device that has nothing to do is at rest.
constexpr int kReads = 24;
/// More than a slow sink needs for a tile.
constexpr std::uint64_t kMostReads = 1U << 20;

/// All addresses that answer SLVERR to a write: read-only registers and unused addresses, most of them one bit away
/// from a writable one.
std::set<std::uint32_t> refused_addresses(const Config& config) {
  constexpr std::uint32_t kEnd = 0x1000;
  std::set<std::uint32_t> out;
  const std::set<std::uint32_t> written{kRegControl.address, kRegIrq.address, kRegIrqMask.address};
  for (const Register& reg : kRegisters) out.insert(reg.address);
  for (const Capability& one : capabilities(config)) out.insert(one.reg.address);
  for (const std::uint32_t address : written)
    for (std::uint32_t bit = 1; bit < kEnd; bit <<= 1) out.insert(address ^ bit);
  out.insert({kRegCounters.address + 4, kEnd - 4, kEnd - 1});
  for (const std::uint32_t address : written) out.erase(address);
  return out;
}

std::size_t behind_first(const Beats& beats, Opcode wanted) { return first_of(beats, wanted) + 1; }

/// In a tile, and between two words of a table, where a soft reset or cleared counters would show in what comes out.
void refuse_writes(const Config& config, Frames& frames, const Beats& beats, Check& check) {
  const auto bin = check.bin("refusal", kMidFrameBins[0]);
  for (const std::size_t at : {behind_first(beats, Opcode::LoadTable), behind_first(beats, Opcode::Splat)}) {
    const std::string what = "writes after beat " + std::to_string(at);
    frames.good(what, beats, bin,
                {at, [&] {
                   const auto state = [&] {
                     return std::array{frames.read(kRegStatus), frames.read(kRegIrq), frames.read(kRegIrqMask)};
                   };
                   for (int i = 0; i < kReads; ++i) frames.read(kRegStatus);  // the beat was processed
                   const auto before = state();
                   for (const std::uint32_t address : refused_addresses(config))
                     check.equal(what + ", to " + std::to_string(address) + ": answers OKAY", 0,
                                 frames.device().write_register(address, 0xffffffff).okay ? 1 : 0, bin);
                   const auto after = state();
                   check.equal(what + ": interrupts that they could clear", kIrqFrame | kIrqTile,
                               before[1] & (kIrqFrame | kIrqTile), bin);
                   for (std::size_t i = 0; i < before.size(); ++i)
                     check.equal(what + ": STATUS, IRQ, IRQ_MASK after them", before[i], after[i], bin);
                 }});
  }
}

/// Read in the cycle after begin_frame was taken, when it lies in check. Then read in the next cycles, in which it
/// passes the test unit if there is one.
void be_busy_while_judging(const Config& config, Frames& frames, const Beats& beats, Check& check) {
  const auto bin = check.bin("refusal", kMidFrameBins[1]);
  for (int later = 0; later < (config.culls() ? 2 + static_cast<int>(stages::kCullStages) : 2); ++later) {
    frames.device().consume(std::span(beats).first(1));
    if (later > 0) frames.device().takes_half_write(WriteHalf::Address, kRegControl.address, 0, later);
    const std::string what = "STATUS after begin_frame, " + std::to_string(later) + " cycles later";
    check.equal(what, kStatusBusy, frames.read(kRegStatus), bin);
    for (int i = 0; i < kReads; ++i) frames.read(kRegStatus);
    check.equal(what + ", at rest", 0, frames.read(kRegStatus), bin);
    frames.device().soft_reset();
  }
}

/// A frame is given up in a tile; the next one's beats are numbered from 0.
void count_anew(const Config& config, Frames& frames, const Beats& beats, Check& check) {
  const auto hard = check.bin("refusal", kMidFrameBins[2]), soft = check.bin("refusal", kMidFrameBins[3]);
  const auto part = std::span(beats).first(behind_first(beats, Opcode::Splat));
  const auto all = violations(config, beats);
  for (const StreamRule rule : {StreamRule::Configuration, StreamRule::EndCount}) {
    Beats spoiled = beats;
    std::ranges::find(all, rule, &Violation::rule)->commit(spoiled);
    const auto expected = refused_by_model(config, spoiled);
    if (!expected) continue;  // check_refusals() has reported it
    const std::string what = "rule " + std::to_string(static_cast<int>(rule)) + " in the frame after an aborted one";
    frames.drop(part, 1);
    frames.bad(what + " by a hard reset", spoiled, *expected, hard);
    frames.forgive();
    frames.cut("an aborted frame", part, 1, soft);
    frames.bad(what + " by a soft reset", spoiled, *expected, soft);
    frames.forgive();
  }
}

/// The first tile as a frame of its own, and as large as a tile can be. Without cull_blocks, which hold for the pixels
/// of the original tile.
Beats large_tile(const Config& config, const Beats& beats) {
  Beats out(beats.begin(), beats.begin() + static_cast<std::ptrdiff_t>(behind_first(beats, Opcode::EndTile)));
  out.push_back(beats.back());
  auto frame = std::get<BeginFrame>(from_beat(out[0]));
  auto& tile_beat = out[behind_first(beats, Opcode::BeginTile) - 1];
  auto tile = std::get<BeginTile>(from_beat(tile_beat));
  const int halo = cmodel::holds_densities(tile.mode) ? 2 : 0;
  tile.x = tile.y = 0;
  tile.width = frame.width = config.tile_width - halo;
  tile.height = frame.height = config.tile_height - halo;
  Beats changed;
  append(changed, frame);
  append(changed, tile);
  out[0] = changed[0];
  tile_beat = changed[1];
  const auto records = records_of(out);
  for (auto record = records.rbegin(); record != records.rend(); ++record)
    if (record->opcode == Opcode::CullBlock) out.erase(out.begin() + static_cast<std::ptrdiff_t>(record->at));
  return out;
}

/// Of a stream of one tile, which a sink takes slowly: end_frame was carried out long before the last pixels leave.
void wait_for_the_last_pixels(const Config& config, const MakeDevice& make, const Beats& beats, Check& check) {
  const auto early = check.bin("refusal", kMidFrameBins[4]), after_reset = check.bin("refusal", kMidFrameBins[5]);
  Frames frames(config, make, check, Pattern("every-97", 1));
  const Beats tile = large_tile(config, beats);
  std::uint32_t irq = 0;
  std::uint64_t reads = 0;
  const auto what = [&] {
    for (; frames.tiles_left() == 0 && reads < kMostReads; ++reads) {
      const std::uint32_t now = frames.read(kRegIrq);
      if (frames.tiles_left() == 0) irq |= now;
    }
  };
  frames.good("a frame whose pixels leave slowly", tile, early, {tile.size(), what});
  check.equal("reads of IRQ while pixels leave slowly, more than a hundred", 1, reads > 100 ? 1 : 0, early);
  check.equal("IRQ before the last pixels left", 0, irq, early);
  check.equal("IRQ once they have left", kIrqFrame | kIrqTile, frames.read(kRegIrq), early);

  // The same, with a reset while the picture goes out and end_frame was carried out.
  frames.drop(tile, 1, 60);
  frames.write(kRegIrqMask, kIrqFrame | kIrqTile | kIrqError);
  irq = 0;
  bool raised = false;
  for (int i = 0; i < 4 * kReads; ++i) {
    irq |= frames.read(kRegIrq);
    raised = raised || frames.device().interrupt();
  }
  check.equal("tiles that left before or after the reset", 0, static_cast<std::uint64_t>(frames.tiles_left()),
              after_reset);
  check.equal("IRQ after a reset of one cycle", 0, irq, after_reset);
  check.equal("interrupt after a reset of one cycle", 0, raised ? 1 : 0, after_reset);
  frames.good("a frame after a reset of one cycle", tile, after_reset);
}

}  // namespace

std::span<const char* const> mid_frame_bins() { return kMidFrameBins; }

void check_mid_frame(const Config& config, const MakeDevice& make, Frames& frames, const Beats& beats, Check& check) {
  refuse_writes(config, frames, beats, check);
  be_busy_while_judging(config, frames, beats, check);
  count_anew(config, frames, beats, check);
  wait_for_the_last_pixels(config, make, beats, check);
}

}  // namespace fastsplat::testbench
