// SPDX-License-Identifier: Apache-2.0
// An assertion that fails in the cycle of a mismatch names the cause: the report has both.
#include <gtest/gtest.h>

#include <cstdio>

#include "testbench/device/rtl_module.hpp"
#include "testbench/device/verilated_device.hpp"
#include "testbench/triage/failure.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/testbench/forwarding_top_helper.hpp"

namespace fastsplat::test {
namespace {

using namespace testbench;

/// The RTL of `tiny` with wrong pixels, which an assertion sees, too.
class WrongPixels final : public ForwardingTop {
 public:
  using ForwardingTop::ForwardingTop;
  bool failed() const override { return failed_; }
  std::string take_output() override {
    return "[9] %Error: rules.sv:7: Assertion failed in TOP.fastsplat_dut.u_rules.pixels_kept_whole\n";
  }

 private:
  void eval(bool rises) override {
    failed_ = failed_ || (rises && ports_.m_tvalid_o != 0 && ports_.m_tready_i != 0);
    top_->eval();
    ports_.m_tdata_o.data()[0] = ~0U;
  }
  bool failed_ = false;
};

TEST(AssertionBeside, AMismatchIsReported) {
  const cmodel::Config config = named_config("tiny");
  VerifyOptions options;
  options.config = config;
  options.device = [&](cmodel::PixelSink& pixels, const RtlOptions& rtl) {
    auto top = std::make_unique<WrongPixels>(open_rtl(config, {}, simulator_options(rtl)));
    return make_verilated_device(std::move(top), config, pixels, rtl);
  };
  Random random(seed_or(50));
  const auto source = source_of(to_beats(random_stream(symbols_of(config), random, 60).bytes));
  const VerifyResult seen = verify(source, options);
  EXPECT_EQ(seen.verdict, Verdict::Mismatch) << seen.error;
  const FailureReport report = investigate(source, options, seen, {}, 20);
  std::printf("[figure] %s; then %s\n", report.divergence.c_str(), report.stopped_by.c_str());
  EXPECT_NE(report.divergence.find("stage pixel"), std::string::npos);
  EXPECT_NE(report.stopped_by.find("assertion pixels_kept_whole of the RTL failed in fastsplat_dut.u_rules"),
            std::string::npos);
}

}  // namespace
}  // namespace fastsplat::test
