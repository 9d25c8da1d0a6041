// SPDX-License-Identifier: Apache-2.0
// Random streams are legal in every class and configuration: the reader accepts each to its end.
#include "testbench/stimulus/stimulus.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <exception>

#include "cmodel/decode/stream_decode.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::testbench {
namespace {

TEST(Stimulus, IsLegal) {
  int streams = 0;
  std::uint64_t records = 0;
  for (const char* name : {"tiny", "faults/mustfail", "faults/westover", "faults/cull", "faults/post"}) {
    const auto config = test::named_config(name);
    for (const StimulusClass which : stimulus_classes()) {
      for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        cmodel::StreamDecode decode(config, cmodel::StreamScope::Whole);
        try {
          for (const auto& beat : write_document(config, make_stimulus(config, which, seed, 20).document))
            records += decode.feed(beat) != nullptr ? 1 : 0;
          decode.finish();
        } catch (const std::exception& error) {
          FAIL() << name << ", " << to_string(which) << ", seed " << seed << ": " << error.what();
        }
        ++streams;
      }
    }
  }
  std::printf("[figure] legal random streams = %d (limit 9000), records = %llu\n", streams,
              static_cast<unsigned long long>(records));
  EXPECT_EQ(streams, 9000);
  EXPECT_GT(records, 9000U * 20);
}

}  // namespace
}  // namespace fastsplat::testbench
