// SPDX-License-Identifier: Apache-2.0
// The view of a waveform for GTKWave: each port in its group, the instance in focus first.
#include "testbench/triage/wave_view.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace fastsplat::testbench {
namespace {

const char* const kPorts =
    "TOP.clk_i\n"
    "TOP.fastsplat_dut.clk_i\n"
    "TOP.fastsplat_dut.s_tdata_i[255:0]\n"
    "TOP.fastsplat_dut.awvalid_i\n"
    "TOP.fastsplat_dut.rst_ni\n"
    "TOP.fastsplat_dut.rready_i\n"
    "TOP.fastsplat_dut.u_top.u_core.u_splat.clk_i\n"
    "TOP.fastsplat_dut.u_top.u_core.u_splat.gen_row[0].gen_bank[1].u_bank.sums_o[43:0]\n";

TEST(WaveView, PutsEachPortInItsGroup) {
  std::istringstream ports(kPorts);
  EXPECT_EQ(
      wave_view("a.fst", ports,
                WaveFocus{.cycle = 113, .instance = "u_top.u_core.u_splat.gen_row[0].gen_bank[1].u_bank"}),
      std::string(kWaveViewMark) +
          "\n[dumpfile] \"a.fst\"\n[savefile] \"a.gtkw\"\n[size] 1600 1000\n[sst_width] 250\n[signals_width] 320\n"
          "[timestart] 187\n*-4.0 227\n"
          "@800200\n-look at u_top.u_core.u_splat.gen_row[0].gen_bank[1].u_bank\n"
          "@22\nTOP.fastsplat_dut.u_top.u_core.u_splat.gen_row[0].gen_bank[1].u_bank.sums_o[43:0]\n"
          "@1000200\n-look at u_top.u_core.u_splat.gen_row[0].gen_bank[1].u_bank\n"
          "@800200\n-clock, reset, events\n@28\nTOP.fastsplat_dut.clk_i\n@28\nTOP.fastsplat_dut.rst_ni\n"
          "@1000200\n-clock, reset, events\n"
          "@800200\n-beats in\n@22\nTOP.fastsplat_dut.s_tdata_i[255:0]\n@1000200\n-beats in\n"
          "@800200\n-registers\n@28\nTOP.fastsplat_dut.awvalid_i\n@28\nTOP.fastsplat_dut.rready_i\n"
          "@1000200\n-registers\n"
          "@c00200\n-u_splat\n@28\nTOP.fastsplat_dut.u_top.u_core.u_splat.clk_i\n@1401200\n-u_splat\n");
}

TEST(WaveView, WithoutFocusHasNoMarker) {
  std::istringstream ports(kPorts);
  const std::string view = wave_view("a.fst", ports, {});
  EXPECT_EQ(view.find("\n*"), std::string::npos) << view;
  EXPECT_EQ(view.find("look at"), std::string::npos) << view;
}

}  // namespace
}  // namespace fastsplat::testbench
