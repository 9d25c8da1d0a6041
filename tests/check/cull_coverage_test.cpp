// SPDX-License-Identifier: Apache-2.0
// Culling bins: the random streams that the plan names hit each of them; a jump of tags needs omitted hidden groups; a
// device without culling has none.
#include <gtest/gtest.h>

#include <cstdio>

#include "testbench/coverage/coverage_collector.hpp"
#include "testbench/stimulus/left_out.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::testbench {
namespace {

constexpr std::uint64_t kSeeds = 12, kSplats = 150;
constexpr StimulusClass kClasses[] = {StimulusClass::Mixed, StimulusClass::Hazards, StimulusClass::Thresholds,
                                      StimulusClass::Saturation, StimulusClass::SparseSheets};

void cover(const cmodel::Config& config, const std::vector<cmodel::Beat>& beats, Coverage& into) {
  CoverageCollector collector(config, cmodel::StreamScope::Subset, {});
  collector.start(0);
  collector.consume(beats);
  collector.finish();
  into.merge(collector.coverage());
}

TEST(CullCoverage, EveryBinIsMet) {
  const auto config = test::named_config("faults/cull");
  Coverage sent, left_out;
  std::uint64_t unsent = 0;
  for (const StimulusClass which : kClasses) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const auto beats = write_document(config, make_stimulus(config, which, seed, kSplats).document);
      cover(config, beats, sent);
      const auto fewer = without_hidden_sets(config, beats);
      unsent += beats.size() - fewer.size();
      cover(config, fewer, left_out);
    }
  }
  std::uint64_t bins = 0;
  for (const auto& bin : left_out.bins()) {
    if (!bin.name.starts_with("culling.")) continue;
    ++bins;
    const std::string& name = bin.name;
    std::printf("[figure] %s = %llu, with hidden sets left out %llu\n", name.c_str(),
                static_cast<unsigned long long>(sent.hits(name)), static_cast<unsigned long long>(bin.hits));
    EXPECT_GT(sent.hits(name) + bin.hits, 0U) << name;
  }
  std::printf("[figure] bins of culling = %llu (limit >= 20), splats left out = %llu (limit > 0)\n",
              static_cast<unsigned long long>(bins), static_cast<unsigned long long>(unsent));
  EXPECT_GE(bins, 20U);
  EXPECT_GT(unsent, 0U);
  EXPECT_EQ(sent.hits("culling.tag_jump"), 0U);
  EXPECT_GT(left_out.hits("culling.tag_jump"), 0U);
  for (const char* of_hidden : {"culling.splat_of_a_hidden_set", "culling.ellipse_of_a_hidden_set"}) {
    EXPECT_GT(sent.hits(of_hidden), 0U) << of_hidden;
    EXPECT_EQ(left_out.hits(of_hidden), 0U) << of_hidden;
  }
}

TEST(CullCoverage, IsNothingWhereNothingIsCulled) {
  const Coverage declared = CoverageCollector::declare(test::named_config("tiny"));
  for (const auto& bin : declared.bins()) EXPECT_FALSE(bin.name.starts_with("culling.")) << bin.name;
  EXPECT_FALSE(declared.bins().empty());
}

}  // namespace
}  // namespace fastsplat::testbench
