// SPDX-License-Identifier: Apache-2.0
// Several devices on one link (docs/scaling.md). One device counts as the cycle model does. Each of several counts as
// it would alone on its tiles. All of them count as a second, clocked model does.
#include "cmodel/cycles/cycle_cluster.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "cmodel/cycles/cluster_account.hpp"
#include "cmodel/model.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/plain_cluster_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

using cmodel::Beat, cmodel::CycleCluster, cmodel::Opcode;
using cmodel::StreamScope;

/// ReadyPattern in one cycle of N, or in runs of N.
struct OneOf final : cmodel::ReadyPattern {
  std::uint64_t n;
  explicit OneOf(std::uint64_t number) : n(number) {}
  std::uint64_t next(std::uint64_t cycle) const override { return (cycle + n - 1) / n * n; }
};
struct Runs final : cmodel::ReadyPattern {
  std::uint64_t n;
  explicit Runs(std::uint64_t number) : n(number) {}
  std::uint64_t next(std::uint64_t cycle) const override { return cycle / n % 2 == 0 ? cycle : (cycle / n + 1) * n; }
};

/// begin_frame and tables; the tiles; all of it, with end_frame.
struct Pieces {
  std::vector<Beat> preamble, whole;
  std::vector<std::vector<Beat>> tiles;
};

Pieces random_pieces(const cmodel::Config& config, Random& random, std::uint64_t splats) {
  const auto stream = random_stream(symbols_of(config), random, splats, SetOrder::Whole);
  Pieces out;
  out.whole = to_beats(stream.bytes);
  const std::size_t first = first_tile_beat(stream.bytes);
  out.preamble.assign(out.whole.begin(), out.whole.begin() + static_cast<std::ptrdiff_t>(first));
  for (std::size_t i = first; i + 1 < out.whole.size(); ++i) {
    if (static_cast<Opcode>(get(out.whole[i], cmodel::layout::kOpcode)) == Opcode::BeginTile) out.tiles.emplace_back();
    out.tiles.back().push_back(out.whole[i]);
  }
  return out;
}

CycleCluster run(const cmodel::Config& config, const Pieces& pieces, const cmodel::ClusterOptions& options,
                 bool end_frame = true) {
  CycleCluster cluster(config, end_frame ? StreamScope::Whole : StreamScope::Subset, options);
  // In pieces of any length.
  const auto beats = std::span(pieces.whole).first(pieces.whole.size() - (end_frame ? 0 : 1));
  for (std::size_t at = 0; at < beats.size(); at += 37)
    cluster.consume(beats.subspan(at, std::min<std::size_t>(37, beats.size() - at)));
  cluster.finish();
  return cluster;
}

/// Counters that both have; every comparison is counted.
class Compared {
 public:
  void same(std::uint64_t a, std::uint64_t b, const char* what) {
    ++count;
    EXPECT_EQ(a, b) << what;
  }
  void same(const cmodel::StallCounters& a, const cmodel::StallCounters& b) {
#define X(name, counter, meaning) same(a.name, b.name, #name);
    FASTSPLAT_STALL_COUNTERS(X)
#undef X
  }
  void same(const cmodel::DeviceCycles& a, const cmodel::CycleModel& b) {
    same(a.stalls, b.stalls());
    std::vector<std::uint64_t> values;
    a.account.for_each([&](const char*, std::uint64_t value, const char*) { values.push_back(value); });
    std::size_t i = 0;
    b.account().for_each([&](const char* name, std::uint64_t value, const char*) { same(values[i++], value, name); });
    same(a.idle, b.idle_cycles(), "idle");
    same(a.end, b.end_cycle(), "end");
    same(a.pixel_beats, b.pixel_beats(), "beats of pixels");
    EXPECT_EQ(a.counters, b.counters());
  }
  void figure(const std::string& what, std::uint64_t limit) const {
    std::printf("[figure] %s = %llu (limit >= %llu)\n", what.c_str(), static_cast<unsigned long long>(count),
                static_cast<unsigned long long>(limit));
    EXPECT_GE(count, limit);
  }
  std::uint64_t count = 0;
};

class ClusterOf : public ::testing::TestWithParam<std::string> {
 protected:
  cmodel::Config config() const { return named_config(GetParam()); }
};

TEST_P(ClusterOf, OneDeviceIsTheCycleModel) {
  Random random(seed_or(71));
  Compared compared;
  const OneOf third(3);
  const Runs runs(7);
  for (int i = 0; i < 4; ++i) {
    const Pieces pieces = random_pieces(config(), random, 300);
    for (const cmodel::ReadyPattern* input :
         {static_cast<const cmodel::ReadyPattern*>(nullptr), static_cast<const cmodel::ReadyPattern*>(&third),
          static_cast<const cmodel::ReadyPattern*>(&runs)}) {
      for (const cmodel::ReadyPattern* output :
           {static_cast<const cmodel::ReadyPattern*>(nullptr), static_cast<const cmodel::ReadyPattern*>(&runs)}) {
        const cmodel::CycleOptions options{.input = input, .output = output};
        const auto cluster = run(config(), pieces, {.device = options});
        cmodel::CycleModel model(config(), StreamScope::Whole, options);
        model.consume(pieces.whole);
        model.finish();
        ASSERT_EQ(cluster.devices().size(), 1U);
        compared.same(cluster.devices()[0], model);
      }
    }
  }
  compared.figure(GetParam() + " counts of one device compared", 300);
}

TEST_P(ClusterOf, EachDeviceCountsItsOwnTiles) {
  Random random(seed_or(72));
  Compared compared;
  std::uint64_t dealt = 0, most = 0;
  const Runs runs(6);
  for (int i = 0; i < 3; ++i) {
    const cmodel::CycleOptions options{.output = i == 1 ? &runs : nullptr};
    const Pieces pieces = random_pieces(config(), random, 900);
    for (const int devices : {1, 2, 3, 5, 8}) {
      const auto cluster = run(config(), pieces, {.devices = devices, .device = options}, false);
      std::vector<int> times(pieces.tiles.size(), 0);
      for (const auto& device : cluster.devices()) {
        cmodel::CycleModel alone(config(), StreamScope::Subset, options);
        alone.consume(pieces.preamble);
        for (const std::uint32_t tile : device.tiles) {
          alone.consume(pieces.tiles.at(tile));
          ++times[tile];
        }
        alone.finish();
        compared.same(device, alone);
        dealt += device.tiles.size();
        most = std::max<std::uint64_t>(most, device.tiles.size());
      }
      for (const int once : times) compared.same(static_cast<std::uint64_t>(once), 1, "a tile is dealt once");
    }
  }
  std::printf("[figure] %s tiles dealt = %llu, at most %llu to a device\n", GetParam().c_str(),
              static_cast<unsigned long long>(dealt), static_cast<unsigned long long>(most));
  EXPECT_GT(most, 1U);
  compared.figure(GetParam() + " counts of devices compared", 800);
}

TEST_P(ClusterOf, EqualsTheClockedModel) {
  Random random(seed_or(73));
  Compared compared;
  std::uint64_t late = 0;
  for (int i = 0; i < 2; ++i) {
    const Pieces pieces = random_pieces(config(), random, 250);
    const auto beats = plain_beats(config(), pieces.whole);
    for (const std::uint64_t rate : {0, 1, 7, 16, 32, 33, 40, 64, 100, 1000}) {
      const int devices = static_cast<int>(random.between(1, 6));
      const auto queue = static_cast<std::uint64_t>(random.one_of({1, 2, 3, 8, 64, 512}));
      SCOPED_TRACE(std::to_string(devices) + " devices, " + std::to_string(rate) + " bytes, queue " +
                   std::to_string(queue));
      const auto cluster = run(config(), pieces, {.devices = devices, .bytes_per_cycle = rate, .queue_beats = queue});
      const auto plain = plain_cluster(config(), beats, static_cast<std::size_t>(devices), rate, queue);
      for (std::size_t d = 0; d < plain.size(); ++d) {
        EXPECT_EQ(cluster.devices()[d].tiles, plain[d].tiles) << d;
        compared.same(cluster.devices()[d].tiles.size(), plain[d].tiles.size(), "tiles");
        compared.same(cluster.devices()[d].stalls, plain[d].stalls);
        compared.same(cluster.devices()[d].end, plain[d].end, "end");
        late += plain[d].stalls.stall_input;
      }
      compared.same(cluster.beats_in(), beats.size(), "beats");
      if (::testing::Test::HasFailure()) return;
    }
  }
  std::printf("[figure] %s cycles without input = %llu\n", GetParam().c_str(), static_cast<unsigned long long>(late));
  EXPECT_GT(late, 1000U);
  compared.figure(GetParam() + " counts compared with the clocked model", 200);
}

INSTANTIATE_TEST_SUITE_P(Cycles, ClusterOf, ::testing::ValuesIn(config_names()),
                         [](const auto& name) { return name.param; });

TEST(Cluster, ABeatACycleForEachDeviceIsNotALimit) {
  Random random(seed_or(74));
  Compared compared;
  const auto config = named_config("small");
  for (const int devices : {1, 2, 3, 4, 7, 16}) {
    const Pieces pieces = random_pieces(config, random, 800);
    for (const std::uint64_t queue : {1, 2, 512}) {
      const auto free = run(config, pieces, {.devices = devices, .queue_beats = queue});
      const auto wide = run(config, pieces,
                            {.devices = devices,
                             .bytes_per_cycle = cmodel::kBeatBytes * static_cast<std::uint64_t>(devices),
                             .queue_beats = queue});
      for (std::size_t d = 0; d < free.devices().size(); ++d) {
        EXPECT_EQ(free.devices()[d].tiles, wide.devices()[d].tiles);
        compared.same(free.devices()[d].stalls, wide.devices()[d].stalls);
        compared.same(free.devices()[d].end, wide.devices()[d].end, "end");
      }
    }
  }
  compared.figure("counts of devices with a beat a cycle compared", 300);
}

TEST(Cluster, SharesAreAllCyclesAndNoFrameIsBelowTheRoofline) {
  Random random(seed_or(75));
  int frames = 0;
  std::uint64_t stream_rules = 0;
  const Runs runs(5);
  for (const auto& name : {"tiny", "small", "base"}) {
    const auto config = named_config(name);
    const Pieces pieces = random_pieces(config, random, 400);
    for (const int devices : {1, 2, 4, 9}) {
      for (const std::uint64_t rate : {0, 1, 8, 32, 100}) {
        const auto cluster =
            run(config, pieces, {.devices = devices, .bytes_per_cycle = rate, .device = {.output = &runs}});
        const auto shares = cmodel::frame_shares(config, cluster);
        std::uint64_t sum = 0;
        shares.for_each([&](const char*, std::uint64_t cycles, const char*) { sum += cycles; });
        EXPECT_EQ(sum, cluster.frame_cycles() * static_cast<std::uint64_t>(devices));
        EXPECT_TRUE(rate > 0 || shares.bandwidth == 0U);
        EXPECT_TRUE(devices > 1 || shares.tail == 0U);
        const auto bounds = cmodel::roofline(config, cluster, rate);
        std::uint64_t largest = 0;
        bounds.for_each([&](const char* what, std::uint64_t cycles, const char*) {
          EXPECT_LE(cycles, cluster.frame_cycles()) << what;
          largest = std::max(largest, cycles);
        });
        stream_rules += largest == bounds.stream ? 1 : 0;
        ++frames;
      }
    }
  }
  std::printf("[figure] frames that differ = %d, the stream ruled in %llu\n", frames,
              static_cast<unsigned long long>(stream_rules));
  EXPECT_EQ(frames, 60);
  EXPECT_GT(stream_rules, 0U);
}

/// Each with a source of its own, which leaves hidden cull groups out.
TEST(Cluster, DevicesThatFetchCountTheirOwnTiles) {
  Random random(seed_or(77));
  Compared compared;
  std::uint64_t all = 0, sent = 0;
  for (const char* name : {"tiny", "small", "base"}) {
    cmodel::Config config = named_config(name);
    config.cull_map = static_cast<int>(cmodel::CullMap::Block);
    const Pieces pieces = random_pieces(config, random, 900);
    cmodel::NullPixels nowhere;
    cmodel::CullLog log;
    cmodel::Model model(config, StreamScope::Whole, nowhere);
    model.log_culls(&log);
    model.consume(pieces.whole);
    model.finish();
    const cmodel::CycleOptions options{.culls = &log, .fetch = cmodel::Fetch{12}};
    for (const int devices : {1, 2, 3, 8}) {
      const auto cluster = run(config, pieces, {.devices = devices, .device = options}, false);
      std::uint64_t beats = 0;
      for (const auto& device : cluster.devices()) {
        cmodel::CycleModel alone(config, StreamScope::Subset, options);
        alone.consume(pieces.preamble);
        for (const std::uint32_t tile : device.tiles) alone.consume(pieces.tiles.at(tile));
        alone.finish();
        compared.same(device, alone);
        beats += alone.sent().total();
      }
      compared.same(cluster.beats_in(), beats, "beats");
      all += pieces.whole.size() - 1 + static_cast<std::uint64_t>(devices - 1) * pieces.preamble.size();
      sent += beats;
    }
  }
  std::printf("[figure] beats fetched = %llu of %llu\n", static_cast<unsigned long long>(sent),
              static_cast<unsigned long long>(all));
  EXPECT_LT(sent, all);
  compared.figure("counts of devices that fetch compared", 800);
}

TEST(Cluster, AStreamThatBreaksARuleIsRefusedAsByOneDevice) {
  Random random(seed_or(76));
  const auto config = named_config("tiny");
  Pieces pieces = random_pieces(config, random, 50);
  pieces.whole.back()[3] ^= 1;  // the checksum
  EXPECT_THROW(run(config, pieces, {.devices = 3}), UserError);
  pieces.whole.pop_back();
  EXPECT_THROW(run(config, pieces, {.devices = 3}), UserError);
}

}  // namespace
}  // namespace fastsplat::test
