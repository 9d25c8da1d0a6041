// SPDX-License-Identifier: Apache-2.0
#include "testbench/device/verilated_device.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/machine_error.hpp"
#include "cmodel/io/register_map.hpp"
#include "cmodel/stream/stream_rules.hpp"
#include "testbench/device/failed_assertion.hpp"
#include "testbench/device/tile_assembly.hpp"
#include "testbench/device/words.hpp"

namespace fastsplat::testbench {
namespace {

/// As in docs/stream.md, "Rules by number".
const char* rule_name(cmodel::StreamRule rule) {
  switch (rule) {
#define X(name, number, register_name, meaning) \
  case cmodel::StreamRule::name:                \
    return #register_name;
    FASTSPLAT_STREAM_RULES(X)
#undef X
  }
  return "?";
}

class VerilatedDevice final : public RtlDevice {
 public:
  VerilatedDevice(std::unique_ptr<SimulatedTop> top, const cmodel::Config& config, cmodel::PixelSink& pixels,
                  const RtlOptions& options)
      : config_(config), options_(options), tiles_(config, pixels), top_(std::move(top)), ports_(top_->ports()) {
    ports_.clk_i = 0;
    quiet();
    ports_.rst_ni = 0;
    top_->eval();
    if (!options_.wave.empty() && !top_->trace(options_.wave.c_str())) {
      throw_machine({.where = options_.wave.string(),
                     .what = "cannot write the waveform",
                     .expected = {},
                     .got = {},
                     .fix = "choose a writable folder with enough free space"});
    }
    pulse_reset(kResetCycles);
    const std::uint64_t hash =
        read(cmodel::kRegHashLow.address) | static_cast<std::uint64_t>(read(cmodel::kRegHashHigh.address)) << 32;
    if (hash != config_hash(config)) {
      throw UserError(ExitCode::Simulation, {.where = "configuration register",
                                             .what = "the RTL was built for another configuration",
                                             .expected = hash_text(config_hash(config)),
                                             .got = hash_text(hash),
                                             .fix = "rebuild the RTL"});
    }
  }
  void consume(std::span<const cmodel::Beat> beats) override {
    for (const auto& beat : beats) {
      offer(beat);
      for (const std::uint64_t since = cycle_; !cycle();) {
        if (hangs(since)) time_out("no beat accepted");
      }
    }
  }

  void finish() override {
    ports_.s_tvalid_i = 0;
    offering_ = false;
    pending_ = false;
    come_to_rest();
    // A few cycles more: pipelines behind the last busy cycle deliver their taps.
    for (int i = 0; i < 16; ++i) cycle();
    if (irq_known_ && frames_ > 0 && (read(cmodel::kRegIrq.address) & cmodel::kIrqFrame) == 0)
      wrong_status("the frame has left, and IRQ bit 0 is 0", "1, as docs/integration.md says");
  }

  std::optional<Refusal> refuse(const cmodel::Beat& beat) override {
    expecting_ = true;
    irq_known_ = false;
    offer(beat);
    for (const std::uint64_t since = cycle_; !cycle();) {
      if (hangs(since)) time_out("no beat accepted");
    }
    const std::uint64_t taken = cycle_ - 1;
    // It may lie behind a beat that waits in decode.
    for (const std::uint64_t since = cycle_; !ports_.error_o && !hangs(since);) cycle();
    if (!ports_.error_o) return std::nullopt;
    return Refusal{.taken = taken, .checked = cycle_ - 1};
  }

  void drop(std::span<const cmodel::Beat> beats) override {
    const bool before = std::exchange(expecting_, true);
    irq_known_ = false;
    for (const auto& beat : beats) {
      offer(beat);
      for (const std::uint64_t since = cycle_; !cycle();) {
        if (hangs(since)) time_out("no beat dropped");
      }
    }
    expecting_ = before;
  }

  void soft_reset(bool wait) override {
    // Beats in the slice would be dropped: they reach the core first.
    for (const std::uint64_t since = cycle_; sliced() && *ports_.tap_beat_held_o;) {
      cycle();
      if (hangs(since)) time_out("the core takes no beat");
    }
    expecting_ = resetting_ = true;  // an open tile is cut short
    irq_known_ = false;
    write_register(cmodel::kRegControl.address, cmodel::kControlReset, 0);
    if (!wait) return;
    come_to_rest();
    end_soft_reset();
  }

  bool interrupt() const override { return ports_.irq_o != 0; }
  bool sliced() const override { return ports_.tap_tile_left_o != nullptr; }
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
    ports_.araddr_i.drive(address);
    ports_.arvalid_i = 1;
    reading_ = true;
    wait_for("no register read accepted", [this] { return ports_.arready_o != 0; });
    read_in_a_cycle();
    if (ports_.rresp_o != kOkay && ports_.rresp_o != kSlverr) unknown_response(ports_.rresp_o);
    ports_.rready_i = wait == 0 ? 1 : 0;
    for (int i = 0; i < wait; ++i) {
      ports_.arvalid_i = 1;
      top_->eval();
      if (ports_.arready_o) taken_too_early("read");
      ports_.arvalid_i = 0;
      cycle();
    }
    const RegisterAnswer answer{ports_.rdata_o.value(), ports_.rresp_o == kOkay};
    ports_.rready_i = 1;
    reading_ = false;
    cycle();
    return answer;
  }

  RegisterAnswer write_register(std::uint32_t address, std::uint32_t word, int wait) override {
    ports_.awaddr_i.drive(address);
    ports_.wdata_i.drive(word);
    ports_.awvalid_i = ports_.wvalid_i = 1;
    writing_ = true;
    irq_known_ = irq_known_ && address != cmodel::kRegIrq.address;
    wait_for("no register write accepted", [this] {
      top_->eval();  // ready answers valid within the cycle
      return ports_.awready_o != 0;
    });
    ports_.awvalid_i = ports_.wvalid_i = 0;
    if (!ports_.bvalid_o) unanswered("write");
    if (ports_.bresp_o != kOkay && ports_.bresp_o != kSlverr) unknown_response(ports_.bresp_o);
    ports_.bready_i = wait == 0 ? 1 : 0;
    for (int i = 0; i < wait; ++i) {
      ports_.awvalid_i = ports_.wvalid_i = 1;
      top_->eval();
      if (ports_.awready_o || ports_.wready_o) taken_too_early("write");
      ports_.awvalid_i = ports_.wvalid_i = 0;
      cycle();
    }
    const RegisterAnswer answer{0, ports_.bresp_o == kOkay};
    ports_.bready_i = 1;
    writing_ = false;
    cycle();
    return answer;
  }

  bool takes_half_write(WriteHalf half, std::uint32_t address, std::uint32_t word, int cycles) override {
    ports_.awaddr_i.drive(address);
    ports_.wdata_i.drive(word);
    (half == WriteHalf::Address ? ports_.awvalid_i : ports_.wvalid_i) = 1;
    writing_ = true;  // allows an answer, which is looked for here
    bool taken = false;
    for (int i = 0; i < cycles; ++i) {
      top_->eval();  // ready answers valid within the cycle
      taken = taken || (half == WriteHalf::Address ? ports_.awready_o : ports_.wready_o) != 0;
      cycle();
      taken = taken || ports_.bvalid_o != 0;
    }
    ports_.awvalid_i = ports_.wvalid_i = 0;
    writing_ = false;
    return taken;
  }

  void leave_answers_waiting(bool read_too) override {
    ports_.rready_i = ports_.bready_i = 0;
    reading_ = writing_ = true;
    ports_.arvalid_i = ports_.awvalid_i = ports_.wvalid_i = 1;
    cycle();
    ports_.arvalid_i = ports_.awvalid_i = ports_.wvalid_i = 0;
    if (!ports_.bvalid_o) unanswered("write");
    if (read_too) read_in_a_cycle();
  }

  void warm_reset(int cycles) override {
    pulse_reset(cycles);
    was_reset_ = true;
    tiles_.reset();
  }

 private:
  static constexpr int kOkay = 0, kSlverr = 2;  ///< of AXI4-Lite

  void end_soft_reset() {
    tiles_.reset();  // drops a table that was cut short
    expecting_ = resetting_ = refused_ = false;
  }

  /// Clocks until BUSY is 0. BUSY and IRQ may not report a frame before the sink has taken it: a host would read an old
  /// picture. IRQ keeps its bits, so an early one shows only in the first frame after a reset.
  void come_to_rest() {
    for (const std::uint64_t since = cycle_; (read_status() & cmodel::kStatusBusy) != 0;) {
      if (hangs(since)) time_out("the device does not become idle");
      if (!irq_known_ || frames_ != 1 || tiles_.complete()) continue;
      if ((read(cmodel::kRegIrq.address) & cmodel::kIrqFrame) != 0 && !tiles_.complete())
        wrong_status("IRQ bit 0 is 1, and pixels of the frame wait", "0 until the sink has taken them");
    }
    if (!tiles_.complete())
      wrong_status("BUSY is 0, and the sink has not taken all pixels", "1 until it has taken them");
  }

  /// True if neither stream has moved for the timeout, counted from `since` at the earliest: a sink may be slow.
  bool hangs(std::uint64_t since) const { return cycle_ - std::max(since, moved_) > options_.timeout; }

  /// The cycle after a read's address was taken: another address must not be taken in it.
  void read_in_a_cycle() {
    if (ports_.rvalid_o) wrong("a register read is answered one cycle after it was accepted", "two cycles after");
    ports_.araddr_i.drive(~ports_.araddr_i.value() & 0xFFF);
    ports_.arvalid_i = 1;
    top_->eval();
    if (ports_.arready_o) taken_too_early("read");
    cycle();
    ports_.arvalid_i = 0;
    if (!ports_.rvalid_o) unanswered("read");
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
    ports_.s_tvalid_i = 0;
    ports_.m_tready_i = 0;
    ports_.awvalid_i = 0;
    ports_.wvalid_i = 0;
    ports_.bready_i = 1;
    ports_.arvalid_i = 0;
    ports_.rready_i = 1;
  }

  void edge() {
    ports_.clk_i = 1;
    top_->eval();
    dump(1);
    ports_.clk_i = 0;
    top_->eval();
    dump(2);
  }

  void dump(int half) {
    if (options_.wave.empty() || (options_.wave_after_reset && !was_reset_)) return;
    if (cycle_ < options_.wave_from || cycle_ >= options_.wave_to) return;
    top_->dump(2 * cycle_ + static_cast<std::uint64_t>(half));
  }

  void pulse_reset(int cycles) {
    quiet();
    // Answers are not taken: one that disappears only by being taken was not reset.
    ports_.rready_i = ports_.bready_i = 0;
    ports_.rst_ni = 0;
    for (int i = 0; i < cycles; ++i) edge();
    ports_.rst_ni = 1;
    top_->eval();
    cycle_ = moved_ = 0;
    early_.clear();
    offering_ = pending_ = refused_ = reading_ = writing_ = expecting_ = resetting_ = false;
    irq_known_ = true;
    aborted_tiles_ = frames_ = 0;
    if (ports_.rvalid_o || ports_.bvalid_o || ports_.m_tvalid_o) {
      throw UserError(ExitCode::Simulation,
                      {.where = "after a reset of " + std::to_string(cycles) + " cycles",
                       .what = ports_.m_tvalid_o ? "a pixel beat is offered" : "a register bus response is offered",
                       .expected = {},
                       .got = {},
                       .fix = "check which state the reset misses"});
    }
    ports_.rready_i = ports_.bready_i = 1;
  }

  void offer(const cmodel::Beat& beat) {
    for (std::size_t i = 0; i < beat.size(); ++i) ports_.s_tdata_i.data()[i] = beat[i];
    beat_ = beat;
    pending_ = true;
    offering_ = false;
  }

  /// One clock; true when the offered beat was taken.
  bool cycle() {
    offering_ = pending_ && (offering_ || options_.input.at(cycle_));
    ports_.s_tvalid_i = offering_ ? 1 : 0;
    ports_.m_tready_i = options_.output.at(cycle_) ? 1 : 0;
    const bool taken = offering_ && ports_.s_tready_o != 0;
    sample();
    if (taken || (ports_.m_tvalid_o && ports_.m_tready_i)) moved_ = cycle_;
    // While a soft reset lasts, the core takes no beat, but the slice does: such beats are the next frame's.
    if (!early_.empty() && *ports_.tap_beat_taken_o) {
      end_soft_reset();
      for (const auto& beat : std::exchange(early_, {})) accept(beat);
    }
    if (taken) {
      if (resetting_ && sliced()) {
        early_.push_back(beat_);
      } else {
        if (resetting_) end_soft_reset();
        if (!expecting_) accept(beat_);
      }
      pending_ = offering_ = false;
    }
    edge();
    ++cycle_;
    if (top_->failed()) assertion_failed();
    if ((ports_.rvalid_o && !reading_) || (ports_.bvalid_o && !writing_)) {
      wrong(std::string("the register bus answers a ") + (ports_.rvalid_o ? "read" : "write") +
            " that was not requested");
    }
    if (ports_.error_o && !refused_ && !expecting_) wrong_refusal();
    return taken;
  }

  /// A reader accepted the beat before it was offered, so the device is wrong.
  [[noreturn]] void wrong_refusal() {
    refused_ = true;
    irq_known_ = false;
    ports_.arvalid_i = ports_.awvalid_i = ports_.wvalid_i = 0;
    const std::string got = reading_ || writing_ ? "STATUS bit 1" : error_registers();
    wrong("the device refused a legal beat", "ERROR 0", got, 0,
          "compare the beat with 'fastsplat stream dump', then look at u_top.u_beats and u_top.u_core.u_check in the "
          "waveform");
  }

  /// ERROR and ERROR_BEAT as text. What the device shows while they are read is not the run's, nor are the cycles.
  std::string error_registers() {
    const std::uint64_t now = cycle_;
    RawTapSink* const taps = std::exchange(options_.taps, nullptr);
    const bool before = std::exchange(expecting_, true);
    const std::uint32_t error = read(cmodel::kRegError.address), beat = read(cmodel::kRegErrorBeat.address);
    options_.taps = taps;
    expecting_ = before;
    cycle_ = now;
    const std::uint32_t rule = error & 0xff;
    return "rule " + std::to_string(rule) + " (" + rule_name(static_cast<cmodel::StreamRule>(rule)) + "), opcode " +
           hex(error >> 8 & 0xff) + ", beat " + std::to_string(beat);
  }

  void accept(const cmodel::Beat& beat) {
    if (tiles_.accept(beat) == cmodel::Opcode::EndFrame) ++frames_;
    if (options_.taps != nullptr) options_.taps->accept(beat);
  }

  /// Samples the taps of this cycle, the pixel beat if one is taken, and the verdict if there is one.
  void sample() {
    if (options_.taps != nullptr) sample_taps(*options_.taps);
    if (options_.taps != nullptr && sliced() && *ports_.tap_tile_left_o)
      options_.taps->on_raw({.port = RawPort::TileLeft, .cycle = cycle_, .words = {}});
    if (ports_.m_tvalid_o && ports_.m_tready_i) sample_pixels();
    if (options_.taps != nullptr && ports_.verdict_valid_o) {
      options_.taps->on_raw({.port = RawPort::Verdict,
                             .cycle = cycle_,
                             .tag = ports_.verdict_tag_o.value(),
                             .hidden = ports_.verdict_hidden_o != 0,
                             .words = {}});
    }
  }

  void sample_pixels() {
    std::array<std::uint32_t, 1> small;
    const auto words = ports_.m_tdata_o.words(small);
    const bool last = ports_.m_tlast_o != 0, aborted = ports_.m_tuser_o != 0;
    if (aborted && !expecting_)
      wrong("an output tile is marked as aborted", "no mark, because no beat was refused", "m_tuser_o = 1");
    if (last && aborted) ++aborted_tiles_;
    if (options_.taps != nullptr)
      options_.taps->on_raw({.port = RawPort::Pixels,
                             .cycle = cycle_,
                             .last = last,
                             .keep = ports_.m_tkeep_o.value(),
                             .tile = sliced() ? std::nullopt : std::optional(ports_.tap_tile_o.value()),
                             .words = words});
    tiles_.pixels(words, last);
  }

  void sample_taps(RawTapSink& taps) {
    std::array<std::uint32_t, 1> small;
    if (ports_.tap_snap_valid_o) {
      taps.on_raw({.port = RawPort::Snap,
                   .cycle = cycle_,
                   .tag = ports_.tap_snap_tag_o.value(),
                   .x = ports_.tap_snap_x_o.value(),
                   .y = ports_.tap_snap_y_o.value(),
                   .mx = ports_.tap_snap_mx_o.value(),
                   .my = ports_.tap_snap_my_o.value(),
                   .tile = ports_.tap_tile_o.value(),
                   .words = {}});
    }
    if (ports_.tap_sheet_valid_o) {
      taps.on_raw({.port = RawPort::Sheet,
                   .cycle = cycle_,
                   .tag = ports_.tap_sheet_tag_o.value(),
                   .tile = ports_.tap_tile_o.value(),
                   .words = ports_.tap_sums_o.words(small)});
    }
    if (ports_.tap_window_valid_o) {
      taps.on_raw({.port = RawPort::Window,
                   .cycle = cycle_,
                   .tag = ports_.tap_window_tag_o.value(),
                   .x = ports_.tap_window_x_o.value(),
                   .y = ports_.tap_window_y_o.value(),
                   .tile = ports_.tap_tile_o.value(),
                   .words = ports_.tap_weights_o.words(small)});
    }
    if (ports_.tap_composite_valid_o) {
      taps.on_raw({.port = RawPort::Composite,
                   .cycle = cycle_,
                   .block = ports_.tap_composite_block_o.value(),
                   .tile = ports_.tap_tile_o.value(),
                   .words = ports_.tap_state_o.words(small)});
    }
    if (ports_.tap_sheet_done_o) taps.on_raw({.port = RawPort::SheetDone, .cycle = cycle_, .words = {}});
  }

  std::uint32_t read(std::uint32_t address) {
    const RegisterAnswer answer = read_register(address, 0);
    if (!answer.okay) {
      wrong("the device refuses a register read", "OKAY", "SLVERR of address " + std::to_string(address));
    }
    return answer.word;
  }
  std::uint32_t read_status() { return read(cmodel::kRegStatus.address); }
  std::uint64_t counter(int number) {
    const auto address = cmodel::kRegCounters.address + 8 * static_cast<std::uint32_t>(number);
    const std::uint64_t low = read(address);
    return low | static_cast<std::uint64_t>(read(address + 4)) << 32;
  }

  [[noreturn]] void wrong(const std::string& what, const std::string& expected = {}, const std::string& got = {},
                          std::uint64_t before = 0, const char* fix = "check the waveform of the last cycles") const {
    throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(cycle_ - before),
                                           .what = what,
                                           .expected = expected,
                                           .got = got,
                                           .fix = fix});
  }
  /// Of BUSY or IRQ bit 0 at a frame's end.
  [[noreturn]] void wrong_status(const std::string& what, const std::string& expected) const {
    wrong(what, expected, {}, 0, "look at u_top.ends_q, u_top.frame_end and u_top.u_core.u_csr in the waveform");
  }
  [[noreturn]] void unanswered(const std::string& access) const {
    wrong("no response to a register " + access, "reads: two cycles after acceptance, writes: one");
  }
  [[noreturn]] void taken_too_early(const std::string& access) const {
    wrong("a second register " + access + " is accepted before the response to the first");
  }
  [[noreturn]] void unknown_response(int got) const {
    wrong("unknown response to a register access", "OKAY (0) or SLVERR (2)", std::to_string(got));
  }
  [[noreturn]] void assertion_failed() const {
    const FailedAssertion failed = first_failed_assertion(top_->take_output());
    wrong("assertion " + failed.name + " of the RTL failed in " + failed.path + " (" + failed.place + ")", {}, {}, 1);
  }
  [[noreturn]] void time_out(const std::string& what) const {
    wrong("the device hangs: " + what, "a transfer within " + std::to_string(options_.timeout) + " cycles");
  }

  cmodel::Config config_;
  RtlOptions options_;
  TileAssembly tiles_;
  std::unique_ptr<SimulatedTop> top_;
  Ports ports_;
  std::uint64_t cycle_ = 0;
  std::uint64_t moved_ = 0;  ///< the cycle in which a beat or pixels were taken last
  cmodel::Beat beat_{};
  std::vector<cmodel::Beat> early_;  ///< taken by the slice while a soft reset lasts
  bool pending_ = false;             ///< a beat waits to be offered
  bool offering_ = false;            ///< the beat is offered: valid stays up until it is taken
  bool refused_ = false;             ///< the device has refused a beat since reset
  bool expecting_ = false;           ///< a refusal or a cut tile is expected
  bool resetting_ = false;           ///< a soft reset whose end was not awaited
  std::uint64_t aborted_tiles_ = 0;
  std::uint64_t frames_ = 0;                ///< whose end was accepted since reset was released
  bool irq_known_ = true;                   ///< since then IRQ was not written, and no beat was dropped or refused
  bool reading_ = false, writing_ = false;  ///< an access was begun whose answer was not taken
  bool was_reset_ = false;                  ///< by a warm reset
  cmodel::Counters counters_;
};

}  // namespace

SimulatorOptions simulator_options(const RtlOptions& options) {
  return {.fill = options.fill == ResetFill::Zero  ? 0
                  : options.fill == ResetFill::One ? 1
                                                   : 2,
          .seed = static_cast<int>(options.seed % 0x7fffffff) + 1,
          .assertions = options.assertions == Assertions::On,
          .trace = !options.wave.empty(),
          .fault = 0};
}

std::unique_ptr<RtlDevice> make_verilated_device(std::unique_ptr<SimulatedTop> top, const cmodel::Config& config,
                                                 cmodel::PixelSink& pixels, const RtlOptions& options) {
  return std::make_unique<VerilatedDevice>(std::move(top), config, pixels, options);
}

}  // namespace fastsplat::testbench
