// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/directed.hpp"

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "cmodel/io/register_fields.hpp"
#include "cmodel/model.hpp"
#include "cmodel/stream/stream_layout.hpp"
#include "testbench/check/verify.hpp"
#include "testbench/stimulus/directed_stream.hpp"

namespace fastsplat::testbench {
namespace {

/// Cycles for which an answer is left waiting.
constexpr int kWait = 3;
/// Cycles beyond any wait within a small stream.
constexpr std::uint64_t kDirectedTimeout = 20000;
/// Cycles after the end of a sheet or a tile in which a reset comes: the pipe, a walk of some blocks.
constexpr int kWaits = 24;
/// The same of densities: a walk of some blocks, the pixel stage and the compositor behind it.
constexpr int kDensityWaits = 80;

/// Reads for which the source is late; and more than the windows of a splat and a sheet's walk take.
constexpr int kLateReads = 24, kManyReads = 256;

constexpr const char* kRegisterBins[] = {"identity",
                                         "capabilities",
                                         "high_word_before_any_low_one",
                                         "counter_of_one_moment",
                                         "counters",
                                         "counters_cleared",
                                         "control_without_clear",
                                         "status_busy",
                                         "status_stays_busy",
                                         "status_idle",
                                         "unknown_read_refused",
                                         "unknown_write_refused",
                                         "read_answer_waits",
                                         "write_answer_waits",
                                         "half_write_waits",
                                         "reset_drops_answers"};
struct ResetBin {
  cmodel::Opcode after;
  const char* name;
  bool goes_on = false;  ///< its work goes on without further beats
};
constexpr ResetBin kResetBins[] = {
    {cmodel::Opcode::LoadTable, "after_load_table"},   {cmodel::Opcode::BeginTile, "after_begin_tile"},
    {cmodel::Opcode::BeginSheet, "after_begin_sheet"}, {cmodel::Opcode::Splat, "after_splat"},
    {cmodel::Opcode::CullBlock, "after_cull_block"},   {cmodel::Opcode::EndSheet, "after_end_sheet", true},
    {cmodel::Opcode::EndTile, "after_end_tile", true}, {cmodel::Opcode::EndFrame, "after_end_frame"}};

std::uint64_t read_counter(RtlDevice& device, int number) {
  const auto address = cmodel::kRegCounters.address + 8 * static_cast<std::uint32_t>(number);
  const std::uint64_t low = device.read_register(address).word;
  return low | std::uint64_t{device.read_register(address + 4).word} << 32;
}

/// In a tile that waits for input each cycle is a busy one without input. A clear taken in cycle t counts t. A read
/// taken in cycle r returns the count up to r - 2, in both words.
void count_cycles(RtlDevice& device, Check& check) {
  constexpr std::uint64_t kSeenAfter = 2;
  const auto pair = check.bin("register", "counter_of_one_moment");
  int number = 0;
#define X(name, meaning) ++number;
  FASTSPLAT_COUNTERS(X)
#undef X
  const int cycles = number, without_input = number + 1;
  for (int i = 0; i < kManyReads; ++i) device.read_register(cmodel::kRegStatus.address);
  for (const int counter : {cycles, without_input}) {
    for (const int reads : {1, 2, kLateReads}) {
      const std::uint64_t cleared = device.cycles();
      device.write_register(cmodel::kRegControl.address, cmodel::kControlClear);
      for (int i = 0; i < reads; ++i) device.read_register(cmodel::kRegStatus.address);
      const std::uint64_t read = device.cycles();
      check.equal("cycles since a clear, counter " + std::to_string(counter) + ", " + std::to_string(reads) + " reads",
                  read - kSeenAfter + 1 - cleared, read_counter(device, counter), pair);
    }
  }
}

}  // namespace

Coverage directed_bins() {
  Coverage bins;
  for (const char* name : kRegisterBins) bins.declare("register", name);
  bins.merge(refusal_bins());
  for (const ResetBin& bin : kResetBins) bins.declare("short_reset", bin.name);
  return bins;
}

DirectedResult check_registers(const cmodel::Config& config, const MakeDevice& make) {
  Check check;
  const auto identity = check.bin("register", "identity"), capabilities = check.bin("register", "capabilities"),
             no_low = check.bin("register", "high_word_before_any_low_one"),
             counters = check.bin("register", "counters"), cleared = check.bin("register", "counters_cleared"),
             kept = check.bin("register", "control_without_clear"), busy = check.bin("register", "status_busy"),
             waiting = check.bin("register", "status_stays_busy"), idle = check.bin("register", "status_idle"),
             unknown_read = check.bin("register", "unknown_read_refused"),
             unknown_write = check.bin("register", "unknown_write_refused"),
             read_waits = check.bin("register", "read_answer_waits"),
             write_waits = check.bin("register", "write_answer_waits"),
             half = check.bin("register", "half_write_waits"), dropped = check.bin("register", "reset_drops_answers");
  cmodel::NullPixels pixels;
  const auto device = make(pixels, {});
  const auto read = [&](const cmodel::Register& which) {
    const auto answer = device->read_register(which.address);
    check.equal(std::string(which.name) + " answers OKAY", 1, answer.okay ? 1 : 0, identity);
    return answer;
  };
  const std::uint64_t hash = config_hash(config);
  check.equal("MAGIC", cmodel::kStreamMagic, read(cmodel::kRegMagic).word, identity);
  check.equal("VERSION", cmodel::kStreamVersion, read(cmodel::kRegVersion).word, identity);
  check.equal("HASH_LOW", hash & 0xffffffffU, read(cmodel::kRegHashLow).word, identity);
  check.equal("HASH_HIGH", hash >> 32, read(cmodel::kRegHashHigh).word, identity);
  check.equal("CONTROL reads", 0, read(cmodel::kRegControl).word, identity);
  for (const auto& [reg, word] : cmodel::capabilities(config))
    check.equal(reg.name, word, read(reg).word, capabilities);
  check.equal("STATUS before a frame", 0, read(cmodel::kRegStatus).word, idle);

  const auto beats = small_stream(config);
  cmodel::Model model(config, cmodel::StreamScope::Whole, pixels);
  model.consume(beats);
  check.equal("high word before any low one", 0, device->read_register(cmodel::kRegCounters.address + 4).word, no_low);
  // All but the last two records: a tile is open.
  device->consume(std::span(beats).first(beats.size() - 2));
  check.equal("STATUS in a tile", 1, read(cmodel::kRegStatus).word, busy);
  // The source is late, for longer than any pipe is: nothing moves, and the tile is still open.
  for (int i = 0; i < kLateReads; ++i) read(cmodel::kRegStatus);
  check.equal("STATUS in a tile without input", 1, read(cmodel::kRegStatus).word, waiting);
  device->consume(std::span(beats).last(2));
  device->finish();
  check.equal("STATUS after a frame", 0, read(cmodel::kRegStatus).word, idle);

  const auto all_counters = [&](bool zero, Coverage::Id bin) {
    int number = 0;
    model.counters().for_each([&](const char* name, std::uint64_t value, const char*) {
      check.equal(std::string("counter ") + name, zero ? 0 : config.counter_word(value),
                  read_counter(*device, number++), bin);
    });
  };
  all_counters(false, counters);
  // Below the counters, between two of them, and above the last, while they are not 0.
  const auto beyond = cmodel::kRegCounters.address + 8 * static_cast<std::uint32_t>(cmodel::counters_of(config));
  for (const std::uint32_t address :
       {cmodel::kRegIrqMask.address + 4, cmodel::kRegCounters.address - 4, cmodel::kRegControl.address + 1,
        cmodel::kRegCounters.address + 1, cmodel::kRegCounters.address + 2, cmodel::kRegCounters.address + 3, beyond,
        0xffcU}) {
    read(cmodel::kRegMagic);  // its word must not be returned again
    const auto answer = device->read_register(address);
    check.equal("unknown read answers SLVERR", 0, answer.okay ? 1 : 0, unknown_read);
    check.equal("unknown read returns", 0, answer.word, unknown_read);
  }
  check.equal("a counter is not written", 0, device->write_register(cmodel::kRegCounters.address, 1).okay ? 1 : 0,
              unknown_write);
  check.equal("MAGIC is not written", 0, device->write_register(cmodel::kRegMagic.address, 1).okay ? 1 : 0,
              unknown_write);
  check.equal("CONTROL takes 0", 1, device->write_register(cmodel::kRegControl.address, 0).okay ? 1 : 0, kept);
  all_counters(false, kept);
  check.equal("CONTROL takes 1", 1, device->write_register(cmodel::kRegControl.address, 1, kWait).okay ? 1 : 0,
              write_waits);
  all_counters(true, cleared);

  check.equal("a waiting answer holds", cmodel::kStreamMagic,
              device->read_register(cmodel::kRegMagic.address, kWait).word, read_waits);

  device->consume(std::span(beats).first(beats.size() - 2));
  count_cycles(*device, check);
  device->consume(std::span(beats).last(2));
  device->finish();
  // A write needs both halves: one alone is neither taken nor answered, and clears nothing.
  for (const auto which : {WriteHalf::Address, WriteHalf::Data}) {
    check.equal("half a write is taken", 0,
                device->takes_half_write(which, cmodel::kRegControl.address, 1, kWait) ? 1 : 0, half);
  }
  check.equal("half a write clears the counters", 0, read_counter(*device, 0) == 0 ? 1 : 0, half);
  for (const auto& [cycles, read_too] : {std::pair{1, true}, {kResetCycles, true}, {1, false}}) {
    device->leave_answers_waiting(read_too);
    bool gone = true;
    try {
      device->warm_reset(cycles);
    } catch (const UserError&) {
      gone = false;
    }
    check.equal("answers are gone after a reset", 1, gone ? 1 : 0, dropped);
  }
  check.equal("MAGIC after a reset", cmodel::kStreamMagic, read(cmodel::kRegMagic).word, dropped);
  return check.result;
}

DirectedResult check_short_resets(const cmodel::Config& config, const MakeDevice& make) {
  Check check;
  VerifyOptions options;
  options.config = config;
  options.reset_cycles = 1;
  options.device = make;
  options.timeout = kDirectedTimeout;
  const auto reset_at = [&](const std::vector<cmodel::Beat>& beats, std::size_t at, const ResetBin& reset) {
    options.reset_after = at + 1;
    options.ready = at % 2 == 0 ? "always" : "every-3";
    const auto result = verify(source_of(beats), options);
    check.result.comparisons += result.check.comparisons;
    check.equal(std::string("a reset of one cycle ") + reset.name + ", beat " + std::to_string(at) + ", " +
                    std::to_string(options.reset_wait) + " cycles after it: passes" +
                    (result.error.empty() ? "" : " (" + result.error + ")"),
                1, result.verdict == Verdict::Pass ? 1 : 0, check.bin("short_reset", reset.name));
  };
  const auto beats = small_stream(config);
  const auto records = records_of(beats);
  for (const ResetBin& reset : kResetBins) {
    check.bin("short_reset", reset.name);
    std::vector<std::size_t> all;
    for (const auto& [at, opcode] : records) {
      if (opcode == reset.after) all.push_back(at);
    }
    if (all.empty()) continue;
    // The first of each kind, its last, and one between: more would only repeat these.
    for (const std::size_t at : std::set{all.front(), all[all.size() / 2], all.back()}) {
      const int last_wait = reset.goes_on && at == all.back() ? kWaits : 0;
      for (options.reset_wait = 0; options.reset_wait <= last_wait; options.reset_wait += 3) reset_at(beats, at, reset);
    }
  }
  // A tile of densities that ends: copy, walk and pixel stage, cycle by cycle.
  if (!config.classifies()) return check.result;
  const auto [densities, end_of_tile] = small_densities(config);
  const ResetBin& end = *std::ranges::find(kResetBins, cmodel::Opcode::EndTile, &ResetBin::after);
  for (options.reset_wait = 0; options.reset_wait <= kDensityWaits; ++options.reset_wait)
    reset_at(densities, end_of_tile, end);
  return check.result;
}

}  // namespace fastsplat::testbench
