// SPDX-License-Identifier: Apache-2.0
// A device whose register bus never answers is reported, not waited for; so is one that answers a read in another
// cycle.
#include <gtest/gtest.h>

#include "cmodel/io/register_map.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/device/verilated_device.hpp"

namespace fastsplat::testbench {
namespace {

/// Behaviour of a device on reads; it takes no write.
enum class Reads { Never, AsThePageSays, ACycleEarly, OneBehindTheOther };

/// Ports as in a simulator, for a device that has only a register bus.
struct SilentTop final : SimulatedTop {
  explicit SilentTop(Reads how) : reads(how) {}
  void eval() override {
    if (clk_i != 0 && !was_high) {
      const bool takes = rst_ni != 0 && arvalid_i != 0 && arready_o != 0;
      rvalid_o = reads == Reads::ACycleEarly ? takes : taken;
      taken = takes;
      const auto hash = config_hash(driver::load_config("tiny"));
      if (takes) word = static_cast<std::uint32_t>(araddr_i == cmodel::kRegHashHigh.address ? hash >> 32 : hash);
      rdata_o = word;
    }
    was_high = clk_i != 0;
    arready_o = reads != Reads::Never && (reads == Reads::OneBehindTheOther || (!taken && rvalid_o == 0)) ? 1 : 0;
    awready_o = 0;
  }
  Ports ports() override {
    return {
#define X(name) name,
        FASTSPLAT_NARROW_PORTS(X)
#undef X
#define X(name) WidePort(name),
            FASTSPLAT_WIDE_PORTS(X)
#undef X
    };
  }
  bool failed() const override { return false; }
  std::string take_output() override { return {}; }
  bool trace(const char*) override { return false; }
  void dump(std::uint64_t) override {}
  void write_coverage(const char*) override {}

  Reads reads;
  bool was_high = false, taken = false;
  std::uint32_t word = 0;

  std::uint8_t clk_i = 0, rst_ni = 0, s_tvalid_i = 0, s_tready_o = 0, m_tready_i = 0, m_tvalid_o = 0, m_tlast_o = 0;
  std::uint8_t awvalid_i = 0, awready_o = 0, wvalid_i = 0, bready_i = 0, bvalid_o = 0, bresp_o = 0;
  std::uint8_t arvalid_i = 0, arready_o = 0, rvalid_o = 0, rready_i = 0, rresp_o = 0, error_o = 0;
  std::uint32_t awaddr_i = 0, wdata_i = 0, araddr_i = 0, rdata_o = 0;
  cmodel::Beat s_tdata_i{};
  std::uint64_t m_tdata_o = 0;
  std::uint8_t wready_o = 0, m_tkeep_o = 0, m_tuser_o = 0, irq_o = 0;
  std::uint32_t tap_tile_o = 0;
  std::uint8_t tap_snap_valid_o = 0, tap_sheet_valid_o = 0, tap_window_valid_o = 0, tap_composite_valid_o = 0,
               tap_sheet_done_o = 0;
  std::uint8_t verdict_valid_o = 0, verdict_hidden_o = 0;
  std::uint32_t verdict_tag_o = 0;
  std::uint32_t tap_snap_tag_o = 0, tap_snap_x_o = 0, tap_snap_y_o = 0, tap_snap_mx_o = 0, tap_snap_my_o = 0;
  std::uint32_t tap_sheet_tag_o = 0, tap_window_tag_o = 0, tap_window_x_o = 0, tap_window_y_o = 0,
                tap_composite_block_o = 0;
  std::uint64_t tap_sums_o = 0, tap_weights_o = 0, tap_state_o = 0;
};

std::unique_ptr<RtlDevice> make(Reads reads) {
  static cmodel::NullPixels none;
  RtlOptions options;
  options.timeout = 500;
  return make_verilated_device(std::make_unique<SilentTop>(reads), driver::load_config("tiny"), none, options);
}

void expect_hang(const std::function<void()>& action, const char* message) {
  try {
    action();
    FAIL() << "went on";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Simulation);
    EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    std::printf("[figure] %s\n", error.what());
  }
}

TEST(SilentBus, AReadThatIsNeverTakenEndsTheRun) {
  expect_hang([] { make(Reads::Never); }, "no register read accepted");
}

TEST(SilentBus, AWriteThatIsNeverTakenEndsTheRun) {
  const auto device = make(Reads::AsThePageSays);
  expect_hang([&] { device->write_register(0, 1, 0); }, "no register write accepted");
}

TEST(SilentBus, AReadThatIsAnsweredEarlyEndsTheRun) {
  expect_hang([] { make(Reads::ACycleEarly); }, "answered one cycle after it was accepted");
}

TEST(SilentBus, AReadThatIsTakenBesideAnotherEndsTheRun) {
  expect_hang([] { make(Reads::OneBehindTheOther); }, "a second register read is accepted");
}

}  // namespace
}  // namespace fastsplat::testbench
