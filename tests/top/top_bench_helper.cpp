// SPDX-License-Identifier: Apache-2.0
#include "tests/top/top_bench_helper.hpp"

#include <verilated.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "Vfs_top.h"
#include "cmodel/io/register_map.hpp"
#include "cmodel/stream/records.hpp"
#include "testbench/device/failed_assertion.hpp"
#include "testbench/module/simulator_output.hpp"

namespace fastsplat::test {
namespace {

using cmodel::Beat;

constexpr std::uint64_t kPatience = 20'000;  ///< cycles
constexpr std::uint32_t kSoftReset = 2, kDrop = 4, kBusy = 1;
constexpr unsigned kAllBytes = 15;  ///< WSTRB
constexpr std::size_t kPixelWords = 4, kPixelBytes = 16;

class Bench {
 public:
  Bench(const std::vector<Beat>& first, const std::vector<Beat>& next, const TopRun& run)
      : next_(next), run_(run), sent_(&first) {
    context_.threads(1);
    context_.randReset(2);
    context_.fatalOnError(false);
    context_.errorLimit(std::numeric_limits<int>::max());
    testbench::take_simulator_output();
    top_ = std::make_unique<Vfs_top>(&context_);
  }
  ~Bench() {
    Verilated::threadContextp(&context_);
    top_->final();
  }

  TopResult go() {
    top_->aresetn = 0;
    top_->s_axis_tvalid = top_->m_axis_tready = top_->s_axil_awvalid = top_->s_axil_wvalid = top_->s_axil_arvalid = 0;
    top_->s_axil_bready = top_->s_axil_rready = 1;
    top_->s_axil_wstrb = kAllBytes;
    for (int i = 0; i < 3; ++i) edge();
    top_->aresetn = 1;
    enable_interrupts();
    while (out_.finding.empty() && !done()) {
      if (cycle_ > run_.reset_at + kPatience) say("no end");
      if (run_.reset_at != 0 && cycle_ == run_.reset_at) reset();
      if (out_.reset && !over_) go_on();
      if (cycle_ == run_.status_at) out_.busy = busy();
      if (interrupted_) write(cmodel::kRegIrq.address, run_.mask);
      clock();
    }
    out_.error = read(cmodel::kRegError.address);
    const auto failed = testbench::first_failed_assertion(testbench::take_simulator_output());
    if (!failed.name.empty()) say("assertion " + failed.name);
    return out_;
  }

 private:
  void say(const std::string& what) {
    if (out_.finding.empty()) out_.finding = "cycle " + std::to_string(cycle_) + ": " + what;
  }
  bool busy() { return (read(cmodel::kRegStatus.address) & kBusy) != 0; }
  /// All was sent, and has come out; of the first frame where nothing was reset.
  bool done() {
    const bool sent = at_ == last_ && !offering_ && out_.reset == over_ && cycle_ > run_.reset_at;
    if (!sent || !tile_.empty() || busy()) return false;
    if (top_->m_axis_tvalid != 0) say("not busy, and pixels wait");  // M-top-4
    return true;
  }
  void edge() {
    top_->aclk = 0;
    top_->eval();
    top_->aclk = 1;
    top_->eval();
  }

  void reset() {
    if (at_ == last_ && !offering_ && !busy()) return;  // the frame is over
    if (run_.harmless) return write_harmless();
    out_.reset = true;
    if (run_.hard) {
      top_->aresetn = 0;
      clock();
      top_->aresetn = 1;
      tile_.clear();
      reset_beat_ = at_;
      last_ = std::min(sent_->size(), at_ + run_.more);
    } else {
      write(cmodel::kRegControl.address, run_.drops ? kSoftReset | kDrop : kSoftReset);
      resetting_ = true;
      last_ = at_;
    }
    out_.tiles.clear();
    if (!run_.hard) return;
    out_.lasts.clear(), out_.interrupts.clear();
    interrupted_ = false;
    enable_interrupts();
  }
  void enable_interrupts() {
    if (run_.mask != 0) write(cmodel::kRegIrqMask.address, run_.mask);
  }
  void write_harmless() {
    if (run_.address_first) {
      top_->s_axil_awaddr = static_cast<std::uint16_t>(cmodel::kRegControl.address);
      top_->s_axil_wdata = kSoftReset | kDrop;
      top_->s_axil_awvalid = 1;
      for (int i = 0; i < 3; ++i) clock();
    }
    top_->s_axil_wstrb = static_cast<std::uint8_t>(run_.strobe);
    write(cmodel::kRegControl.address, *run_.harmless);
    top_->s_axil_wstrb = kAllBytes;
  }
  /// Where all is at rest, the next frame may come.
  void go_on() {
    if (resetting_ && (offering_ || busy())) return;
    if (resetting_) write(cmodel::kRegControl.address, 0);
    resetting_ = false;
    if (offering_ || at_ < last_) return;
    sent_ = &next_;
    at_ = 0;
    last_ = next_.size();
    over_ = true;
  }
  void write(std::uint32_t address, std::uint32_t word) {
    top_->s_axil_awaddr = static_cast<std::uint16_t>(address);
    top_->s_axil_wdata = word;
    top_->s_axil_awvalid = top_->s_axil_wvalid = 1;
    clock();
    top_->s_axil_awvalid = top_->s_axil_wvalid = 0;
    clock();
  }

  std::uint32_t read(std::uint32_t address) {
    top_->s_axil_araddr = static_cast<std::uint16_t>(address);
    top_->s_axil_arvalid = 1;
    clock();
    top_->s_axil_arvalid = 0;
    clock();  // in which it is read
    const std::uint32_t word = top_->s_axil_rdata;
    clock();
    return word;
  }

  void clock() {
    offering_ = offering_ || (at_ < last_ && run_.source.at(cycle_));
    top_->s_axis_tvalid = offering_ ? 1 : 0;
    for (std::size_t i = 0; offering_ && i < (*sent_)[at_].size(); ++i) top_->s_axis_tdata[i] = (*sent_)[at_][i];
    if (run_.hard && out_.reset && !over_ && at_ > reset_beat_) nearly_begin();
    top_->m_axis_tready = run_.sink.at(cycle_) ? 1 : 0;
    top_->aclk = 0;
    top_->eval();
    if (top_->irq != 0 && !interrupted_) out_.interrupts.push_back(cycle_);
    interrupted_ = top_->irq != 0;
    if (top_->m_axis_tvalid != 0 && top_->m_axis_tready != 0) take();
    const bool taken = offering_ && top_->s_axis_tready != 0;
    top_->aclk = 1;
    top_->eval();
    top_->aclk = 0;
    top_->eval();
    if (taken) {
      if (out_.first_taken == 0) out_.first_taken = cycle_;
      offering_ = false;
      ++at_;
    }
    ++cycle_;
  }

  /// The beat has the opcode of a begin_frame, or its magic word; the other one is just beside it.
  void nearly_begin() {
    const std::uint32_t opcode = (at_ - reset_beat_) % 2;
    top_->s_axis_tdata[0] = static_cast<std::uint32_t>(cmodel::Opcode::BeginFrame) + 1 - opcode;
    top_->s_axis_tdata[1] = cmodel::kStreamMagic + opcode;
  }

  void take() {
    constexpr std::size_t kLanes = sizeof(top_->m_axis_tdata) / kPixelBytes;
    for (std::size_t pixel = 0; pixel < kLanes; ++pixel) {
      const auto keep = top_->m_axis_tkeep >> (kPixelBytes * pixel) & 0xffff;
      if (keep != 0 && keep != 0xffff) say("a part of a pixel is kept");
      for (std::size_t word = 0; keep != 0 && word < kPixelWords; ++word)
        tile_.push_back(top_->m_axis_tdata[kPixelWords * pixel + word]);
    }
    if (top_->m_axis_tlast == 0) return;
    out_.lasts.push_back(cycle_);
    if (top_->m_axis_tuser == 0) out_.tiles.push_back(tile_);
    tile_.clear();
  }

  const std::vector<Beat>& next_;
  const TopRun& run_;
  const std::vector<Beat>* sent_;
  VerilatedContext context_;
  std::unique_ptr<Vfs_top> top_;
  TopResult out_;
  std::vector<std::uint32_t> tile_;
  std::size_t reset_beat_ = 0;
  std::size_t at_ = 0, last_ = sent_->size();  ///< the next beat; where the source ends
  std::uint64_t cycle_ = 0;
  bool offering_ = false, resetting_ = false, over_ = false;  ///< over: the next frame is sent
  bool interrupted_ = false;
};

}  // namespace

TopResult run_top(const std::vector<Beat>& first, const std::vector<Beat>& next, const TopRun& run) {
  return Bench(first, next, run).go();
}

}  // namespace fastsplat::test
