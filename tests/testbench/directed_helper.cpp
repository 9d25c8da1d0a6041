#include "tests/testbench/directed_helper.hpp"

#include <gtest/gtest.h>

#include <cstdio>

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
  for (const auto& [rule, streams] : result.refused) {
    std::printf("[figure] %s: %d streams refused at the model's beat by the model's rule\n", rule.c_str(), streams);
    all += streams;
  }
  std::printf("[figure] streams refused as the model refuses them = %d\n", all);
  return all;
}

}  // namespace fastsplat::testbench
