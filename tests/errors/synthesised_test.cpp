// SPDX-License-Identifier: Apache-2.0
// Synthesis results of a configuration are found by its hash and equal docs/evidence/synthesis.json.
#include "analysis/errors/synthesised.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "analysis/errors/cost.hpp"
#include "driver/config/config_file.hpp"
#include "tests/paths.hpp"

namespace fastsplat::analysis {
namespace {

using Json = nlohmann::ordered_json;

TEST(Synthesised, IsWhatTheEvidenceKeepsOfTheConfiguration) {
  std::ifstream in(FASTSPLAT_SOURCE_DIR "/docs/evidence/synthesis.json");
  const Json kept = Json::parse(in);
  int compared = 0;
  for (const char* name : {"tiny", "small", "base"}) {
    const auto config = driver::load_config(name);
    const Json found = synthesised(config);
    for (const Json& design : kept) {
      if (!design.contains("modules") || design.at("design") != name) continue;
      const std::string family = design.at("family");
      ASSERT_TRUE(found.contains(family))
          << name << ": kept of another configuration; tools/synth " << family << "-" << name << " makes it anew";
      for (const auto& [cells, count] : design.at("total").items()) {
        EXPECT_EQ(found.at(family).at(cells), count) << name << " " << family << " " << cells;
        ++compared;
      }
      EXPECT_GT(found.at(family).at("levels"), 1);
    }
  }
  std::printf("[figure] figures compared = %d (limit > 0)\n", compared);
  EXPECT_GT(compared, 0);
}

TEST(Synthesised, IsNothingOfOneThatWasNot) {
  auto config = driver::load_config("tiny");
  config.radial_frac_bits += 1;
  EXPECT_TRUE(synthesised(config).is_null());
}

/// Yosys counts the bits of memories in the RTL; cost() has them from the configuration alone.
TEST(Synthesised, GatesHaveTheMemoryOfTheCostModelAndItsOrder) {
  double before = 0.0, gates_before = 0.0;
  for (const char* name : {"tiny", "small", "base", "ellipse"}) {
    const auto config = driver::load_config(name);
    const Json gates = synthesised(config).at("gates");
    const Cost estimate = cost(config);
    EXPECT_EQ(gates.at("memory_bits").get<double>(), estimate.storage_bits) << name;
    const double arithmetic = estimate.adder_bits + estimate.multiplier_bits;
    std::printf("[figure] %s: %.0f kGE, %.1f GE for each cell of arithmetic, %.0f bits of memory\n", name,
                1e-3 * gates.at("ge").get<double>(), gates.at("ge").get<double>() / arithmetic,
                gates.at("memory_bits").get<double>());
    EXPECT_GT(gates.at("ge").get<double>(), gates_before) << name;
    EXPECT_GT(arithmetic, before) << name;
    gates_before = gates.at("ge").get<double>();
    before = arithmetic;
  }
}

}  // namespace
}  // namespace fastsplat::analysis
