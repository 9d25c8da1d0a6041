// RtlDevice over one Verilated class. Included once per configuration by a generated source; nobody else needs it.
#pragma once

#include <verilated.h>
#include <verilated_fst_c.h>

#include <array>
#include <limits>
#include <span>
#include <type_traits>

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "cmodel/register_map.hpp"
#include "testbench/device/rtl_device.hpp"
#include "testbench/device/simulator_output.hpp"
#include "testbench/device/tile_assembly.hpp"

namespace fastsplat::testbench {

/// The 32-bit words of a Verilated port of any width; `small` holds those of a port that is a plain integer.
template <class Port>
std::span<const std::uint32_t> port_words(const Port& port, std::array<std::uint32_t, 2>& small) {
  if constexpr (std::is_integral_v<Port>) {
    small = {static_cast<std::uint32_t>(port), static_cast<std::uint32_t>(std::uint64_t{port} >> 32)};
    return small;
  } else {
    return {port.data(), sizeof(Port) / sizeof(std::uint32_t)};
  }
}

template <class Top>
class VerilatedDevice : public RtlDevice {
 public:
  VerilatedDevice(const cmodel::Config& config, cmodel::PixelSink& pixels, const RtlOptions& options)
      : config_(config), options_(options), tiles_(config, pixels) {
    context_.threads(1);  // the default starts idle workers
    context_.randReset(options.fill == ResetFill::Zero ? 0 : options.fill == ResetFill::One ? 1 : 2);
    context_.randSeed(static_cast<int>(options.seed % 0x7fffffff) + 1);
    context_.traceEverOn(!options.wave.empty());
    // A failing assertion is counted here and told by cycle(); the default is to end the process.
    context_.fatalOnError(false);
    context_.errorLimit(std::numeric_limits<int>::max());
    take_simulator_output();
    top_ = std::make_unique<Top>(&context_);
    top_->clk_i = 0;
    quiet();
    top_->rst_ni = 0;
    eval();
    if constexpr (requires(Top & top, VerilatedFstC * wave) { top.trace(wave, 99); }) {
      if (!options_.wave.empty()) {
        wave_ = std::make_unique<VerilatedFstC>();
        top_->trace(wave_.get(), 99);
        wave_->open(options_.wave.c_str());
        if (!wave_->isOpen()) {
          throw_input({.where = options_.wave.string(),
                       .what = "cannot write the waveform",
                       .expected = {},
                       .got = {},
                       .fix = "choose a writable folder with enough free space"});
        }
      }
    }
    pulse_reset(kResetCycles);
    const std::uint64_t hash =
        read(cmodel::kRegHashLow.address) | static_cast<std::uint64_t>(read(cmodel::kRegHashHigh.address)) << 32;
    if (hash != config_hash(config)) {
      throw UserError(ExitCode::Simulation, {.where = "configuration register",
                                             .what = "the RTL was built for another configuration",
                                             .expected = hash_text(config_hash(config)),
                                             .got = hash_text(hash),
                                             .fix = "build again"});
    }
  }
  ~VerilatedDevice() override {
    if (wave_) wave_->close();
    // The simulator's objects take leave of the thread's context, which is that of the device that ran last.
    Verilated::threadContextp(&context_);
    top_->final();
    top_.reset();
  }

  void consume(std::span<const cmodel::Beat> beats) override {
    for (const auto& beat : beats) {
      offer(beat);
      for (const std::uint64_t since = cycle_; !cycle();) {
        if (hangs(since)) time_out("no beat taken");
      }
    }
  }

  void finish() override {
    top_->s_tvalid_i = 0;
    offering_ = false;
    pending_ = false;
    come_to_rest();
    // A few cycles more: pipelines behind the last busy cycle deliver their taps.
    for (int i = 0; i < 16; ++i) cycle();
  }

  std::optional<Refusal> refuse(const cmodel::Beat& beat) override {
    expecting_ = true;
    offer(beat);
    for (const std::uint64_t since = cycle_; !cycle();) {
      if (hangs(since)) time_out("no beat taken");
    }
    const std::uint64_t taken = cycle_ - 1;
    // It may lie behind a beat that waits in decode.
    for (const std::uint64_t since = cycle_; !top_->error_o && !hangs(since);) cycle();
    if (!top_->error_o) return std::nullopt;
    return Refusal{.taken = taken, .judged = cycle_ - 1};
  }

  void soft_reset(bool wait) override {
    expecting_ = resetting_ = true;  // of an open tile
    write_register(cmodel::kRegControl.address, cmodel::kControlReset, 0);
    if (!wait) return;
    come_to_rest();
    end_soft_reset();
  }

  bool interrupt() const override { return top_->irq_o != 0; }
  std::uint64_t aborted_tiles() const override { return aborted_tiles_; }

  const cmodel::Counters& counters() const override {
    auto* self = const_cast<VerilatedDevice*>(this);
    int number = 0;
#define X(name, meaning) self->counters_.name = self->counter(number++);
    FASTSPLAT_COUNTERS(X)
#undef X
    return counters_;
  }

  cmodel::StallCounters cycle_counters() override {
    int number = 0;
#define X(name, meaning) ++number;
    FASTSPLAT_COUNTERS(X)
#undef X
    cmodel::StallCounters out;
#define X(name, counter_name, meaning) \
  if (cmodel::has_counter(config_, #counter_name)) out.name = counter(number++);
    FASTSPLAT_STALL_COUNTERS(X)
#undef X
    return out;
  }

  std::uint64_t cycles() const override { return cycle_; }

  RegisterAnswer read_register(std::uint32_t address, int wait) override {
    top_->araddr_i = address;
    top_->arvalid_i = 1;
    reading_ = true;
    wait_for("no register read taken", [this] { return top_->arready_o != 0; });
    read_in_a_cycle();
    if (top_->rresp_o != kOkay && top_->rresp_o != kSlverr) unknown_response(top_->rresp_o);
    top_->rready_i = wait == 0 ? 1 : 0;
    for (int i = 0; i < wait; ++i) {
      top_->arvalid_i = 1;
      eval();
      if (top_->arready_o) taken_too_early("read");
      top_->arvalid_i = 0;
      cycle();
    }
    const RegisterAnswer answer{top_->rdata_o, top_->rresp_o == kOkay};
    top_->rready_i = 1;
    reading_ = false;
    cycle();
    return answer;
  }

  RegisterAnswer write_register(std::uint32_t address, std::uint32_t word, int wait) override {
    top_->awaddr_i = address;
    top_->wdata_i = word;
    top_->awvalid_i = top_->wvalid_i = 1;
    writing_ = true;
    wait_for("no register write taken", [this] {
      eval();  // ready answers valid within the cycle
      return top_->awready_o != 0;
    });
    top_->awvalid_i = top_->wvalid_i = 0;
    if (!top_->bvalid_o) unanswered("write");
    if (top_->bresp_o != kOkay && top_->bresp_o != kSlverr) unknown_response(top_->bresp_o);
    top_->bready_i = wait == 0 ? 1 : 0;
    for (int i = 0; i < wait; ++i) {
      top_->awvalid_i = top_->wvalid_i = 1;
      eval();
      if (top_->awready_o || top_->wready_o) taken_too_early("write");
      top_->awvalid_i = top_->wvalid_i = 0;
      cycle();
    }
    const RegisterAnswer answer{0, top_->bresp_o == kOkay};
    top_->bready_i = 1;
    writing_ = false;
    cycle();
    return answer;
  }

  bool takes_half_write(WriteHalf half, std::uint32_t address, std::uint32_t word, int cycles) override {
    top_->awaddr_i = address;
    top_->wdata_i = word;
    (half == WriteHalf::Address ? top_->awvalid_i : top_->wvalid_i) = 1;
    writing_ = true;  // whether it is one shows here
    bool taken = false;
    for (int i = 0; i < cycles; ++i) {
      eval();  // ready answers valid within the cycle
      taken = taken || (half == WriteHalf::Address ? top_->awready_o : top_->wready_o) != 0;
      cycle();
      taken = taken || top_->bvalid_o != 0;
    }
    top_->awvalid_i = top_->wvalid_i = 0;
    writing_ = false;
    return taken;
  }

  void leave_answers_waiting(bool read_too) override {
    top_->rready_i = top_->bready_i = 0;
    reading_ = writing_ = true;
    top_->arvalid_i = top_->awvalid_i = top_->wvalid_i = 1;
    cycle();
    top_->arvalid_i = top_->awvalid_i = top_->wvalid_i = 0;
    if (!top_->bvalid_o) unanswered("write");
    if (read_too) read_in_a_cycle();
  }

  void warm_reset(int cycles) override {
    pulse_reset(cycles);
    was_reset_ = true;
    tiles_.reset();
  }

 protected:
  VerilatedContext& context() { return context_; }

 private:
  static constexpr int kOkay = 0, kSlverr = 2;  ///< of AXI4-Lite

  void end_soft_reset() {
    tiles_.reset();  // of a table that was cut short
    expecting_ = resetting_ = refused_ = false;
  }

  void come_to_rest() {
    for (const std::uint64_t since = cycle_; (read_status() & cmodel::kStatusBusy) != 0 || !tiles_.complete();) {
      if (hangs(since)) time_out("the device does not come to rest");
    }
  }

  /// Who waits since then has waited too long without anything having been taken of either stream: a sink may be slow.
  bool hangs(std::uint64_t since) const { return cycle_ - std::max(since, moved_) > options_.timeout; }

  /// The cycle behind that in which a read's address was taken: another one offered meanwhile is not.
  void read_in_a_cycle() {
    if (top_->rvalid_o) answered_too_early();
    top_->araddr_i = ~top_->araddr_i & 0xFFF;
    top_->arvalid_i = 1;
    eval();
    if (top_->arready_o) taken_too_early("read");
    cycle();
    top_->arvalid_i = 0;
    if (!top_->rvalid_o) unanswered("read");
  }

  /// Clocks up to and with the first cycle in which `taken` holds.
  template <class Taken>
  void wait_for(const char* missing, Taken taken) {
    for (const std::uint64_t since = cycle_;;) {
      const bool last = taken();
      cycle();
      if (last) return;
      if (cycle_ - since > options_.timeout) time_out(missing);  // the bus waits for no stream
    }
  }

  void quiet() {
    top_->s_tvalid_i = 0;
    top_->m_tready_i = 0;
    top_->awvalid_i = 0;
    top_->wvalid_i = 0;
    top_->bready_i = 1;
    top_->arvalid_i = 0;
    top_->rready_i = 1;
  }

  /// What is printed meanwhile, of an assertion that fails, goes by the thread's context: another device's that came
  /// after this one, and may be gone.
  void eval() {
    Verilated::threadContextp(&context_);
    top_->eval();
  }

  void edge() {
    top_->clk_i = 1;
    eval();
    dump(1);
    top_->clk_i = 0;
    eval();
    dump(2);
  }

  void dump(int half) {
    if (!wave_ || (options_.wave_after_reset && !was_reset_)) return;
    if (cycle_ < options_.wave_from || cycle_ >= options_.wave_to) return;
    wave_->dump(2 * cycle_ + static_cast<std::uint64_t>(half));
  }

  void pulse_reset(int cycles) {
    quiet();
    // What only drains away while it is taken has not been reset.
    top_->rready_i = top_->bready_i = 0;
    top_->rst_ni = 0;
    for (int i = 0; i < cycles; ++i) edge();
    top_->rst_ni = 1;
    eval();
    cycle_ = moved_ = 0;
    offering_ = pending_ = refused_ = reading_ = writing_ = expecting_ = resetting_ = false;
    aborted_tiles_ = 0;
    if (top_->rvalid_o || top_->bvalid_o || top_->m_tvalid_o) {
      throw UserError(ExitCode::Simulation, {.where = "after a reset of " + std::to_string(cycles) + " cycles",
                                             .what = top_->m_tvalid_o ? "a pixel beat is offered"
                                                                      : "an answer of the register bus is offered",
                                             .expected = {},
                                             .got = {},
                                             .fix = "look at what the reset leaves out"});
    }
    top_->rready_i = top_->bready_i = 1;
  }

  void offer(const cmodel::Beat& beat) {
    for (std::size_t i = 0; i < beat.size(); ++i) top_->s_tdata_i[i] = beat[i];
    beat_ = beat;
    pending_ = true;
    offering_ = false;
  }

  /// One clock; true when the offered beat was taken.
  bool cycle() {
    offering_ = pending_ && (offering_ || options_.input.at(cycle_));
    top_->s_tvalid_i = offering_ ? 1 : 0;
    top_->m_tready_i = options_.output.at(cycle_) ? 1 : 0;
    const bool taken = offering_ && top_->s_tready_o != 0;
    sample();
    if (taken || (top_->m_tvalid_o && top_->m_tready_i)) moved_ = cycle_;
    if (taken) {
      if (resetting_) end_soft_reset();  // none is taken before
      if (!expecting_) {
        tiles_.accept(beat_);
        if (options_.taps != nullptr) options_.taps->accept(beat_);
      }
      pending_ = offering_ = false;
    }
    edge();
    ++cycle_;
    if (context_.errorCount() != 0) assertion_failed();
    if ((top_->rvalid_o && !reading_) || (top_->bvalid_o && !writing_)) {
      throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(cycle_),
                                             .what = std::string("the register bus answers a ") +
                                                     (top_->rvalid_o ? "read" : "write") + " that nobody began",
                                             .expected = {},
                                             .got = {},
                                             .fix = "look at the waveform of the last cycles"});
    }
    if (top_->error_o && !refused_ && !expecting_) {
      refused_ = true;
      top_->arvalid_i = top_->awvalid_i = top_->wvalid_i = 0;
      throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(cycle_),
                                             .what = "the device refused the stream",
                                             .expected = "beats that keep the rules of docs/stream.md",
                                             .got = "error status; ERROR and ERROR_BEAT say more",
                                             .fix = "check the stream with 'fastsplat stream dump'"});
    }
    return taken;
  }

  /// Taps of this cycle, the pixel beat, if one is taken, and the verdict, if one is told.
  void sample() {
    if (options_.taps != nullptr) sample_taps(*options_.taps);
    if (top_->m_tvalid_o && top_->m_tready_i) sample_pixels();
    if (options_.taps != nullptr && top_->verdict_valid_o) {
      options_.taps->on_raw({.port = RawPort::Verdict,
                             .cycle = cycle_,
                             .tag = top_->verdict_tag_o,
                             .hidden = top_->verdict_hidden_o != 0,
                             .words = {}});
    }
  }

  void sample_pixels() {
    std::array<std::uint32_t, 2> small;
    const auto words = port_words(top_->m_tdata_o, small);
    const bool last = top_->m_tlast_o != 0, aborted = top_->m_tuser_o != 0;
    if (aborted && !expecting_) cut_short();
    if (last && aborted) ++aborted_tiles_;
    if (options_.taps != nullptr)
      options_.taps->on_raw({.port = RawPort::Pixels,
                             .cycle = cycle_,
                             .last = last,
                             .keep = top_->m_tkeep_o,
                             .tile = top_->tap_tile_o,
                             .words = words});
    tiles_.pixels(words, last);
  }

  void sample_taps(RawTapSink& taps) {
    std::array<std::uint32_t, 2> small;
    if (top_->tap_snap_valid_o) {
      taps.on_raw({.port = RawPort::Snap,
                   .cycle = cycle_,
                   .tag = top_->tap_snap_tag_o,
                   .x = top_->tap_snap_x_o,
                   .y = top_->tap_snap_y_o,
                   .mx = top_->tap_snap_mx_o,
                   .my = top_->tap_snap_my_o,
                   .tile = top_->tap_tile_o,
                   .words = {}});
    }
    if (top_->tap_sheet_valid_o) {
      taps.on_raw({.port = RawPort::Sheet,
                   .cycle = cycle_,
                   .tag = top_->tap_sheet_tag_o,
                   .tile = top_->tap_tile_o,
                   .words = port_words(top_->tap_sums_o, small)});
    }
    if (top_->tap_window_valid_o) {
      taps.on_raw({.port = RawPort::Window,
                   .cycle = cycle_,
                   .tag = top_->tap_window_tag_o,
                   .x = top_->tap_window_x_o,
                   .y = top_->tap_window_y_o,
                   .tile = top_->tap_tile_o,
                   .words = port_words(top_->tap_weights_o, small)});
    }
    if (top_->tap_composite_valid_o) {
      taps.on_raw({.port = RawPort::Composite,
                   .cycle = cycle_,
                   .block = top_->tap_composite_block_o,
                   .tile = top_->tap_tile_o,
                   .words = port_words(top_->tap_state_o, small)});
    }
    if (top_->tap_sheet_done_o) taps.on_raw({.port = RawPort::SheetDone, .cycle = cycle_, .words = {}});
  }

  std::uint32_t read(std::uint32_t address) {
    const RegisterAnswer answer = read_register(address, 0);
    if (!answer.okay) {
      throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(cycle_),
                                             .what = "the device refuses to tell a register",
                                             .expected = "OKAY",
                                             .got = "SLVERR of address " + std::to_string(address),
                                             .fix = "look at the waveform of the last cycles"});
    }
    return answer.word;
  }
  std::uint32_t read_status() { return read(cmodel::kRegStatus.address); }
  std::uint64_t counter(int number) {
    const auto address = cmodel::kRegCounters.address + 8 * static_cast<std::uint32_t>(number);
    const std::uint64_t low = read(address);
    return low | static_cast<std::uint64_t>(read(address + 4)) << 32;
  }

  [[noreturn]] void cut_short() const {
    throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(cycle_),
                                           .what = "a tile comes out marked as cut short",
                                           .expected = "no mark: nothing was refused",
                                           .got = "m_tuser_o = 1",
                                           .fix = "look at the waveform of the last cycles"});
  }
  [[noreturn]] void unanswered(const char* access) const {
    throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(cycle_),
                                           .what = std::string("no answer to a register ") + access,
                                           .expected = "a read's two cycles after it was taken, a write's one",
                                           .got = {},
                                           .fix = "look at the waveform of the last cycles"});
  }
  [[noreturn]] void answered_too_early() const {
    throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(cycle_),
                                           .what = "a register read is answered in the cycle after it was taken",
                                           .expected = "in the one behind that",
                                           .got = {},
                                           .fix = "look at the waveform of the last cycles"});
  }
  [[noreturn]] void taken_too_early(const char* access) const {
    throw UserError(ExitCode::Simulation,
                    {.where = "cycle " + std::to_string(cycle_),
                     .what = std::string("a second register ") + access + " is taken before the first was answered",
                     .expected = {},
                     .got = {},
                     .fix = "look at the waveform of the last cycles"});
  }
  [[noreturn]] void unknown_response(int got) const {
    throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(cycle_),
                                           .what = "a register access is answered with what the page does not know",
                                           .expected = "OKAY (0) or SLVERR (2)",
                                           .got = std::to_string(got),
                                           .fix = "look at the waveform of the last cycles"});
  }
  [[noreturn]] void assertion_failed() const {
    const FailedAssertion failed = first_failed_assertion(take_simulator_output());
    throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(cycle_ - 1),
                                           .what = "assertion " + failed.name + " of the RTL failed in " + failed.path +
                                                   " (" + failed.place + ")",
                                           .expected = {},
                                           .got = {},
                                           .fix = "look at the waveform of the last cycles"});
  }
  [[noreturn]] void time_out(const char* what) const {
    throw UserError(ExitCode::Simulation,
                    {.where = "cycle " + std::to_string(cycle_),
                     .what = std::string("the device hangs: ") + what,
                     .expected = "a transfer within " + std::to_string(options_.timeout) + " cycles",
                     .got = {},
                     .fix = "look at the waveform of the last cycles"});
  }

  cmodel::Config config_;
  RtlOptions options_;
  TileAssembly tiles_;
  VerilatedContext context_;
  std::unique_ptr<Top> top_;
  std::unique_ptr<VerilatedFstC> wave_;
  std::uint64_t cycle_ = 0;
  std::uint64_t moved_ = 0;  ///< the cycle in which a beat or pixels were taken last
  cmodel::Beat beat_{};
  bool pending_ = false;    ///< a beat waits to be offered
  bool offering_ = false;   ///< and has been: valid stays up until taken
  bool refused_ = false;    ///< the device said so since reset
  bool expecting_ = false;  ///< that it does, or that it cuts a tile short
  bool resetting_ = false;  ///< a soft reset that nobody saw the end of
  std::uint64_t aborted_tiles_ = 0;
  bool reading_ = false, writing_ = false;  ///< an access was begun whose answer was not taken
  bool was_reset_ = false;                  ///< warm
  cmodel::Counters counters_;
};

}  // namespace fastsplat::testbench
