// SPDX-License-Identifier: Apache-2.0
// A device that refuses a legal beat is found, and the message names rule, opcode and beat.
#include <gtest/gtest.h>

#include <cstdio>

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

constexpr std::uint32_t kFlipped = 0x80;  ///< of the opcode: no record has it

/// The RTL of `tiny`, which sees one beat with another opcode.
class DamagedBeat final : public ForwardingTop {
 public:
  DamagedBeat(std::unique_ptr<SimulatedTop> top, int beat) : ForwardingTop(std::move(top)), beat_(beat) {}

 private:
  void eval(bool rises) override {
    const bool taken = rises && ports_.rst_ni != 0 && ports_.s_tvalid_i != 0 && ports_.s_tready_o != 0;
    const bool damaged = taken && taken_++ == beat_;
    if (damaged) ports_.s_tdata_i.data()[0] ^= kFlipped;
    top_->eval();
    if (damaged) ports_.s_tdata_i.data()[0] ^= kFlipped;
  }

  int beat_, taken_ = 0;
};

TEST(WrongRefusal, NamesRuleOpcodeAndBeat) {
  const cmodel::Config config = named_config("tiny");
  Random random(seed_or(50));
  const auto beats = to_beats(random_stream(symbols_of(config), random, 60).bytes);
  for (const char* input : {"always", "every-3"}) {
    VerifyOptions options;
    options.config = config;
    options.input = input;
    options.device = [&](cmodel::PixelSink& pixels, const RtlOptions& rtl) {
      auto top = std::make_unique<DamagedBeat>(open_rtl(config, {}, simulator_options(rtl)), 1);
      return make_verilated_device(std::move(top), config, pixels, rtl);
    };
    const VerifyResult seen = verify(source_of(beats), options);
    std::printf("[figure] input %s: %s\n", input, seen.error.c_str());
    EXPECT_EQ(seen.verdict, Verdict::Simulation);
    EXPECT_EQ(seen.fault, "the device refused a legal beat");
    const std::uint32_t opcode = (beats[1][0] & 0xff) ^ kFlipped;
    char wanted[64];
    std::snprintf(wanted, sizeof wanted, "got rule 1 (OPCODE), opcode 0x%X, beat 1)", opcode);
    EXPECT_NE(seen.error.find(wanted), std::string::npos) << wanted;
    EXPECT_EQ(seen.error.find("cycle " + std::to_string(seen.last_cycle) + ":"), 0U) << seen.last_cycle;
  }
}

}  // namespace
}  // namespace fastsplat::test
