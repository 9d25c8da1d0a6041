// SPDX-License-Identifier: Apache-2.0
// Streams with random damage: refused at the same beat by model and oracle, or rendered the same by both.
#include <gtest/gtest.h>

#include "cmodel/model.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/small_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/cmodel/verdict_helper.hpp"

namespace fastsplat::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

void damage(Bytes& bytes, Random& random) {
  const auto last = static_cast<std::int64_t>(bytes.size()) - 1;
  const auto beat_at = [&] {
    return static_cast<std::ptrdiff_t>(random.between(0, last / cmodel::kBeatBytes) * cmodel::kBeatBytes);
  };
  switch (random.between(0, 5)) {
    case 0:
      bytes[static_cast<std::size_t>(random.between(0, last))] = static_cast<std::uint8_t>(random.next());
      break;
    case 1:
      bytes[static_cast<std::size_t>(random.between(0, last))] ^= static_cast<std::uint8_t>(1 << random.between(0, 7));
      break;
    case 2: {  // a word, to an end of its range
      const std::size_t at = static_cast<std::size_t>(random.between(0, last / 4) * 4);
      const auto value = static_cast<std::uint32_t>(random.one_of({0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF}));
      for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
      break;
    }
    case 3: {  // a beat over another
      const Bytes copy(bytes.begin() + beat_at(), bytes.end());
      std::copy(copy.begin(), copy.begin() + cmodel::kBeatBytes, bytes.begin() + beat_at());
      break;
    }
    case 4: {  // a beat lost
      const auto at = beat_at();
      if (bytes.size() > 2 * cmodel::kBeatBytes)
        bytes.erase(bytes.begin() + at, bytes.begin() + at + cmodel::kBeatBytes);
      break;
    }
    default: {  // a beat doubled
      const auto at = beat_at();
      const Bytes copy(bytes.begin() + at, bytes.begin() + at + cmodel::kBeatBytes);
      bytes.insert(bytes.begin() + at, copy.begin(), copy.end());
    }
  }
}

TEST(StreamFuzz, DamagedStreamsMeetTheSameVerdict) {
  Random random(seed_or(6));
  const cmodel::Config config = small_stream_config();
  int streams = 0, taken = 0;
  for (; streams < 10000; ++streams) {
    Bytes bytes = small_stream();
    for (std::int64_t i = random.between(1, 4); i > 0; --i) damage(bytes, random);
    if (!random.once_in(4)) seal(bytes);
    bool accepted = false;
    ASSERT_EQ(disagreement(config, bytes, &accepted), "") << "stream " << streams;
    taken += accepted ? 1 : 0;
  }
  for (int i = 0; i < 30; ++i) {
    const cmodel::Config other = i % 2 == 0 ? random_config(random) : random_ellipse_config(random);
    const RandomStream whole = random_stream(symbols_of(other), random, 30);
    for (int j = 0; j < 5; ++j, ++streams) {
      Bytes bytes = whole.bytes;
      damage(bytes, random);
      seal(bytes);
      bool accepted = false;
      ASSERT_EQ(disagreement(other, bytes, &accepted), "") << "stream " << streams;
      taken += accepted ? 1 : 0;
    }
  }
  std::printf("[figure] damaged streams = %d, of which still legal = %d\n", streams, taken);
  EXPECT_GT(taken, 0);
  EXPECT_LT(taken, streams);
}

TEST(StreamFuzz, DamagedPartsNeverDoWorseThanAUserError) {
  Random random(seed_or(7));
  const cmodel::Config config = small_stream_config();
  int refused = 0, taken = 0;
  for (int i = 0; i < 10000; ++i) {
    Bytes bytes = small_stream();
    for (std::int64_t j = random.between(1, 6); j > 0; --j) damage(bytes, random);
    Collector collector;
    cmodel::Model model(config, cmodel::StreamScope::Subset, collector, &collector);
    try {
      model.consume(to_beats(bytes));
      model.finish();
      ++taken;
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Input);
      ++refused;
    }
  }
  std::printf("[figure] damaged parts refused = %d, taken = %d\n", refused, taken);
  EXPECT_GT(refused, 0);
  EXPECT_GT(taken, 0);
}

}  // namespace
}  // namespace fastsplat::test
