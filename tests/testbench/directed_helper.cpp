// SPDX-License-Identifier: Apache-2.0
#include "tests/testbench/directed_helper.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <string>

namespace fastsplat::testbench {

MakeDevice rtl_of(const cmodel::Config& config) {
  return [config](cmodel::PixelSink& pixels, const RtlOptions& options) {
    return make_rtl_device(config, pixels, options);
  };
}

void expect_all(const DirectedResult& result) {
  for (const auto& failure : result.failures) ADD_FAILURE() << failure;
  EXPECT_GT(result.comparisons, 0u);
  EXPECT_GT(result.coverage.bins().size(), 0u);
  for (const auto& bin : result.coverage.bins()) EXPECT_GT(bin.hits, 0u) << bin.name;
  std::printf("[figure] comparisons = %llu (limit > 0)\n", static_cast<unsigned long long>(result.comparisons));
}

int refused_streams(const DirectedResult& result) {
  int all = 0;
  // Also into the report of --gtest_output, which docs/evidence.md is made from.
  const auto keep = [](const std::string& name, std::uint64_t value) {
    ::testing::Test::RecordProperty(name, std::to_string(value));
  };
  for (const auto& [rule, streams] : result.refused) {
    std::printf("[figure] %s: %d streams refused at the model's beat by the model's rule\n", rule.c_str(), streams);
    keep(rule, static_cast<std::uint64_t>(streams));
    all += streams;
  }
  keep("streams", static_cast<std::uint64_t>(all));
  keep("comparisons", result.comparisons);
  std::printf("[figure] streams refused as the model refuses them = %d\n", all);
  return all;
}

}  // namespace fastsplat::testbench
