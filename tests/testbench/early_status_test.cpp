// SPDX-License-Identifier: Apache-2.0
// BUSY and IRQ mean "the sink has taken it" (docs/integration.md): verify finds a device whose registers say so too
// early, or never.
#include <gtest/gtest.h>

#include <cstdio>
#include <iterator>

#include "cmodel/io/register_map.hpp"
#include "testbench/check/verify.hpp"
#include "testbench/device/rtl_module.hpp"
#include "testbench/device/verilated_device.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/testbench/forwarding_top_helper.hpp"

namespace fastsplat::test {
namespace {

using namespace testbench;

enum class Lie { None, IdleTooEarly, FrameTooEarly, FrameNever };

/// The RTL of `tiny` whose answers to reads of STATUS or IRQ are wrong.
class LyingTop final : public ForwardingTop {
 public:
  LyingTop(std::unique_ptr<SimulatedTop> top, Lie lie) : ForwardingTop(std::move(top)), lie_(lie) {}

 private:
  void eval(bool rises) override {
    if (rises && ports_.arvalid_i != 0 && ports_.arready_o != 0) address_ = ports_.araddr_i.value();
    top_->eval();
    if (rises && ports_.rvalid_o != 0) ports_.rdata_o.drive(answer(ports_.rdata_o.value()));
  }
  std::uint32_t answer(std::uint32_t word) const {
    if (lie_ == Lie::IdleTooEarly && address_ == cmodel::kRegStatus.address) return word & ~cmodel::kStatusBusy;
    if (lie_ == Lie::FrameTooEarly && address_ == cmodel::kRegIrq.address) return word | cmodel::kIrqFrame;
    if (lie_ == Lie::FrameNever && address_ == cmodel::kRegIrq.address) return word & ~cmodel::kIrqFrame;
    return word;
  }

  Lie lie_;
  std::uint32_t address_ = 0;
};

VerifyResult verify_with(Lie lie, const char* ready) {
  const cmodel::Config config = named_config("tiny");
  VerifyOptions options;
  options.config = config;
  options.ready = ready;
  options.device = [&](cmodel::PixelSink& pixels, const RtlOptions& rtl) {
    auto top = std::make_unique<LyingTop>(open_rtl(config, {}, simulator_options(rtl)), lie);
    return make_verilated_device(std::move(top), config, pixels, rtl);
  };
  Random random(seed_or(50));
  return verify(source_of(to_beats(random_stream(symbols_of(config), random, 60).bytes)), options);
}

TEST(EarlyStatus, IsFoundUnderEverySink) {
  const struct {
    Lie lie;
    const char* finding;
  } kCases[] = {{Lie::IdleTooEarly, "BUSY is 0, and the sink has not taken all pixels"},
                {Lie::FrameTooEarly, "IRQ bit 0 is 1, and pixels of the frame wait"},
                {Lie::FrameNever, "the frame has left, and IRQ bit 0 is 0"}};
  std::size_t found = 0;
  for (const char* ready : {"always", "every-9", "random-10"}) {
    const VerifyResult healthy = verify_with(Lie::None, ready);
    EXPECT_EQ(healthy.verdict, Verdict::Pass) << healthy.error;
    for (const auto& [lie, finding] : kCases) {
      const VerifyResult seen = verify_with(lie, ready);
      EXPECT_EQ(seen.verdict, Verdict::Simulation) << finding << ", " << ready;
      EXPECT_EQ(seen.fault, finding) << ready;
      EXPECT_NE(seen.error.find("look at u_top.ends_q"), std::string::npos) << seen.error;
      if (found++ < std::size(kCases)) std::printf("[figure] %s\n", seen.error.c_str());
    }
  }
  std::printf("[figure] registers that say too early, or never, that a frame has left = %zu\n", found);
}

}  // namespace
}  // namespace fastsplat::test
