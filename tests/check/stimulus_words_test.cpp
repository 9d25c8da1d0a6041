// SPDX-License-Identifier: Apache-2.0
// Random streams do not depend on the compiler: the same seed gives the same words. Recorded with GCC 12, and checked
// with every compiler that builds the tests.
#include <gtest/gtest.h>

#include <cstdio>

#include "base/fnv1a.hpp"
#include "testbench/stimulus/cull_frames.hpp"
#include "testbench/stimulus/directed_stream.hpp"
#include "testbench/stimulus/stimulus.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::testbench {
namespace {

std::uint64_t hash_of(std::uint64_t hash, const std::vector<cmodel::Beat>& beats) {
  for (const auto& beat : beats)
    for (const std::uint32_t word : beat) hash = fnv1a(hash, std::uint64_t{word});
  return hash;
}

/// Every class with eight seeds, and the frames of devices that cull or classify.
std::uint64_t words_of(const cmodel::Config& config) {
  std::uint64_t hash = hash_of(kFnv1aStart, small_stream(config));
  for (const StimulusClass which : stimulus_classes())
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      const Stimulus made = make_stimulus(config, which, seed, 200);
      hash = hash_of(hash, write_document(config, made.document));
      hash = fnv1a(fnv1a(fnv1a(hash, made.ready), made.input), made.reset_after);
    }
  if (config.classifies()) hash = hash_of(hash, small_densities(config).first);
  if (!config.culls()) return hash;
  Random random(7);
  for (int i = 0; i < 8; ++i) {
    hash = hash_of(hash, write_document(config, sets_frame(config, random)));
    hash = hash_of(hash, write_document(config, frozen_frame(config, random)));
  }
  return hash;
}

TEST(StimulusWords, AreTheSameUnderEveryCompiler) {
  struct Recorded {
    const char* config;
    std::uint64_t hash;
  };
  for (const auto& [name, recorded] :
       {Recorded{"tiny", 0x13fe58f25affc8cb}, Recorded{"faults/mustfail", 0x237823cc73ae7fad},
        Recorded{"faults/westover", 0x0f6f2b36ff5ba5a4}, Recorded{"faults/cull", 0xca6e570d6726e1d8},
        Recorded{"faults/post", 0x96bd35aa8ae3e67f}}) {
    const std::uint64_t hash = words_of(test::named_config(name));
    std::printf("[figure] words of %s = 0x%016llx\n", name, static_cast<unsigned long long>(hash));
    EXPECT_EQ(hash, recorded) << name;
  }
}

}  // namespace
}  // namespace fastsplat::testbench
