// SPDX-License-Identifier: Apache-2.0
// Independence of the order of splats within a sheet, of culling hints, of how beats are passed, and of observing taps.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cmodel/compare_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Chunk = std::array<std::uint8_t, cmodel::kBeatBytes>;

std::vector<Chunk> to_chunks(const Bytes& bytes) {
  std::vector<Chunk> chunks(bytes.size() / cmodel::kBeatBytes);
  for (std::size_t i = 0; i < chunks.size(); ++i)
    std::copy_n(&bytes[i * cmodel::kBeatBytes], cmodel::kBeatBytes, chunks[i].begin());
  return chunks;
}

Bytes to_bytes(const std::vector<Chunk>& chunks) {
  Bytes bytes;
  for (const Chunk& chunk : chunks) bytes.insert(bytes.end(), chunk.begin(), chunk.end());
  seal(bytes);
  return bytes;
}

std::uint64_t compare_pictures(const oracle::Rendering& a, const oracle::Rendering& b, const char* what) {
  std::uint64_t words = 0;
  for (const auto& tile : a.tiles) words += tile.words.size();
  EXPECT_EQ(a.tiles, b.tiles) << what;
  return words;
}

class Order : public ::testing::TestWithParam<std::string> {
 protected:
  cmodel::Config config = named_config(GetParam());
  Random random{seed_or(8)};
  RandomStream stream = random_stream(symbols_of(config), random, 1500);
};

// N-5-4
TEST_P(Order, OfSplatsWithinASheetDoesNotMatter) {
  const oracle::Rendering expected = run_model(config, stream.bytes);
  std::uint64_t words = 0, moved = 0;
  for (int round = 0; round < 3; ++round) {
    std::vector<Chunk> chunks = to_chunks(stream.bytes);
    for (std::size_t begin = first_tile_beat(stream.bytes); begin < chunks.size(); ++begin) {
      std::size_t end = begin;
      while (end < chunks.size() && (chunks[end][0] == 0x50 || chunks[end][0] == 0x45)) ++end;
      // A run of splats and ellipses: new places, the old tags in order (tags count within a tile).
      std::vector<Chunk> before(chunks.begin() + static_cast<std::ptrdiff_t>(begin),
                                chunks.begin() + static_cast<std::ptrdiff_t>(end));
      for (std::size_t i = end; i > begin + 1; --i) {
        const auto j = static_cast<std::size_t>(
            random.between(static_cast<std::int64_t>(begin), static_cast<std::int64_t>(i) - 1));
        std::swap(chunks[i - 1], chunks[j]);
      }
      for (std::size_t i = begin; i < end; ++i) {
        std::copy_n(&before[i - begin][4], 4, &chunks[i][4]);
        moved += chunks[i] != before[i - begin] ? 1 : 0;
      }
      begin = end;
    }
    words += compare_pictures(expected, run_model(config, to_bytes(chunks)), "shuffled splats");
  }
  std::printf("[figure] %s: splats moved = %llu, words compared = %llu, mismatches = 0\n", GetParam().c_str(),
              static_cast<unsigned long long>(moved), static_cast<unsigned long long>(words));
  EXPECT_GT(moved, stream.splats);
  EXPECT_GT(words, 0U);
}

// S-cull-2.
TEST_P(Order, CullingHintsDoNotMatter) {
  std::vector<Chunk> chunks = to_chunks(stream.bytes);
  const auto first = chunks.begin() + static_cast<std::ptrdiff_t>(first_tile_beat(stream.bytes));
  const auto hints = std::count_if(first, chunks.end(), [](const Chunk& chunk) { return chunk[0] == 0x43; });
  chunks.erase(std::remove_if(first, chunks.end(), [](const Chunk& chunk) { return chunk[0] == 0x43; }), chunks.end());
  EXPECT_GT(hints, 0) << "the stream has no hints";
  EXPECT_GT(compare_pictures(run_model(config, stream.bytes), run_model(config, to_bytes(chunks)), "without hints"),
            0U);
}

TEST_P(Order, OfHandingOverBeatsDoesNotMatter) {
  const oracle::Rendering expected = run_model(config, stream.bytes);
  const auto beats = static_cast<std::int64_t>(stream.bytes.size() / cmodel::kBeatBytes);
  for (int round = 0; round < 4; ++round) {
    std::vector<std::size_t> cuts;
    for (int i = 0; i < (round == 0 ? 1 : 200); ++i) cuts.push_back(static_cast<std::size_t>(random.between(0, beats)));
    std::sort(cuts.begin(), cuts.end());
    const Comparison comparison = compare(run_model(config, stream.bytes, Taps::On, cuts), expected);
    EXPECT_EQ(comparison.mismatches, 0U) << comparison.first;
    EXPECT_GT(comparison.total(), 0U);
  }
}

TEST_P(Order, TapsDoNotMatter) {
  const oracle::Rendering watched = run_model(config, stream.bytes), alone = run_model(config, stream.bytes, Taps::Off);
  EXPECT_GT(compare_pictures(watched, alone, "without taps"), 0U);
  EXPECT_EQ(watched.counts, alone.counts);
  EXPECT_TRUE(alone.events.empty());
  EXPECT_FALSE(watched.events.empty());
}

INSTANTIATE_TEST_SUITE_P(Configs, Order, ::testing::Values("tiny", "base", "compact", "ellipse"),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace fastsplat::test
