#include "testbench/stimulus/directed.hpp"

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "cmodel/model.hpp"
#include "cmodel/register_map.hpp"
#include "cmodel/stream_layout.hpp"
#include "testbench/check/verify.hpp"
#include "testbench/stimulus/stimulus.hpp"

namespace fastsplat::testbench {
namespace {

/// Cycles for which an answer is left waiting.
constexpr int kWait = 3;
constexpr std::uint32_t kErrorBit = 1 << 1;
/// Cycles beyond any wait within a small stream.
constexpr std::uint64_t kTimeout = 20000;
/// Cycles after the end of a sheet or a tile in which a reset comes: the pipe, a walk of some blocks.
constexpr int kWaits = 24;

constexpr const char* kRegisterBins[] = {
    "identity",          "counters",           "counters_cleared",     "control_without_clear",
    "status_busy",       "status_idle",        "unknown_read_refused", "unknown_write_refused",
    "read_answer_waits", "write_answer_waits", "half_write_waits",     "reset_drops_answers"};
struct ResetBin {
  cmodel::Opcode after;
  const char* name;
  bool goes_on = false;  ///< what it begins goes on without any beat
};
constexpr ResetBin kResetBins[] = {
    {cmodel::Opcode::LoadTable, "after_load_table"},   {cmodel::Opcode::BeginTile, "after_begin_tile"},
    {cmodel::Opcode::BeginSheet, "after_begin_sheet"}, {cmodel::Opcode::Splat, "after_splat"},
    {cmodel::Opcode::CullBlock, "after_cull_block"},   {cmodel::Opcode::EndSheet, "after_end_sheet", true},
    {cmodel::Opcode::EndTile, "after_end_tile", true}, {cmodel::Opcode::EndFrame, "after_end_frame"}};
struct Refusal {
  const char* name;
  cmodel::Field field;
  enum { BeginFrame, InASheet, LastRecord } where = BeginFrame;
  int by = 0;  ///< added to the field; 0: a bit that no opcode has is flipped
};
// A number just above and just below: whoever compares with less than equality believes one of them.
constexpr Refusal kRefusals[] = {{"wrong_magic", cmodel::layout::kFrameMagic, Refusal::BeginFrame, 1},
                                 {"wrong_magic", cmodel::layout::kFrameMagic, Refusal::BeginFrame, -1},
                                 {"wrong_version", cmodel::layout::kFrameVersion, Refusal::BeginFrame, 1},
                                 {"wrong_version", cmodel::layout::kFrameVersion, Refusal::BeginFrame, -1},
                                 {"wrong_hash_low", cmodel::layout::kFrameHashLow, Refusal::BeginFrame, 1},
                                 {"wrong_hash_low", cmodel::layout::kFrameHashLow, Refusal::BeginFrame, -1},
                                 {"wrong_hash_high", cmodel::layout::kFrameHashHigh, Refusal::BeginFrame, 1},
                                 {"wrong_hash_high", cmodel::layout::kFrameHashHigh, Refusal::BeginFrame, -1},
                                 {"unknown_first_opcode", cmodel::layout::kOpcode},
                                 {"unknown_last_opcode", cmodel::layout::kOpcode, Refusal::LastRecord},
                                 {"unknown_opcode_in_a_sheet", cmodel::layout::kOpcode, Refusal::InASheet}};
constexpr const char* kAfterRefusal[] = {"rest_is_swallowed", "works_after_reset"};

/// A record: its first beat, and of what kind it is. Words of tables are none, whatever they look like.
struct Record {
  std::size_t at;
  cmodel::Opcode opcode;
};

std::vector<Record> records_of(const std::vector<cmodel::Beat>& beats) {
  constexpr std::size_t kWords = std::tuple_size_v<cmodel::Beat>;
  std::vector<Record> out;
  for (std::size_t at = 0; at < beats.size(); ++at) {
    out.push_back({at, static_cast<cmodel::Opcode>(get(beats[at], cmodel::layout::kOpcode))});
    if (out.back().opcode == cmodel::Opcode::LoadTable)
      at += (cmodel::announced_words(beats[at]) + kWords - 1) / kWords;
  }
  return out;
}

/// The first of the small streams that has a cull block: not every one has, and every record is wanted. The last that
/// is looked at where none has, whose bins then stay empty.
std::vector<cmodel::Beat> small_stream(const cmodel::Config& config) {
  constexpr std::uint64_t kMostSeeds = 32;
  std::vector<cmodel::Beat> beats;
  for (std::uint64_t seed = 1; seed <= kMostSeeds; ++seed) {
    beats = write_document(config, make_stimulus(config, StimulusClass::Mixed, seed, 40).document);
    const auto records = records_of(beats);
    if (std::ranges::find(records, cmodel::Opcode::CullBlock, &Record::opcode) != records.end()) break;
  }
  return beats;
}

/// The beat of its begin_sheet.
std::size_t second_sheet(const std::vector<cmodel::Beat>& beats) {
  int sheets = 0;
  for (const auto& [at, opcode] : records_of(beats)) {
    if (opcode == cmodel::Opcode::BeginSheet && ++sheets == 2) return at;
  }
  return beats.size() - 2;
}

class Check {
 public:
  DirectedResult result;
  Coverage::Id bin(const char* group, const char* name) { return result.coverage.declare(group, name); }
  void equal(const std::string& what, std::uint64_t expected, std::uint64_t got, Coverage::Id bin) {
    ++result.comparisons;
    if (expected == got)
      result.coverage.hit(bin);
    else
      result.failures.push_back(what + ": expected " + std::to_string(expected) + ", got " + std::to_string(got));
  }
};

std::uint64_t read_counter(RtlDevice& device, int number) {
  const auto address = cmodel::kRegCounters.address + 8 * static_cast<std::uint32_t>(number);
  const std::uint64_t low = device.read_register(address).word;
  return low | std::uint64_t{device.read_register(address + 4).word} << 32;
}

}  // namespace

Coverage directed_bins() {
  Coverage bins;
  for (const char* name : kRegisterBins) bins.declare("register", name);
  for (const Refusal& refusal : kRefusals) bins.declare("refusal", refusal.name);
  for (const char* name : kAfterRefusal) bins.declare("refusal", name);
  for (const ResetBin& bin : kResetBins) bins.declare("short_reset", bin.name);
  return bins;
}

DirectedResult check_registers(const cmodel::Config& config, const MakeDevice& make) {
  Check check;
  const auto identity = check.bin("register", "identity"), counters = check.bin("register", "counters"),
             cleared = check.bin("register", "counters_cleared"), kept = check.bin("register", "control_without_clear"),
             busy = check.bin("register", "status_busy"), idle = check.bin("register", "status_idle"),
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
  check.equal("STATUS before a frame", 0, read(cmodel::kRegStatus).word, idle);

  const auto beats = small_stream(config);
  cmodel::Model model(config, cmodel::StreamScope::Whole, pixels);
  model.consume(beats);
  // Up to the last tile's last record but one: a tile is open.
  device->consume(std::span(beats).first(beats.size() - 2));
  check.equal("STATUS in a tile", 1, read(cmodel::kRegStatus).word, busy);
  device->consume(std::span(beats).last(2));
  device->finish();
  check.equal("STATUS after a frame", 0, read(cmodel::kRegStatus).word, idle);

  const auto all_counters = [&](bool zero, Coverage::Id bin) {
    int number = 0;
    model.counters().for_each([&](const char* name, std::uint64_t value, const char*) {
      check.equal(std::string("counter ") + name, zero ? 0 : value, read_counter(*device, number++), bin);
    });
  };
  all_counters(false, counters);
  // Below the counters, between two of them, and above the last; while there is something to tell and to clear.
  int number = 0;
  model.counters().for_each([&](const char*, std::uint64_t, const char*) { ++number; });
  const auto beyond = cmodel::kRegCounters.address + 8 * (static_cast<std::uint32_t>(number) + 5);
  for (const std::uint32_t address :
       {cmodel::kRegControl.address + 4, cmodel::kRegCounters.address + 1, cmodel::kRegCounters.address + 2,
        cmodel::kRegCounters.address + 3, beyond, 0xffcU}) {
    read(cmodel::kRegMagic);  // whose word is not to be told again
    const auto answer = device->read_register(address);
    check.equal("unknown read answers SLVERR", 0, answer.okay ? 1 : 0, unknown_read);
    check.equal("unknown read gives", 0, answer.word, unknown_read);
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

  // A write is both its halves: one alone is neither taken nor answered, and clears nothing.
  device->consume(beats);
  device->finish();
  for (const auto which : {WriteHalf::Address, WriteHalf::Data}) {
    check.equal("half a write is taken", 0,
                device->takes_half_write(which, cmodel::kRegControl.address, 1, kWait) ? 1 : 0, half);
  }
  check.equal("half a write clears the counters", 0, read_counter(*device, 0) == 0 ? 1 : 0, half);
  for (const int cycles : {1, kResetCycles}) {
    device->leave_answers_waiting();
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

DirectedResult check_refusals(const cmodel::Config& config, const MakeDevice& make) {
  Check check;
  const auto beats = small_stream(config);
  cmodel::NullPixels pixels;
  const auto device = make(pixels, {});
  const auto swallowed = check.bin("refusal", "rest_is_swallowed"),
             recovers = check.bin("refusal", "works_after_reset");
  for (const Refusal& refusal : kRefusals) {
    // Of the second sheet: its buffer is never given back, and what would wait for it is swallowed all the same.
    const std::size_t at = refusal.where == Refusal::BeginFrame ? 0
                           : refusal.where == Refusal::InASheet ? second_sheet(beats) + 1
                                                                : beats.size() - 1;
    const auto bin = check.bin("refusal", refusal.name);
    auto spoiled = beats;
    auto& beat = spoiled[at];
    const auto right = get(beat, refusal.field);
    const auto value = refusal.by == 0 ? right ^ 0x80 : right + static_cast<std::uint64_t>(refusal.by);
    beat[static_cast<std::size_t>(refusal.field.word)] &= ~field_mask(refusal.field);
    put(beat, refusal.field, value);
    bool refused = false;
    try {
      device->consume(std::span(spoiled).first(at + 1));
      // Refused in the cycle in which it lies in the register: look there.
      device->read_register(cmodel::kRegStatus.address);
    } catch (const UserError& error) {
      refused = error.code() == ExitCode::Simulation;
    }
    check.equal(std::string(refusal.name) + " is refused", 1, refused ? 1 : 0, bin);
    const std::uint32_t status = device->read_register(cmodel::kRegStatus.address).word;
    const auto opcode = static_cast<std::uint32_t>(get(beat, cmodel::layout::kOpcode));
    check.equal(std::string(refusal.name) + ": STATUS", kErrorBit | opcode << 8, status & ~std::uint32_t{1}, bin);
    const std::uint64_t splats = device->counters().splats;
    const auto waits = [&] {
      const auto stalls = device->cycle_counters();
      return stalls.stall_table + stalls.stall_buffer + stalls.stall_tile;
    };
    const std::uint64_t waited = waits();
    device->consume(beats);
    check.equal("splats after a refusal", splats, device->counters().splats, swallowed);
    check.equal("cycles that a swallowed record waits", waited, waits(), swallowed);
    cmodel::Beat another{};
    another[0] = 0xff;
    device->consume({&another, 1});
    check.equal("STATUS tells the first refusal", status & ~std::uint32_t{1},
                device->read_register(cmodel::kRegStatus.address).word & ~std::uint32_t{1}, swallowed);
    device->warm_reset();
    check.equal("STATUS after a reset", 0, device->read_register(cmodel::kRegStatus.address).word, recovers);
  }
  device->consume(beats);
  device->finish();
  cmodel::Model model(config, cmodel::StreamScope::Whole, pixels);
  model.consume(beats);
  check.equal("counters after a refusal and a reset", 1, device->counters() == model.counters() ? 1 : 0, recovers);
  return check.result;
}

DirectedResult check_short_resets(const cmodel::Config& config, const MakeDevice& make) {
  Check check;
  const auto beats = small_stream(config);
  VerifyOptions options;
  options.config = config;
  options.reset_cycles = 1;
  options.device = make;
  options.timeout = kTimeout;
  const auto records = records_of(beats);
  for (const ResetBin& reset : kResetBins) {
    const auto bin = check.bin("short_reset", reset.name);
    std::vector<std::size_t> all;
    for (const auto& [at, opcode] : records) {
      if (opcode == reset.after) all.push_back(at);
    }
    if (all.empty()) continue;
    // The first of each kind, its last, and one between: more of the same are more of the same.
    for (const std::size_t at : std::set{all.front(), all[all.size() / 2], all.back()}) {
      const int last_wait = reset.goes_on && at == all.back() ? kWaits : 0;
      for (options.reset_wait = 0; options.reset_wait <= last_wait; options.reset_wait += 3) {
        options.reset_after = at + 1;
        options.ready = at % 2 == 0 ? "always" : "every-3";
        const auto result = verify(source_of(beats), options);
        check.result.comparisons += result.check.comparisons;
        check.equal(std::string("a reset of one cycle ") + reset.name + ", beat " + std::to_string(at) + ": passes" +
                        (result.error.empty() ? "" : " (" + result.error + ")"),
                    1, result.verdict == Verdict::Pass ? 1 : 0, bin);
      }
    }
  }
  return check.result;
}

}  // namespace fastsplat::testbench
