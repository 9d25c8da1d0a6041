// SPDX-License-Identifier: Apache-2.0
#include "docs/examples/system/host.hpp"

#include <cstring>
#include <utility>

#include "base/error.hpp"

namespace fastsplat::examples {
namespace {

constexpr int kResetCycles = 4;
constexpr int kBusPatience = 1000;  ///< cycles in which the register bus answers
constexpr std::size_t kPixelWords = 4;

/// The words of a Verilated port, whatever its type.
template <class Port>
std::vector<std::uint32_t> words_of(const Port& port) {
  std::vector<std::uint32_t> words(sizeof(Port) / sizeof(std::uint32_t));
  std::memcpy(words.data(), &port, words.size() * sizeof(std::uint32_t));
  return words;
}

}  // namespace

Host::Host(const SystemTimings& timings, Sink sink) : timings_(timings), sink_(std::move(sink)) {
  context_.threads(1);
  context_.randReset(2);
  top_ = std::make_unique<Vfs_system>(&context_);
  top_->aresetn = 0;
  top_->s_axil_bready = top_->s_axil_rready = 1;
  for (int i = 0; i < kResetCycles; ++i) clock();
  top_->aresetn = 1;
}

Host::~Host() { top_->final(); }

void Host::expect(bool holds, const char* what) const {
  if (holds) return;
  throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(cycle_),
                                         .what = what,
                                         .expected = {},
                                         .got = {},
                                         .fix = "see docs/integration.md, \"Programming\""});
}

void Host::clock() {
  const bool running = top_->aresetn != 0;
  const bool offers = running && at_ < memory_.size() && cycle_ >= ready_from_;
  top_->s_axis_tvalid = offers ? 1 : 0;
  if (offers) {
    for (std::size_t i = 0; i < memory_[at_].size(); ++i) top_->s_axis_tdata[i] = memory_[at_][i];
  }
  top_->m_axis_tready = running && (timings_.sink_pause == 0 || cycle_ % timings_.sink_pause != 0) ? 1 : 0;
  top_->aclk = 0;
  top_->eval();
  // A beat that is valid and ready before the edge is transferred by it.
  const bool taken = offers && top_->s_axis_tready != 0;
  if (top_->m_axis_tvalid && top_->m_axis_tready) {
    PixelBeat beat{
        .words = words_of(top_->m_axis_tdata), .last = top_->m_axis_tlast != 0, .aborted = top_->m_axis_tuser != 0};
    const auto keep = static_cast<std::uint64_t>(top_->m_axis_tkeep);  // 16 bits a pixel
    std::size_t pixels = 0;
    while (pixels < beat.words.size() / kPixelWords && (keep >> (16 * pixels) & 0xffff) == 0xffff) ++pixels;
    beat.words.resize(pixels * kPixelWords);
    sink_(beat);
  }
  top_->aclk = 1;
  top_->eval();
  ++cycle_;
  if (!taken) return;
  ++at_;
  if (at_ % timings_.burst_beats == 0) ready_from_ = cycle_ + timings_.latency;
}

std::uint32_t Host::read(std::uint32_t address) {
  top_->s_axil_araddr = static_cast<std::uint16_t>(address);
  top_->s_axil_arvalid = 1;
  int waited = 0;
  for (bool taken = false; !taken; expect(++waited < kBusPatience, "no register read is accepted")) {
    top_->eval();
    taken = top_->s_axil_arready != 0;
    clock();
  }
  top_->s_axil_arvalid = 0;
  while (!top_->s_axil_rvalid) {
    clock();
    expect(++waited < kBusPatience, "no response to a register read");
  }
  const std::uint32_t word = top_->s_axil_rdata;
  expect(top_->s_axil_rresp == 0, "a register read returns SLVERR");
  clock();
  return word;
}

void Host::write(std::uint32_t address, std::uint32_t word) {
  expect(write_bytes(address, word, 0xf), "a register write returns SLVERR");
}

bool Host::write_bytes(std::uint32_t address, std::uint32_t word, unsigned strobe) {
  top_->s_axil_awaddr = static_cast<std::uint16_t>(address);
  top_->s_axil_wdata = word;
  top_->s_axil_wstrb = static_cast<std::uint8_t>(strobe);
  top_->s_axil_awvalid = top_->s_axil_wvalid = 1;
  int waited = 0;
  for (bool taken = false; !taken; expect(++waited < kBusPatience, "no register write is accepted")) {
    top_->eval();
    taken = top_->s_axil_awready != 0 && top_->s_axil_wready != 0;
    clock();
  }
  top_->s_axil_awvalid = top_->s_axil_wvalid = 0;
  while (!top_->s_axil_bvalid) {
    clock();
    expect(++waited < kBusPatience, "no response to a register write");
  }
  const bool okay = top_->s_axil_bresp == 0;
  clock();
  return okay;
}

void Host::start(std::vector<cmodel::Beat> memory) {
  memory_ = std::move(memory);
  at_ = 0;
  ready_from_ = cycle_ + timings_.latency;
}

void Host::stop() { memory_.clear(), at_ = 0; }

bool Host::wait_for_interrupt(std::uint64_t cycles) {
  for (const std::uint64_t end = cycle_ + cycles; !top_->irq; clock()) {
    if (cycle_ >= end) return false;
  }
  return true;
}

}  // namespace fastsplat::examples
