// SPDX-License-Identifier: Apache-2.0
#include "tests/fetch/fetch_core_helper.hpp"

#include <array>

#include "cmodel/io/register_map.hpp"
#include "testbench/device/rtl_module.hpp"
#include "testbench/device/tile_assembly.hpp"

namespace fastsplat::test {
namespace {

struct Kept final : cmodel::PixelSink {
  std::vector<cmodel::TilePixels> tiles;
  void on_tile(cmodel::TilePixels&& tile) override { tiles.push_back(std::move(tile)); }
};

class VerilatedCore final : public CoreDevice {
 public:
  VerilatedCore(const cmodel::Config& config, const testbench::Pattern& output)
      : config_(config),
        output_(output),
        assembly_(config, kept_),
        top_(testbench::open_rtl(config, {.faults = true}, {})),  // no fault selected: a module that the build makes
        ports_(top_->ports()) {
    ports_.rst_ni = 0;
    ports_.s_tvalid_i = ports_.awvalid_i = ports_.wvalid_i = ports_.arvalid_i = ports_.m_tready_i = 0;
    ports_.bready_i = ports_.rready_i = 1;
    for (int i = 0; i < 3; ++i) eval(0), eval(1);
    ports_.rst_ni = 1;
    eval(0);
  }
  bool ready() override { return ports_.s_tready_o != 0; }
  std::optional<Verdict> verdict() override {
    if (ports_.verdict_valid_o == 0) return std::nullopt;
    return Verdict{ports_.verdict_tag_o.value(), ports_.verdict_hidden_o != 0};
  }
  void edge(const cmodel::Beat* beat) override {
    const bool taken = beat != nullptr && ready();
    ports_.s_tvalid_i = beat != nullptr ? 1 : 0;
    for (std::size_t i = 0; beat != nullptr && i < beat->size(); ++i) ports_.s_tdata_i.data()[i] = (*beat)[i];
    if (taken) assembly_.accept(*beat);
    cycle();
  }
  bool at_rest() override {
    if (!resetting_) return assembly_.complete();
    if ((read(cmodel::kRegStatus.address) & 1) != 0) return false;
    resetting_ = false;
    assembly_.reset();
    kept_.tiles.clear();
    return true;
  }
  void restart() override {
    ports_.s_tvalid_i = 0;
    ports_.awaddr_i.drive(cmodel::kRegControl.address);
    ports_.wdata_i.drive(2);
    ports_.awvalid_i = ports_.wvalid_i = 1;
    cycle();
    ports_.awvalid_i = ports_.wvalid_i = 0;
    resetting_ = true;
  }

  const std::vector<cmodel::TilePixels>& tiles() const override { return kept_.tiles; }
  unsigned refused() override { return read(cmodel::kRegError.address) & 0xFF; }
  cmodel::Counters counters() override {
    cmodel::Counters out;
    int number = 0;
#define X(name, meaning) out.name = counter(number++);
    FASTSPLAT_COUNTERS(X)
#undef X
    return out;
  }
  cmodel::StallCounters stalls() override {
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

 private:
  void eval(int clock) {
    ports_.clk_i = static_cast<std::uint8_t>(clock);
    top_->eval();
  }
  void cycle() {
    ports_.m_tready_i = output_.at(cycle_++) ? 1 : 0;
    eval(0);
    if (ports_.m_tvalid_o != 0 && ports_.m_tready_i != 0) {
      std::array<std::uint32_t, 1> small;
      const auto port = ports_.m_tdata_o.words(small);
      std::vector<std::uint32_t> words(port.begin(), port.end());
      std::size_t pixels = 0;
      while (pixels < words.size() / 4 && (ports_.m_tkeep_o.value() >> pixels & 1) != 0) ++pixels;
      words.resize(pixels * 4);
      assembly_.pixels(words, ports_.m_tlast_o != 0);
    }
    eval(1);
    eval(0);
  }
  std::uint32_t read(std::uint32_t address) {
    ports_.s_tvalid_i = 0;
    ports_.araddr_i.drive(address);
    ports_.arvalid_i = 1;
    cycle();
    ports_.arvalid_i = 0;
    cycle();  // in which it is read
    const std::uint32_t word = ports_.rdata_o.value();
    cycle();
    return word;
  }
  std::uint64_t counter(int number) {
    const auto address = cmodel::kRegCounters.address + 8 * static_cast<std::uint32_t>(number);
    const std::uint64_t low = read(address);
    return low | std::uint64_t{read(address + 4)} << 32;
  }

  cmodel::Config config_;
  testbench::Pattern output_;
  Kept kept_;
  testbench::TileAssembly assembly_;
  std::unique_ptr<testbench::SimulatedTop> top_;
  testbench::Ports ports_;
  std::uint64_t cycle_ = 0;
  bool resetting_ = false;
};

}  // namespace

std::unique_ptr<CoreDevice> make_core(const cmodel::Config& config, const testbench::Pattern& output) {
  return std::make_unique<VerilatedCore>(config, output);
}

}  // namespace fastsplat::test
