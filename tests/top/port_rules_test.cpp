// SPDX-License-Identifier: Apache-2.0
// Every rule of testbench/module/fastsplat_port_rules.sv is broken once, on ports that a test drives: it fires, by its
// name, and none fires before.
#include <gtest/gtest.h>
#include <verilated.h>

#include <cstdio>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "Vfs_port_rules.h"
#include "testbench/device/failed_assertion.hpp"
#include "testbench/module/simulator_output.hpp"

namespace fastsplat::test {
namespace {

using Ports = Vfs_port_rules;
constexpr std::uint32_t kLeftPixel = 0xffff, kBothPixels = 0xffffffff;  ///< TKEEP of tiny, two pixels a beat
constexpr std::uint8_t kSlverr = 2;

struct Cycle {
  const char* what;
  std::function<void(Ports&)> drive;
};

/// The name of the rule that the first `cycles` break; empty if they break none.
std::string broken_by(const std::vector<Cycle>& cycles) {
  VerilatedContext context;
  context.fatalOnError(false);
  context.errorLimit(std::numeric_limits<int>::max());
  testbench::take_simulator_output();
  Ports ports(&context);
  const auto edge = [&] {
    ports.clk_i = 1;
    ports.eval();
    ports.clk_i = 0;
    ports.eval();
  };
  edge();  // in reset
  ports.rst_ni = 1;
  for (const Cycle& cycle : cycles) {
    cycle.drive(ports);
    edge();
  }
  const std::string name = testbench::first_failed_assertion(testbench::take_simulator_output()).name;
  ports.final();
  return name;
}

void offer_pixels(Ports& p) {
  p.m_tvalid_o = 1;
  p.m_tkeep_i = kBothPixels;
}
void ask_read(Ports& p) { p.arvalid_i = p.arready_o = 1; }
void answer_read(Ports& p) {
  p.arvalid_i = 0;
  p.rvalid_o = 1;
}
void ask_write(Ports& p) { p.awvalid_i = p.awready_o = p.wvalid_i = p.wready_o = 1; }
void answer_write(Ports& p) {
  p.awvalid_i = p.wvalid_i = 0;
  p.bvalid_o = 1;
}

struct Broken {
  const char* rule;
  std::vector<Cycle> legal;
  Cycle wrong;
};
const Broken kBroken[] = {
    {"beat_held", {{"offered", [](Ports& p) { p.s_tvalid_i = 1; }}}, {"withdrawn", [](Ports& p) { p.s_tvalid_i = 0; }}},
    {"beat_held", {{"offered", [](Ports& p) { p.s_tvalid_i = 1; }}}, {"changed", [](Ports& p) { p.s_tdata_i[7] = 1; }}},
    {"pixels_held", {{"offered", offer_pixels}}, {"withdrawn", [](Ports& p) { p.m_tvalid_o = 0; }}},
    {"pixels_held", {{"offered", offer_pixels}}, {"another word", [](Ports& p) { p.m_tdata_o[7] ^= 1; }}},
    {"pixels_held", {{"offered", offer_pixels}}, {"fewer pixels", [](Ports& p) { p.m_tkeep_i = kLeftPixel; }}},
    {"pixels_held", {{"offered", offer_pixels}}, {"the last", [](Ports& p) { p.m_tlast_o = 1; }}},
    {"pixels_held", {{"offered", offer_pixels}}, {"marked", [](Ports& p) { p.m_tuser_o = 1; }}},
    {"write_response_held",
     {{"asked", ask_write}, {"answered", answer_write}},
     {"withdrawn", [](Ports& p) { p.bvalid_o = 0; }}},
    {"write_response_held",
     {{"asked", ask_write}, {"answered", answer_write}},
     {"another", [](Ports& p) { p.bresp_o = kSlverr; }}},
    {"read_response_held",
     {{"asked", ask_read}, {"answered", answer_read}},
     {"withdrawn", [](Ports& p) { p.rvalid_o = 0; }}},
    {"read_response_held",
     {{"asked", ask_read}, {"answered", answer_read}},
     {"another word", [](Ports& p) { p.rdata_o ^= 1; }}},
    {"read_response_held",
     {{"asked", ask_read}, {"answered", answer_read}},
     {"another response", [](Ports& p) { p.rresp_o = kSlverr; }}},
    {"pixels_kept_whole",
     {},
     {"a byte is missing",
      [](Ports& p) {
        offer_pixels(p);
        p.m_tkeep_i = kBothPixels >> 1;
      }}},
    {"pixels_kept_whole",
     {},
     {"the right pixel alone",
      [](Ports& p) {
        offer_pixels(p);
        p.m_tkeep_i = kBothPixels ^ kLeftPixel;
      }}},
    {"pixels_kept_whole", {}, {"none", [](Ports& p) { p.m_tvalid_o = 1; }}},
    {"tile_marked_throughout",
     {{"the first beat",
       [](Ports& p) {
         offer_pixels(p);
         p.m_tready_i = 1;
       }}},
     {"the second is marked", [](Ports& p) { p.m_tuser_o = 1; }}},
    {"write_taken_whole", {}, {"the address alone", [](Ports& p) { p.awvalid_i = p.awready_o = 1; }}},
    {"write_taken_whole", {}, {"the data alone", [](Ports& p) { p.wvalid_i = p.wready_o = 1; }}},
    {"one_response_per_write", {}, {"unasked", [](Ports& p) { p.bvalid_o = 1; }}},
    {"one_response_per_write",
     {{"asked", ask_write}, {"answered", answer_write}, {"taken", [](Ports& p) { p.bready_i = 1; }}},
     {"again", [](Ports&) {}}},
    {"one_response_per_write", {{"asked", ask_write}}, {"the next is taken before", [](Ports&) {}}},
    {"one_response_per_read", {}, {"unasked", [](Ports& p) { p.rvalid_o = 1; }}},
    {"one_response_per_read",
     {{"asked", ask_read}, {"answered", answer_read}, {"taken", [](Ports& p) { p.rready_i = 1; }}},
     {"again", [](Ports&) {}}},
    {"one_response_per_read", {{"asked", ask_read}}, {"the next is taken before", [](Ports&) {}}},
    {"known_response",
     {{"asked", ask_write}},
     {"EXOKAY",
      [](Ports& p) {
        answer_write(p);
        p.bresp_o = 1;
      }}},
    {"known_response",
     {{"asked", ask_read}},
     {"DECERR",
      [](Ports& p) {
        answer_read(p);
        p.rresp_o = 3;
      }}},
};

TEST(PortRules, EachFiresWhenItIsBroken) {
  std::set<std::string> fired;
  for (const Broken& broken : kBroken) {
    std::vector<Cycle> cycles = broken.legal;
    EXPECT_EQ(broken_by(cycles), "") << broken.rule << ", before: " << broken.wrong.what;
    cycles.push_back(broken.wrong);
    EXPECT_EQ(broken_by(cycles), broken.rule) << broken.wrong.what;
    fired.insert(broken.rule);
  }
  std::printf("[figure] rules broken = %zu, ways = %zu\n", fired.size(), std::size(kBroken));
}

}  // namespace
}  // namespace fastsplat::test
