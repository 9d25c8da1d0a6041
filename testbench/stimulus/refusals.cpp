// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "cmodel/io/register_map.hpp"
#include "testbench/stimulus/frame_after_frame.hpp"
#include "testbench/stimulus/frames.hpp"
#include "testbench/stimulus/mid_frame.hpp"
#include "testbench/stimulus/random.hpp"
#include "testbench/stimulus/violations.hpp"

namespace fastsplat::testbench {
namespace {

using cmodel::Opcode;
using cmodel::StreamRule;

struct RuleName {
  StreamRule rule;
  const char* bin;
};
constexpr RuleName kRules[] = {
#define X(name, number, register_name, meaning) {StreamRule::name, "rule_" #register_name},
    FASTSPLAT_STREAM_RULES(X)
#undef X
};
const char* bin_of(StreamRule rule) {
  return std::find_if(std::begin(kRules), std::end(kRules), [&](const RuleName& one) { return one.rule == rule; })->bin;
}
bool checked_in_device(StreamRule rule) { return rule != StreamRule::None && cmodel::checked_by_device(rule); }

constexpr const char* kOtherBins[] = {"open_tile_is_ended",
                                      "rest_is_swallowed",
                                      "works_after_soft_reset",
                                      "works_after_reset",
                                      "interrupt",
                                      "error_interrupt_cleared_while_the_error_lasts",
                                      "soft_reset_raises_no_error",
                                      "soft_reset_in_a_tile",
                                      "soft_reset_while_a_picture_goes_out",
                                      "next_frame_offered_in_a_soft_reset"};

}  // namespace

Coverage refusal_bins() {
  Coverage bins;
  for (const auto& [rule, name] : kRules) {
    if (checked_in_device(rule)) bins.declare("refusal", name);
  }
  for (const char* name : kOtherBins) bins.declare("refusal", name);
  for (const char* name : mid_frame_bins()) bins.declare("refusal", name);
  for (const char* name : frame_after_frame_bins()) bins.declare("refusal", name);
  return bins;
}

DirectedResult check_refusals(const cmodel::Config& config, const MakeDevice& make) {
  Check check;
  const Beats beats = small_stream(config);
  Frames frames(config, make, check);
  const auto soft = check.bin("refusal", "works_after_soft_reset"), hard = check.bin("refusal", "works_after_reset"),
             interrupt = check.bin("refusal", "interrupt"),
             cleared = check.bin("refusal", "error_interrupt_cleared_while_the_error_lasts"),
             silent = check.bin("refusal", "soft_reset_raises_no_error");
  // A frame's interrupts: its tiles', then its own.
  using namespace cmodel;
  check.equal("IRQ after reset", 0, frames.read(kRegIrq), interrupt);
  check.equal("IRQ_MASK after reset", 0, frames.read(kRegIrqMask), interrupt);
  frames.good("a frame without tables or tiles", {beats.front(), beats.back()}, soft);
  frames.good("the first frame", beats, soft);
  check.equal("IRQ after a frame", kIrqFrame | kIrqTile, frames.read(kRegIrq), interrupt);
  check.equal("masked", 0, frames.device().interrupt() ? 1 : 0, interrupt);
  frames.write(kRegIrqMask, kIrqError);
  check.equal("of another kind", 0, frames.device().interrupt() ? 1 : 0, interrupt);
  for (const std::uint32_t bit : {kIrqFrame, kIrqTile}) {
    frames.write(kRegIrqMask, bit);
    check.equal("IRQ_MASK reads", bit, frames.read(kRegIrqMask), interrupt);
    check.equal("interrupt", 1, frames.device().interrupt() ? 1 : 0, interrupt);
    frames.write(kRegIrq, bit);
    frames.read(kRegIrq);
    check.equal("taken back", 0, frames.device().interrupt() ? 1 : 0, interrupt);
  }
  check.equal("writing 1 clears IRQ", 0, frames.read(kRegIrq), interrupt);
  frames.write(kRegIrqMask, kIrqError);

  int number = 0;
  for (const Violation& violation : violations(config, beats)) {
    Beats spoiled = beats;
    violation.commit(spoiled);
    const auto expected = refused_by_model(config, spoiled);
    const auto bin = check.bin("refusal", bin_of(violation.rule));
    check.equal(violation.name + ": the model's rule", static_cast<std::uint64_t>(violation.rule),
                expected ? static_cast<std::uint64_t>(expected->rule) : 0, bin);
    if (!expected) continue;
    check.result.refused[bin_of(expected->rule)] += frames.bad(violation.name, spoiled, *expected, bin) ? 1 : 0;
    check.equal("interrupt of an error", 1, frames.device().interrupt() ? 1 : 0, interrupt);
    check.equal("IRQ of an error", kIrqError, frames.read(kRegIrq) & (kIrqError | kIrqFrame), interrupt);
    // Once cleared it stays so, though the error lasts and beats are refused again.
    frames.write(kRegIrq, kIrqError | kIrqTile);
    frames.device().refuse(spoiled[expected->beat]);
    check.equal("IRQ, error, cleared", 0, frames.read(kRegIrq) & kIrqError, cleared);
    check.equal("interrupt, cleared", 0, frames.device().interrupt() ? 1 : 0, cleared);
    check.equal("STATUS, error, with its interrupt cleared", kStatusError, frames.read(kRegStatus) & kStatusError,
                cleared);
    const bool softly = number % 8 != 0;
    if (softly)
      frames.device().soft_reset();
    else
      frames.device().warm_reset();
    if (softly)
      check.equal("IRQ, error, after a soft reset", 0, frames.read(kRegIrq) & kIrqError, silent);
    else
      frames.write(kRegIrqMask, kIrqError);
    for (const auto& reg : {kRegStatus, kRegError, kRegErrorBeat})
      check.equal(std::string(reg.name) + " after a reset", 0, frames.read(reg), softly ? soft : hard);
    ++number;
    frames.good("a frame after " + violation.name, beats, softly ? soft : hard);
    frames.write(kRegIrq, kIrqFrame | kIrqTile);
  }

  // Soft resets behind each kind of record, at once and later.
  const auto in_tile = check.bin("refusal", "soft_reset_in_a_tile"),
             in_picture = check.bin("refusal", "soft_reset_while_a_picture_goes_out"),
             at_once = check.bin("refusal", "next_frame_offered_in_a_soft_reset");
  const auto records = records_of(beats);
  for (std::size_t i = 0; i < records.size(); i += 1 + records.size() / 24) {
    const std::size_t end = i + 1 < records.size() ? records[i + 1].at : beats.size();
    const bool picture = records[i].opcode == Opcode::EndTile;
    const std::string what = "soft reset after beat " + std::to_string(end);
    for (const int wait : {2, 9}) frames.cut(what, std::span(beats).first(end), wait, picture ? in_picture : in_tile);
    frames.cut(what + " and the next frame", std::span(beats).first(end), static_cast<int>(i % 3), at_once, beats);
  }
  for (const auto& [at, opcode] : records) {
    if (opcode != Opcode::EndTile) continue;
    frames.cut("soft reset after end_tile", std::span(beats).first(at + 1), 4, in_picture);
    frames.cut("soft reset after end_tile and the next frame", std::span(beats).first(at + 1), 4, at_once, beats);
  }
  frames.good("a frame after these refusals", beats, soft);
  check_mid_frame(config, make, frames, beats, check);
  check_frame_after_frame(config, frames, beats, check);
  return check.result;
}

DirectedResult check_damage(const cmodel::Config& config, const MakeDevice& make, std::uint64_t seed, int streams) {
  Check check;
  const Beats beats = small_stream(config);
  Frames frames(config, make, check);
  Random random(seed);
  const auto refused = check.bin("damage", "refused"), legal = check.bin("damage", "still_legal");
  bool after_reset = true;
  for (int i = 0; i < streams; ++i) {
    Beats damaged = beats;
    const auto any = [&] {
      return static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(damaged.size()) - 1));
    };
    // Tables are most of a stream; half of the damage is done behind them.
    const auto record = [&] {
      const auto records = records_of(damaged);
      return random.chance(50)
                 ? any()
                 : records[static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(records.size()) - 1))]
                       .at;
    };
    for (std::int64_t times = random.between(1, 3); times > 0; --times) {
      const std::size_t at = std::min(record(), damaged.size() - 1);
      const auto word = static_cast<std::size_t>(random.between(0, std::int64_t{cmodel::kBeatWords} - 1));
      switch (random.between(0, 5)) {
        case 0:
          damaged[at][word] ^= 1U << random.between(0, 31);
          break;
        case 1:
          damaged[at][word] = static_cast<std::uint32_t>(random.next());
          break;
        case 2:
          damaged[at][word] += random.chance(50) ? 1U : ~0U;
          break;
        case 3:
          damaged[at] = damaged[any()];
          break;
        case 4:
          if (damaged.size() > 2) damaged.erase(damaged.begin() + static_cast<std::ptrdiff_t>(at));
          break;
        default:
          damaged.insert(damaged.begin() + static_cast<std::ptrdiff_t>(at), cmodel::Beat(damaged[any()]));
      }
    }
    // Behind a reset beats in front of a begin_frame are dropped (M-top-6).
    if (frames.device().sliced() && after_reset) {
      const auto begin = std::ranges::find_if(damaged, begins_frame);
      frames.device().drop({damaged.begin(), begin});
      damaged.erase(damaged.begin(), begin);
      if (damaged.empty()) continue;
    }
    // The beats after an end_frame are another frame.
    const auto end = first_end(config, damaged);
    if (end) damaged.resize(*end);
    const std::string what = "damaged stream " + std::to_string(i);
    if (const auto expected = refused_by_model(config, damaged)) {
      if (!checked_in_device(expected->rule)) continue;  // an ellipse's shape: devices do not check it
      after_reset = true;
      check.result.refused[bin_of(expected->rule)] += frames.bad(what, damaged, *expected, refused) ? 1 : 0;
      frames.forgive();
    } else if (end) {
      frames.good(what, damaged, legal);
      after_reset = false;
    } else {  // it was cut: a soft reset ends it
      frames.cut(what, damaged, 2, legal, i % 2 == 0 ? Beats{} : beats);
      after_reset = i % 2 == 0;
    }
  }
  return check.result;
}

}  // namespace fastsplat::testbench
