// SPDX-License-Identifier: Apache-2.0
#include "tests/fetch/fetch_bench_helper.hpp"

#include <algorithm>
#include <deque>
#include <limits>
#include <memory>

#include "Vfs_fetch.h"
#include "Vfs_fetch___024root.h"
#include "Vfs_fetch_fastsplat_fault_pkg.h"
#include "Vfs_fetch_narrow.h"
#include "Vfs_fetch_narrow___024root.h"
#include "Vfs_fetch_narrow_fastsplat_fault_pkg.h"
#include "cmodel/cull/cull_unit.hpp"
#include "cmodel/model.hpp"
#include "testbench/device/failed_assertion.hpp"
#include "testbench/module/simulator_output.hpp"

namespace fastsplat::test {
namespace {

using cmodel::Beat;

constexpr std::uint64_t kPatience = 20'000;  ///< cycles without a beat
constexpr unsigned kVerdict = 2;             ///< error
constexpr std::uint64_t kJudged = 6;         ///< from a beat taken to its verdict: two registers of check, t0 to t3

/// The master of type Top in a run.
template <class Top>
class Bench {
 public:
  Bench(const FetchStream& stream, const FetchRun& run, FetchDevice& device)
      : stream_(stream),
        run_(run),
        device_(device),
        wanted_(stream.wanted()),
        memory_(stream.beats, stream.address, run.memory) {
    context_.threads(1);
    context_.randReset(2);
    context_.fatalOnError(false);
    context_.errorLimit(std::numeric_limits<int>::max());
    context_.assertOn(run.fault == FetchFault::None);
    testbench::take_simulator_output();
    top_ = std::make_unique<Top>(&context_);
    if (spoiled_ < stream.beats.size()) memory_.spoil(spoiled_);
  }
  ~Bench() {
    Verilated::threadContextp(&context_);
    top_->final();
    top_.reset();
  }

  FetchResult go() {
    top_->aresetn = 0;
    top_->s_axis_cmd_tvalid = top_->verdict_valid = top_->m_axi_rvalid = top_->stop = 0;
    for (int i = 0; i < 3; ++i) eval(0), eval(1);
    top_->aresetn = 1;
    const std::uint64_t rest = 200 + run_.memory.latency + run_.memory.more_latency;
    for (std::uint64_t quiet = 0; quiet < rest && out_.finding.empty(); ++cycle_) {
      clock();
      if (stopping_ && run_.again) recover();
      quiet = done() ? quiet + 1 : 0;
      if (cycle_ > last_ + kPatience) say("nothing is sent any more");
    }
    if (out_.finding.empty()) look_back();
    const auto failed = testbench::first_failed_assertion(testbench::take_simulator_output());
    if (!failed.name.empty()) say("assertion " + failed.name);
    out_.cycles = cycle_;
    out_.bursts = memory_.bursts();
    out_.most_under_way = memory_.most_under_way();
    for (const std::uint32_t times : memory_.asked()) out_.asked += times;
    return out_;
  }

 private:
  void say(const std::string& what) {
    if (out_.finding.empty()) out_.finding = "cycle " + std::to_string(cycle_) + ": " + what;
  }
  /// From `stop` to the next frame, state by state (docs/integration.md, "Fetching"; M-fetch-19): `stop` stays until
  /// the device is at rest, and verdicts before that are not errors (M-fetch-21).
  void recover() {
    if (top_->busy != 0) return;
    if (!resetting_) {
      device_.restart();
      resetting_ = true;
    } else if (device_.at_rest()) {
      resetting_ = stopping_ = offering_ = false;
      recovered_ = true;
      command_ = judged_ = 0;
      if (run_.spoiled_once) memory_.spoil(~std::size_t{0}), spoiled_ = ~std::size_t{0};
      out_.taken.clear(), out_.offered.clear(), out_.verdicts.clear();
      asked_ = sets_sent_ = 0;
      last_ = cycle_;
    }
  }
  bool done() const {
    if (stopping_ && run_.again) return false;
    if (top_->error != 0 && run_.stop_after_error > 0) return false;
    if (top_->error != 0 || stopping_) return top_->busy == 0;
    return out_.taken.size() == wanted_.size() && command_ == stream_.commands.size() && device_.at_rest();
  }
  void eval(int edge) {
    top_->aclk = static_cast<std::uint8_t>(edge);
    top_->rootp->__PVT__fastsplat_fault_pkg->selected = static_cast<std::uint32_t>(run_.fault);
    top_->eval();
  }

  void clock() {
    // What the others show in this cycle.
    // While it is stopped an illegal command is offered: it is dropped like any other (M-fetch-20).
    const bool dropped = stopping_ && !offering_;
    const bool commands = !dropped && command_ < stream_.commands.size() && (offering_ || run_.commands.at(cycle_));
    top_->s_axis_cmd_tvalid = commands || dropped ? 1 : 0;
    if (commands || dropped) {
      const auto words = cmodel::words_of(dropped ? cmodel::FetchCommand{} : stream_.commands[command_]);
      for (std::size_t i = 0; i < words.size(); ++i) top_->s_axis_cmd_tdata[i] = words[i];
    }
    const testbench::AxiAnswer answer = memory_.answer();
    top_->m_axi_arready = memory_.ready() && (!run_.shy || top_->m_axi_arvalid != 0) ? 1 : 0;
    top_->m_axi_rvalid = answer.valid ? 1 : 0;
    top_->m_axi_rlast = answer.last ? 1 : 0;
    top_->m_axi_rresp = static_cast<std::uint8_t>(answer.response);
    for (std::size_t i = 0; i < answer.data.size(); ++i) top_->m_axi_rdata[i] = answer.data[i];
    top_->m_axis_tready = device_.ready() ? 1 : 0;
    top_->stop = stopping_ ? 1 : 0;
    judge();
    eval(0);
    if ((out_.error == 0 || recovered_) && asked_ > out_.taken.size() && top_->busy == 0)
      say("not busy, and beats that were asked for have not been sent");  // M-fetch-19, step 1
    look_at_control(answer);
    const Beat* offered = look();
    if (commands && top_->s_axis_cmd_tready != 0) {
      if (command_ == 0) out_.begun = cycle_;
      ++command_;
      offering_ = false;
    } else {
      offering_ = commands;
    }
    const testbench::AxiRequest request{.valid = top_->m_axi_arvalid != 0,
                                        .address = top_->m_axi_araddr,
                                        .len = top_->m_axi_arlen,
                                        .size = top_->m_axi_arsize,
                                        .burst = top_->m_axi_arburst};
    memory_.edge(request, top_->m_axi_rready != 0);
    if (!memory_.broken().empty()) say(memory_.broken());  // M-fetch-12, M-fetch-13
    asked_ += memory_.asked_now().size();
    for (const std::size_t beat : memory_.asked_now()) {
      const int set = stream_.set_of[beat];
      if (set < 0) continue;
      const auto number = static_cast<std::size_t>(set);
      if (stream_.trusted[number]) continue;  // M-fetch-4
      if (stream_.hidden[number]) {           // M-fetch-3
        say("beat " + std::to_string(beat) + " is of a hidden set");
      } else if (number >= judged_) {
        say("beat " + std::to_string(beat) + " is asked for before its set was judged");
      }
    }
    judged_ = out_.verdicts.size();
    if (offered != nullptr && !waiting_ && stream_.block[wanted_[out_.taken.size() - 1]] >= 0) ++sets_sent_;
    out_.most_unjudged = std::max(out_.most_unjudged, sets_sent_ - std::min(sets_sent_, judged_));
    device_.edge(offered);
    eval(1);
    if (!recovered_ && ((run_.stop_after > 0 && out_.taken.size() >= run_.stop_after) ||
                        (run_.stop_at > 0 && cycle_ >= run_.stop_at) ||
                        (run_.stop_after_error > 0 && out_.error != 0 && --until_stop_ == 0)))
      stopping_ = out_.stopped = true;
    if (recovered_ && top_->error != 0)  // M-fetch-19, step 3
      say("error is " + std::to_string(top_->error) + " behind the recovery, expected 0");
    if (out_.error == 0 && top_->error != 0) out_.error = top_->error;
  }

  /// What is neither a beat nor a request's place.
  void look_at_control(const testbench::AxiAnswer& answer) {
    const bool asks = top_->m_axi_arvalid != 0, takes = top_->s_axis_cmd_tready != 0;
    if (asks && (top_->m_axi_arcache != 3 || top_->m_axi_arprot != 0)) say("another ARCACHE or ARPROT");
    if (asks && !asked_before_ && held_back_) say("asks while it is stopped or an error stands");  // M-fetch-17, -20
    if (stopping_ && !takes) say("takes no command while it is stopped");                          // M-fetch-20
    if (!stopping_ && top_->error != 0 && takes) say("takes a command while an error stands");     // M-fetch-17
    if (held_back_ && error_before_ == 0 && top_->error == kVerdict)
      say("a verdict is an error while it is stopped");  // M-fetch-21
    if (bad_ && error_before_ == 0 && top_->error != 1) say("error stays 0 after an unreadable beat");
    if (!stopping_ && top_->error == 0 && top_->busy == 0 && command_ > 0 && out_.taken.size() < ends_[command_ - 1])
      say("not busy, and beats of a command have not been sent");
    asked_before_ = asks && top_->m_axi_arready == 0;
    held_back_ = stopping_ || top_->error != 0;
    error_before_ = top_->error;
    bad_ = answer.valid && answer.response != 0;
  }
  /// Beats to be sent up to the end of each command.
  static std::vector<std::size_t> ends_of(const FetchStream& stream, const std::vector<std::size_t>& wanted) {
    std::vector<std::size_t> out;
    for (const cmodel::FetchCommand& command : stream.commands) {
      const std::uint64_t first = (command.address - stream.address) / cmodel::kBeatBytes;
      const auto end = std::ranges::lower_bound(wanted, first + command.beats + command.splats);
      out.push_back(static_cast<std::size_t>(end - wanted.begin()));
    }
    return out;
  }

  /// The device's verdict of this cycle.
  void judge() {
    const auto verdict = device_.verdict();
    const bool stray = run_.stray > 0 && cycle_ >= run_.stray && out_.error == 0 && !verdict && device_.at_rest();
    top_->verdict_valid = verdict || stray ? 1 : 0;
    if (!verdict) return;
    const std::size_t number = out_.verdicts.size();  // a pulse for each, in order (M-port-8)
    if (number == stream_.hidden.size()) return say("a verdict of nothing");
    if (verdict->hidden != stream_.hidden[number])
      say("set " + std::to_string(number) + ": another verdict than the model's");
    top_->verdict_tag = verdict->tag + (static_cast<int>(number) == run_.other_tag ? run_.other_by : 0U);
    top_->verdict_hidden = verdict->hidden ? 1 : 0;
    out_.verdicts.push_back(cycle_);
  }

  /// The beat that is offered, which must be the next one; null: none.
  const Beat* look() {
    const bool valid = top_->m_axis_tvalid != 0;
    const bool held = waiting_;
    const Beat before = beat_;
    for (std::size_t i = 0; i < beat_.size(); ++i) beat_[i] = top_->m_axis_tdata[i];
    if (held && (!valid || beat_ != before)) say("a beat is withdrawn or changed before it was taken");
    waiting_ = valid && top_->m_axis_tready == 0;
    if (!valid) return nullptr;
    const std::size_t at = out_.taken.size();
    if (at == wanted_.size()) return say("a beat behind the last"), nullptr;
    if (out_.offered.size() == at) out_.offered.push_back(cycle_);
    if (wanted_[at] == spoiled_) return say("sends what could not be read"), nullptr;  // M-fetch-18
    if (beat_ != stream_.beats[wanted_[at]])
      return say("another beat than number " + std::to_string(wanted_[at]) + " is sent"), nullptr;
    if (!waiting_) {
      out_.taken.push_back(cycle_);
      last_ = cycle_;
    }
    return &beat_;
  }

  /// When all is at rest.
  void look_back() {
    if (run_.again && !recovered_ && out_.stopped) return say("no end of the recovery");
    out_.all_sent = out_.taken.size() == wanted_.size();
    if (top_->busy != 0) return say("busy, and nothing is left to do");
    if (out_.error != run_.error && !run_.any_error)
      return say("error " + std::to_string(out_.error) + ", expected " + std::to_string(run_.error));
    if (recovered_ && !out_.all_sent) return say("not all is sent once more");
    if (out_.error != 0 || out_.stopped) return;
    std::vector<std::uint32_t> once(stream_.beats.size(), 0);
    for (const std::size_t beat : wanted_) once[beat] = 1;  // M-fetch-3: nothing is asked for in vain
    for (std::size_t i = 0; i < once.size(); ++i) {
      if (memory_.asked()[i] != once[i])
        return say("beat " + std::to_string(i) + " was asked for " + std::to_string(memory_.asked()[i]) + " times");
    }
  }

  const FetchStream& stream_;
  const FetchRun& run_;
  FetchDevice& device_;
  std::vector<std::size_t> wanted_, ends_ = ends_of(stream_, wanted_);
  testbench::AxiReadMemory memory_;
  VerilatedContext context_;
  std::unique_ptr<Top> top_;
  FetchResult out_;
  std::size_t judged_ = 0;  ///< sets, before this cycle
  std::uint64_t cycle_ = 0, last_ = 0;
  std::size_t command_ = 0;
  std::size_t asked_ = 0, sets_sent_ = 0;  ///< beats; cull_blocks
  std::size_t spoiled_ = run_.spoiled;
  std::uint64_t until_stop_ = run_.stop_after_error;
  bool waiting_ = false, offering_ = false, stopping_ = false;
  bool resetting_ = false, recovered_ = false;
  // Of the cycle before: a request waits; nothing may be requested; error; a beat that could not be read has come.
  bool asked_before_ = false, held_back_ = false, bad_ = false;
  unsigned error_before_ = 0;
  Beat beat_{};
};

}  // namespace

std::vector<std::size_t> FetchStream::wanted() const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < beats.size(); ++i) {
    const auto set = static_cast<std::size_t>(set_of[i]);
    if (set_of[i] < 0 || trusted[set] || !hidden[set]) out.push_back(i);
  }
  return out;
}

void FetchStream::trust() {
  trusted.clear();
  // Sets with splats, command by command.
  std::size_t number = 0;
  bool hid = false;
  for (const cmodel::FetchCommand& command : commands) {
    bool hides = false;
    for (const std::size_t end = number + command.sets; number < end; ++number) {
      trusted.push_back(!hid);  // M-fetch-4
      const auto splats = std::ranges::count(set_of, static_cast<int>(number));
      hides = hides || (hidden[number] && splats > 0);
    }
    if (command.splats > 0) hid = hides;  // others are passed over (M-fetch-4)
  }
}

FetchStream fetch_stream(const cmodel::Config& config, std::vector<Beat> beats, std::uint64_t address) {
  FetchStream out{.beats = std::move(beats),
                  .commands = {},
                  .address = address,
                  .set_of = {},
                  .block = {},
                  .hidden = {},
                  .trusted = {}};
  out.commands = cmodel::fetch_commands(config, out.beats, address);
  cmodel::NullPixels nowhere;
  cmodel::Model model(config, cmodel::StreamScope::Whole, nowhere);
  std::deque<int> covers;  // the next splats' sets
  std::uint64_t words = 0;
  bool tests = false;
  for (const Beat& beat : out.beats) {
    const std::uint64_t before = model.culls().hidden_sets;
    model.consume({&beat, 1});
    out.set_of.push_back(-1);
    out.block.push_back(-1);
    if (words > 0) {
      --words;
      continue;
    }
    words = cmodel::announced_beats(beat);
    const cmodel::Record record = cmodel::from_beat(beat);
    if (const auto* tile = std::get_if<cmodel::BeginTile>(&record)) tests = cmodel::culls_in(tile->mode);
    if (const auto* set = std::get_if<cmodel::CullBlock>(&record); set != nullptr && config.culls()) {
      out.block.back() = static_cast<int>(out.hidden.size());
      if (tests) covers.insert(covers.end(), set->splats, out.block.back());
      out.hidden.push_back(model.culls().hidden_sets > before);
    }
    const bool splat =
        std::holds_alternative<cmodel::SplatRecord>(record) || std::holds_alternative<cmodel::EllipseRecord>(record);
    if (!splat || covers.empty()) continue;
    out.set_of.back() = covers.front();
    covers.pop_front();
  }
  out.trust();
  return out;
}

bool PlayedDevice::ready() {
  const bool refuses = mute_ && judged_ >= run_.mute;  // and then swallows all
  taking_ = run_.ready.at(cycle_) && (refuses || waiting_.size() < run_.ahead);
  return taking_;
}

std::optional<FetchDevice::Verdict> PlayedDevice::verdict() {
  if (waiting_.empty() || waiting_.front().cycle > cycle_ || (mute_ && judged_ >= run_.mute)) return std::nullopt;
  ++judged_;
  const Waiting one = waiting_.front();
  waiting_.pop_front();
  return Verdict{one.tag, stream_.hidden[one.block]};
}

void PlayedDevice::edge(const Beat* beat) {
  if (beat != nullptr && taking_) {
    const int block = stream_.block[wanted_[taken_++]];
    if (block >= 0) {
      const std::uint64_t wait = testbench::mix(run_.seed + cycle_) % (run_.verdict_wait + 1ULL);
      last_ = std::max(last_ + 1, cycle_ + kJudged + wait);
      waiting_.push_back({static_cast<std::size_t>(block), (*beat)[1], last_});
    }
  }
  ++cycle_;
}

FetchResult run_fetch(const FetchStream& stream, const FetchRun& run, FetchDevice& device) {
  if (run.build == FetchBuild::Narrow) return Bench<Vfs_fetch_narrow>(stream, run, device).go();
  return Bench<Vfs_fetch>(stream, run, device).go();
}

}  // namespace fastsplat::test
