#include <algorithm>
#include <optional>

#include "cmodel/register_map.hpp"
#include "testbench/check/checker.hpp"
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
bool judged_by_device(StreamRule rule) { return rule != StreamRule::None && rule != StreamRule::Whole; }

constexpr const char* kOtherBins[] = {"open_tile_is_ended",
                                      "rest_is_swallowed",
                                      "works_after_soft_reset",
                                      "works_after_reset",
                                      "interrupt",
                                      "soft_reset_in_a_tile",
                                      "soft_reset_while_a_picture_goes_out"};

/// From a cycle on.
class NotBefore final : public cmodel::Willing {
 public:
  std::uint64_t first = 0;
  std::uint64_t next(std::uint64_t cycle) const override { return std::max(cycle, first); }
};

/// Told what the device shows; passes it to whoever checks the frame at hand.
struct Relay final : RawTapSink {
  Checker* to = nullptr;
  void on_raw(const RawTap& tap) override {
    if (to != nullptr) to->on_raw(tap);
  }
  void accept(const cmodel::Beat& beat) override {
    if (to != nullptr) to->accept(beat);
  }
};

/// Where the model refuses the stream, as a device does that may be given any tiles.
struct Refused {
  StreamRule rule;
  std::size_t beat;
};
std::optional<Refused> refused_by_model(const cmodel::Config& config, const Beats& beats) {
  cmodel::StreamDecode decode(config, cmodel::StreamScope::Subset);
  for (std::size_t i = 0; i < beats.size(); ++i) {
    try {
      decode.feed(beats[i]);
    } catch (const cmodel::StreamRefusal& refusal) {
      return Refused{refusal.rule(), i};
    }
  }
  return std::nullopt;
}

/// The beats up to and with the end_frame that a device takes; nothing if it takes none.
std::optional<std::size_t> first_end(const cmodel::Config& config, const Beats& beats) {
  cmodel::StreamDecode decode(config, cmodel::StreamScope::Subset);
  try {
    for (std::size_t i = 0; i < beats.size(); ++i) {
      const cmodel::Record* record = decode.feed(beats[i]);
      if (record != nullptr && std::holds_alternative<cmodel::EndFrame>(*record)) return i + 1;
    }
  } catch (const cmodel::StreamRefusal&) {
    // Refused before any end.
  }
  return std::nullopt;
}

/// What ends the tile that is open after these beats; nothing if none is.
struct Closers {
  Beats beats;
  bool in_table = false;  ///< it is a table that is open
};
Closers closers_of(std::span<const cmodel::Beat> beats) {
  namespace layout = cmodel::layout;
  Closers out;
  const Beats all(beats.begin(), beats.end());
  const cmodel::Beat *tile = nullptr, *sheet = nullptr;  // open
  std::uint64_t sheets = 0, splats = 0;
  for (const auto& [at, opcode] : records_of(all)) {
    if (opcode == Opcode::LoadTable) out.in_table = at + cmodel::announced_beats(all[at]) >= all.size();
    if (opcode == Opcode::BeginTile) tile = &all[at], sheets = 0;
    if (opcode == Opcode::BeginSheet) sheet = &all[at], ++sheets, splats = 0;
    if (opcode == Opcode::Splat) ++splats;
    if (opcode == Opcode::EndSheet) sheet = nullptr;
    if (opcode == Opcode::EndTile) tile = nullptr;
  }
  const auto end = [&](Opcode opcode, const cmodel::Field& number, std::int64_t value, const cmodel::Field& count,
                       std::uint64_t counted) {
    cmodel::Beat beat{};
    put(beat, layout::kOpcode, static_cast<std::uint64_t>(opcode));
    put(beat, number, static_cast<std::uint64_t>(value));
    put(beat, count, counted);
    out.beats.push_back(beat);
  };
  if (sheet != nullptr)
    end(Opcode::EndSheet, layout::kEndSheetNumber, get(*sheet, layout::kSheetNumber), layout::kEndSheetSplats, splats);
  if (tile != nullptr)
    end(Opcode::EndTile, layout::kEndTileNumber, get(*tile, layout::kTileNumber), layout::kEndTileSheets, sheets);
  return out;
}

/// A device that is fed one frame after the other, each under a checker of its own.
class Frames {
 public:
  Frames(const cmodel::Config& config, const MakeDevice& make, Check& check) : config_(config), check_(check) {
    RtlOptions options;
    options.taps = &relay_;
    options.timeout = kTimeout;
    device_ = make(none_, options);
  }
  RtlDevice& device() { return *device_; }

  /// A frame that nothing is wrong with.
  void good(const std::string& what, const Beats& beats, Coverage::Id bin) {
    begin();
    device_->consume(beats);
    end(what, bin, false);
  }

  /// A frame of which the model refuses a beat. The device is left with its error.
  void bad(const std::string& what, const Beats& beats, const Refused& expected, Coverage::Id bin) {
    const std::size_t failures = check_.result.failures.size();
    begin();
    const auto before = std::span(beats).first(expected.beat);
    device_->consume(before);
    const std::uint64_t aborted = device_->aborted_tiles();
    const auto taken = device_->refuse(beats[expected.beat]);
    check_.equal(what + ": refused", 1, taken ? 1 : 0, bin);
    const Closers closers = closers_of(before);
    if (taken) source_.first = *taken + 1;
    for (const auto& beat : closers.beats) checker_->accept(beat);
    const auto opcode = static_cast<std::uint32_t>(get(beats[expected.beat], cmodel::layout::kOpcode));
    const auto error = [&] {
      check_.equal(what + ": STATUS, error", 1, read(cmodel::kRegStatus) >> 1 & 1, bin);
      check_.equal(what + ": ERROR", static_cast<std::uint32_t>(expected.rule) | opcode << 8, read(cmodel::kRegError),
                   bin);
      check_.equal(what + ": ERROR_BEAT", expected.beat, read(cmodel::kRegErrorBeat), bin);
    };
    error();
    end(what, closers.beats.empty() ? bin : check_.bin("refusal", "open_tile_is_ended"), closers.in_table);
    check_.equal(what + ": tiles marked as cut short", aborted + (closers.beats.empty() ? 0 : 1),
                 device_->aborted_tiles(), bin);
    // What comes after it changes nothing, and is not what ERROR tells.
    const auto swallowed = check_.bin("refusal", "rest_is_swallowed");
    const auto counters = device_->counters();
    const auto cycles = device_->cycle_counters().busy;
    for (const auto& beat : std::span(beats).subspan(expected.beat)) device_->refuse(beat);
    check_.equal(what + ": counters after the rest", 1, counters == device_->counters() ? 1 : 0, swallowed);
    check_.equal(what + ": busy cycles after the rest", cycles, device_->cycle_counters().busy, swallowed);
    error();
    check_.result.refused[bin_of(expected.rule)] += check_.result.failures.size() == failures ? 1 : 0;
  }

  /// A soft reset behind some beats of a frame; `wait`: cycles, about, before it.
  void cut(const std::string& what, std::span<const cmodel::Beat> beats, int wait, Coverage::Id bin) {
    begin();
    device_->consume(beats);
    for (int i = 0; i < wait; ++i) read(cmodel::kRegStatus);
    const Closers closers = closers_of(beats);
    for (const auto& beat : closers.beats) checker_->accept(beat);
    device_->soft_reset();
    check_.equal(what + ": no error", 0, read(cmodel::kRegStatus), bin);
    relay_.to = nullptr;
    if (closers.in_table) return;
    // When the reset came is not the cycle model's to know.
    const CheckReport report = checker_->finish();
    told(what, report, bin);
  }

  std::uint32_t read(const cmodel::Register& reg) { return device_->read_register(reg.address).word; }
  void write(const cmodel::Register& reg, std::uint32_t word) { device_->write_register(reg.address, word); }

 private:
  static constexpr std::uint64_t kTimeout = 200000;  ///< beyond any wait within a small stream

  void begin() {
    write(cmodel::kRegControl, cmodel::kControlClear);
    source_.first = 0;
    checker_.emplace(config_, cmodel::StreamScope::Subset, none_, CheckOptions{.source = &source_});
    relay_.to = &*checker_;
    checker_->start(device_->cycles());
  }
  void end(const std::string& what, Coverage::Id bin, bool in_table) {
    device_->finish();
    relay_.to = nullptr;
    if (in_table) return;  // neither model knows an end there, and nothing but words was taken
    told(what, checker_->finish(device_->counters(), device_->cycle_counters()), bin);
  }
  void told(const std::string& what, const CheckReport& report, Coverage::Id bin) {
    check_.result.comparisons += report.comparisons;
    std::string how = what + ": mismatches";
    if (report.first)
      how += ", first at tap " +
             std::to_string(static_cast<int>(report.first->model ? report.first->model->tap : report.first->rtl->tap));
    if (!report.differences.empty()) how += " (" + report.differences.front() + ")";
    check_.equal(how, 0, report.mismatches, bin);
  }

  cmodel::Config config_;
  Check& check_;
  cmodel::NullPixels none_;
  Relay relay_;
  NotBefore source_;
  std::unique_ptr<RtlDevice> device_;
  std::optional<Checker> checker_;
};

}  // namespace

Coverage refusal_bins() {
  Coverage bins;
  for (const auto& [rule, name] : kRules) {
    if (judged_by_device(rule)) bins.declare("refusal", name);
  }
  for (const char* name : kOtherBins) bins.declare("refusal", name);
  return bins;
}

DirectedResult check_refusals(const cmodel::Config& config, const MakeDevice& make) {
  Check check;
  const Beats beats = small_stream(config);
  Frames frames(config, make, check);
  const auto soft = check.bin("refusal", "works_after_soft_reset"), hard = check.bin("refusal", "works_after_reset"),
             interrupt = check.bin("refusal", "interrupt");
  // A frame's interrupts: its tiles', then its own.
  using namespace cmodel;
  check.equal("IRQ after reset", 0, frames.read(kRegIrq), interrupt);
  check.equal("IRQ_MASK after reset", 0, frames.read(kRegIrqMask), interrupt);
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
  check.equal("IRQ is cleared by what is written", 0, frames.read(kRegIrq), interrupt);
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
    frames.bad(violation.name, spoiled, *expected, bin);
    check.equal("interrupt of an error", 1, frames.device().interrupt() ? 1 : 0, interrupt);
    check.equal("IRQ of an error", kIrqError, frames.read(kRegIrq) & (kIrqError | kIrqFrame), interrupt);
    frames.write(kRegIrq, kIrqError | kIrqTile);
    const bool softly = number % 8 != 0;
    if (softly)
      frames.device().soft_reset();
    else
      frames.device().warm_reset();
    if (!softly) frames.write(kRegIrqMask, kIrqError);
    for (const auto& reg : {kRegStatus, kRegError, kRegErrorBeat})
      check.equal(std::string(reg.name) + " after a reset", 0, frames.read(reg), softly ? soft : hard);
    if (number++ % 16 == 0 || !softly) {
      frames.good("a frame after " + violation.name, beats, softly ? soft : hard);
      frames.write(kRegIrq, kIrqFrame | kIrqTile);
    }
  }

  // Soft resets behind each kind of record, at once and later.
  const auto in_tile = check.bin("refusal", "soft_reset_in_a_tile"),
             in_picture = check.bin("refusal", "soft_reset_while_a_picture_goes_out");
  const auto records = records_of(beats);
  for (std::size_t i = 0; i < records.size(); i += 1 + records.size() / 24) {
    const std::size_t end = i + 1 < records.size() ? records[i + 1].at : beats.size();
    const bool picture = records[i].opcode == Opcode::EndTile;
    for (const int wait : {2, 9})
      frames.cut("soft reset behind beat " + std::to_string(end), std::span(beats).first(end), wait,
                 picture ? in_picture : in_tile);
  }
  for (const auto& [at, opcode] : records) {
    if (opcode == Opcode::EndTile)
      frames.cut("soft reset behind end_tile", std::span(beats).first(at + 1), 4, in_picture);
  }
  frames.good("a frame after all that", beats, soft);
  return check.result;
}

DirectedResult check_damage(const cmodel::Config& config, const MakeDevice& make, std::uint64_t seed, int streams) {
  Check check;
  const Beats beats = small_stream(config);
  Frames frames(config, make, check);
  Random random(seed);
  const auto refused = check.bin("damage", "refused"), legal = check.bin("damage", "still_legal");
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
    // What comes behind an end_frame is another frame.
    const auto end = first_end(config, damaged);
    if (end) damaged.resize(*end);
    const std::string what = "damaged stream " + std::to_string(i);
    if (const auto expected = refused_by_model(config, damaged)) {
      frames.bad(what, damaged, *expected, refused);
      frames.device().soft_reset();
    } else if (end) {
      frames.good(what, damaged, legal);
    } else {  // it was cut: a soft reset ends it
      frames.cut(what, damaged, 2, legal);
    }
  }
  return check.result;
}

}  // namespace fastsplat::testbench
