#include "tests/fetch/fetch_core_helper.hpp"

#include <limits>

#include "Vfs_rtl_faulty_cull.h"
#include "Vfs_rtl_faulty_cull___024root.h"
#include "Vfs_rtl_faulty_cull_fastsplat_fault_pkg.h"
#include "cmodel/register_map.hpp"
#include "testbench/device/tile_assembly.hpp"

namespace fastsplat::test {
namespace {

using Top = Vfs_rtl_faulty_cull;

struct Kept final : cmodel::PixelSink {
  std::vector<cmodel::TilePixels> tiles;
  void on_tile(cmodel::TilePixels&& tile) override { tiles.push_back(std::move(tile)); }
};

class VerilatedCore final : public CoreDevice {
 public:
  VerilatedCore(const cmodel::Config& config, const testbench::Pattern& output)
      : config_(config), output_(output), assembly_(config, kept_) {
    context_.threads(1);
    context_.randReset(2);
    context_.fatalOnError(false);
    context_.errorLimit(std::numeric_limits<int>::max());
    top_ = std::make_unique<Top>(&context_);
    top_->rst_ni = 0;
    top_->s_tvalid_i = top_->awvalid_i = top_->wvalid_i = top_->arvalid_i = top_->m_tready_i = 0;
    top_->bready_i = top_->rready_i = 1;
    for (int i = 0; i < 3; ++i) eval(0), eval(1);
    top_->rst_ni = 1;
    eval(0);
  }
  ~VerilatedCore() override {
    Verilated::threadContextp(&context_);
    top_->final();
    top_.reset();
  }

  bool ready() override { return top_->s_tready_o != 0; }
  std::optional<Verdict> verdict() override {
    if (top_->verdict_valid_o == 0) return std::nullopt;
    return Verdict{top_->verdict_tag_o, top_->verdict_hidden_o != 0};
  }
  void edge(const cmodel::Beat* beat) override {
    Verilated::threadContextp(&context_);
    const bool taken = beat != nullptr && ready();
    top_->s_tvalid_i = beat != nullptr ? 1 : 0;
    for (std::size_t i = 0; beat != nullptr && i < beat->size(); ++i) top_->s_tdata_i[i] = (*beat)[i];
    if (taken) assembly_.accept(*beat);
    cycle();
  }
  bool at_rest() override { return assembly_.complete(); }

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
    top_->clk_i = static_cast<std::uint8_t>(clock);
    top_->rootp->__PVT__fastsplat_fault_pkg->selected = 0;
    top_->eval();
  }
  void cycle() {
    top_->m_tready_i = output_.at(cycle_++) ? 1 : 0;
    eval(0);
    if (top_->m_tvalid_o != 0 && top_->m_tready_i != 0) {
      std::vector<std::uint32_t> words(sizeof(top_->m_tdata_o) / sizeof(std::uint32_t));
      for (std::size_t i = 0; i < words.size(); ++i) words[i] = top_->m_tdata_o[i];
      std::size_t pixels = 0;
      while (pixels < words.size() / 4 && (top_->m_tkeep_o >> pixels & 1) != 0) ++pixels;
      words.resize(pixels * 4);
      assembly_.pixels(words, top_->m_tlast_o != 0);
    }
    eval(1);
    eval(0);
  }
  std::uint32_t read(std::uint32_t address) {
    Verilated::threadContextp(&context_);
    top_->s_tvalid_i = 0;
    top_->araddr_i = static_cast<std::uint16_t>(address);
    top_->arvalid_i = 1;
    cycle();
    top_->arvalid_i = 0;
    cycle();  // in which it is read
    const std::uint32_t word = top_->rdata_o;
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
  VerilatedContext context_;
  std::unique_ptr<Top> top_;
  std::uint64_t cycle_ = 0;
};

}  // namespace

std::unique_ptr<CoreDevice> make_core(const cmodel::Config& config, const testbench::Pattern& output) {
  return std::make_unique<VerilatedCore>(config, output);
}

}  // namespace fastsplat::test
