// SPDX-License-Identifier: Apache-2.0
// The fast unit on random legal streams: saturation, odd tables, every window phase, many windows a splat.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "cmodel/fast/tile_unit.hpp"
#include "cmodel/model.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

using cmodel::Counters;
using namespace cmodel::fast;

/// Finished tiles, in order.
struct Tiles final : cmodel::PixelSink {
  void on_tile(cmodel::TilePixels&& tile) override { all.push_back(std::move(tile)); }
  std::vector<cmodel::TilePixels> all;
};

std::vector<std::uint64_t> values(const Counters& counters) {
  std::vector<std::uint64_t> out;
  counters.for_each([&](const char*, std::uint64_t value, const char*) { out.push_back(value); });
  return out;
}

struct Tally {
  std::uint64_t tiles = 0, redone = 0, mismatches = 0, hidden = 0;
  // In completed tiles: records of ellipses; samples composited one by one; of these, frozen ones and words cut to 1.0
  // or to the largest.
  std::uint64_t ellipses = 0, samples = 0, frozen = 0, cut = 0;
  std::uint64_t classified = 0;  ///< pixels of densities, likewise

  Tally& operator+=(const Tally& more) {
    tiles += more.tiles, redone += more.redone, mismatches += more.mismatches, hidden += more.hidden;
    ellipses += more.ellipses, samples += more.samples, frozen += more.frozen, cut += more.cut;
    classified += more.classified;
    return *this;
  }
};

/// Feeds the records of a stream to a fast unit; tiles that it gives up are taken from the plain run, with their
/// counters.
template <class Word>
void compare(const cmodel::Config& config, const FrameTables& tables, std::span<const cmodel::Beat> beats,
             std::size_t first, Tally& tally) {
  Tiles fast_tiles;
  TileUnit<Word> fast(tables, fast_tiles);
  Tiles plain_tiles;
  cmodel::Model plain(config, cmodel::StreamScope::Subset, plain_tiles);
  plain.consume(beats.first(first));
  cmodel::StreamDecode decode(config, cmodel::StreamScope::Subset);
  for (const auto& beat : beats.first(first)) decode.feed(beat);
  std::vector<std::uint64_t> plain_before, fast_before;
  std::uint64_t ellipses = 0;
  bool samples = false, densities = false;
  Counters before;
  for (const auto& beat : beats.subspan(first)) {
    const cmodel::Record* record = decode.feed(beat);
    ASSERT_NE(record, nullptr);
    if (const auto* splat = std::get_if<cmodel::SplatRecord>(record)) fast.splats({splat, 1});
    if (const auto* ellipse = std::get_if<cmodel::EllipseRecord>(record)) {
      ++ellipses;
      fast.ellipses({ellipse, 1});
    }
    if (const auto* set = std::get_if<cmodel::CullBlock>(record)) fast.cull_blocks({set, 1});
    if (const auto* tile = std::get_if<cmodel::BeginTile>(record)) {
      plain_before = values(plain.counters());
      fast_before = values(fast.counters());
      fast.begin_tile(*tile);
      ellipses = 0;
      samples = cmodel::every_sample(tile->mode);
      densities = cmodel::holds_densities(tile->mode);
      before = plain.counters();
    }
    if (const auto* sheet = std::get_if<cmodel::BeginSheet>(record)) fast.begin_sheet(*sheet);
    if (const auto* sheet = std::get_if<cmodel::EndSheet>(record)) fast.end_sheet(*sheet);
    plain.consume({&beat, 1});
    const auto* end = std::get_if<cmodel::EndTile>(record);
    if (end == nullptr) continue;
    fast.end_tile(*end);
    ++tally.tiles;
    if (!fast.sound()) {
      ++tally.redone;
      EXPECT_EQ(fast_tiles.all.size() + 1, plain_tiles.all.size());
      fast_tiles.all.push_back(plain_tiles.all.back());
      continue;
    }
    tally.ellipses += ellipses;
    if (densities) tally.classified += plain.counters().pixels_composited - before.pixels_composited;
    if (samples) {
      const Counters& now = plain.counters();
      tally.samples += now.pixels_composited - before.pixels_composited;
      tally.frozen += now.frozen_pixels - before.frozen_pixels;
      tally.cut +=
          now.opacity_saturated + now.composite_saturated - before.opacity_saturated - before.composite_saturated;
    }
    ASSERT_EQ(fast_tiles.all.size(), plain_tiles.all.size());
    tally.mismatches += fast_tiles.all.back().words != plain_tiles.all.back().words ? 1 : 0;
    const auto plain_now = values(plain.counters()), fast_now = values(fast.counters());
    for (std::size_t i = 0; i < plain_now.size(); ++i)
      tally.mismatches += plain_now[i] - plain_before[i] != fast_now[i] - fast_before[i] ? 1 : 0;
  }
  tally.hidden += fast.hidden_splats();
}

/// The number of `rounds` random streams that the fast unit accepts.
template <class Draw>
Tally random_streams(const char* name, int rounds, std::uint64_t least_planned, Draw draw) {
  Random random(20261122);
  Tally all;
  std::uint64_t planned = 0;
  for (int round = 0; round < rounds; ++round) {
    const cmodel::Config config = draw(random, round);
    const RandomStream stream = random_stream(symbols_of(config), random, 300);
    const auto beats = to_beats(stream.bytes);
    const std::size_t first = first_tile_beat(stream.bytes);
    const auto tables = frame_tables(config, std::span(beats).first(first));
    if (!tables) continue;
    ++planned;
    Tally tally;
    if (tables->plan.narrow)
      compare<std::uint16_t>(config, *tables, beats, first, tally);
    else
      compare<std::uint32_t>(config, *tables, beats, first, tally);
    all += tally;
    EXPECT_EQ(tally.mismatches, 0u) << "round " << round << " " << config.name;
  }
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  std::printf(
      "[figure] %s: streams the fast unit takes = %llu of %d; tiles %llu, given up %llu, splats hidden %llu, ellipses "
      "%llu, samples %llu (frozen %llu, words cut %llu), densities %llu, different %llu (limit 0)\n",
      name, number(planned), rounds, number(all.tiles), number(all.redone), number(all.hidden), number(all.ellipses),
      number(all.samples), number(all.frozen), number(all.cut), number(all.classified), number(all.mismatches));
  EXPECT_GT(planned, least_planned);
  EXPECT_GT(all.tiles, all.redone) << "all given up: nothing was compared";
  return all;
}

/// The named configurations, then random ones.
cmodel::Config any_config(Random& random, int round, int named) {
  const auto names = config_names();
  return round < named ? named_config(names[static_cast<std::size_t>(round) % names.size()]) : random_config(random);
}

TEST(FastUnit, RandomStreams) {
  random_streams("circles in sheets", 60, 20, [](Random& random, int round) {
    cmodel::Config config = any_config(random, round, 24);
    config.composite_every_sample = 0;
    return config;
  });
}

// Footprints that the unit computes window by window.
TEST(FastUnit, RandomStreamsOfOtherIndices) {
  random_streams("other kinds of index", 120, 20, [](Random& random, int round) {
    constexpr cmodel::IndexKind kKinds[] = {cmodel::IndexKind::Linear, cmodel::IndexKind::Squared,
                                            cmodel::IndexKind::SquaredElliptic, cmodel::IndexKind::Blit2d,
                                            cmodel::IndexKind::Separable};
    cmodel::Config config = random_config(random, kKinds[round % 5]);
    config.composite_every_sample = 0;
    return config;
  });
}

TEST(FastUnit, RandomStreamsOnADeviceThatCulls) {
  random_streams("on a device that culls", 120, 5, [](Random& random, int round) {
    cmodel::Config config = any_config(random, round, 24);
    config.composite_every_sample = 0;
    config.cull_map = static_cast<int>(cmodel::CullMap::Block);
    return config;
  });
}

TEST(FastUnit, RandomStreamsOfEllipses) {
  const Tally all = random_streams("ellipses in sheets", 120, 20, [](Random& random, int round) {
    cmodel::Config config = round < 12 ? named_config("ellipse") : random_ellipse_config(random);
    config.composite_every_sample = 0;
    return config;
  });
  EXPECT_GT(all.ellipses, 500u);
}

TEST(FastUnit, RandomStreamsOfDensities) {
  const Tally all = random_streams("densities", 160, 30, [](Random& random, int round) {
    cmodel::Config config = any_config(random, round, 60);
    config.cull_map = 0;
    config.composite_every_sample = 0;
    config.classify_segment_bits = std::min(config.sheet_frac_bits, round % 7 + 2);
    config.pattern_node_bits = round % 5;
    return cmodel::first_violation(config) ? named_config("base") : config;
  });
  EXPECT_GT(all.classified, 50000u);
}

TEST(FastUnit, RandomStreamsOfSamples) {
  const Tally all = random_streams("every sample", 160, 30, [](Random& random, int round) {
    cmodel::Config config = round < 80   ? any_config(random, round, 40)
                            : round < 92 ? named_config("ellipse")
                                         : random_ellipse_config(random);
    config.composite_lanes = 0;
    config.composite_every_sample = 1;
    return config;
  });
  EXPECT_GT(all.ellipses, 500u);
  EXPECT_GT(all.samples, 50000u);
  EXPECT_GT(all.cut, 1000u);
  EXPECT_GT(all.frozen, 1000u);
  EXPECT_GT(all.hidden, 10u);
}

/// Tables of one set of one window, in which every pixel weighs 1.0 or the largest weight.
void load_flat_footprint(StreamWriter& stream, const cmodel::Config& config) {
  const auto extent = static_cast<std::uint32_t>(config.lanes), phases = static_cast<std::uint32_t>(config.phases);
  stream.load_table(0, 0, extent * phases / 2, 0, std::vector<std::uint32_t>(std::size_t{phases} * extent, 0));
  const auto weight =
      static_cast<std::uint32_t>(std::min(config.weight_format().max, std::int64_t{1} << config.radial_frac_bits));
  stream.load_table(1, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.radial_entries), weight));
}

/// A tile that freezes whole, and after it `splats` at one place, each with two fifths of the largest red and `above`
/// sixteenths less tau.
std::vector<std::uint8_t> hidden_stream(const cmodel::Config& config, int mode, int splats, std::uint32_t above) {
  StreamWriter stream(symbols_of(config));
  stream.begin_frame(config.tile_width, config.tile_height, 1);
  load_flat_footprint(stream, config);
  std::vector<std::uint32_t> factor;
  for (int i = 0; i <= config.opacity_segments; ++i) {
    const double tau = std::ldexp(i, config.sheet_int_bits) / config.opacity_segments;
    factor.push_back(static_cast<std::uint32_t>(std::floor(
        std::ldexp(tau > 0 ? -std::expm1(-tau) / tau : 1.0, config.opacity_frac_bits) + (i == 0 ? 0.0 : 0.5))));
  }
  stream.load_table(2, 0, 0, 0, factor);
  stream.begin_tile(mode, 0, 0, 0, config.tile_width, config.tile_height);
  const auto largest = static_cast<std::uint32_t>(config.colour_format().max);
  const auto word = [&](int pixel) { return pixel * (1 << config.position_frac_bits); };
  std::uint32_t sheet = 0;
  for (; sheet < 12; ++sheet) {
    stream.begin_sheet(sheet);
    for (int y = 0; y <= config.tile_height + config.lanes; y += config.lanes)
      for (int x = 0; x <= config.tile_width + config.lanes; x += config.lanes)
        stream.splat(0, word(x), word(y), {largest, largest / 2, 0, largest});
    stream.end_sheet();
  }
  stream.begin_sheet(sheet);
  const std::uint32_t some = largest * 2 / 5;
  for (int i = 0; i < splats; ++i)
    stream.splat(0, word(config.tile_width / 2), word(config.tile_height / 2),
                 {some, some / 3, 0, some - some * above / 16});
  stream.end_sheet();
  stream.end_tile();
  stream.end_frame();
  return stream.bytes();
}

// Sums behind frozen pixels do not change the picture, but may still leave the sheet's format or make an opacity above
// 1.0.
TEST(FastUnit, HiddenSplatsAreCounted) {
  Tally all;
  for (const char* name : {"base", "compact", "exact", "small", "tiny"}) {
    const cmodel::Config config = named_config(name);
    for (const int mode : {0, 1}) {
      // Colours above tau by zero, by little, and by more than any opacity allows.
      for (const std::uint32_t above : {0, 1, 9}) {
        for (int splats = 1; splats <= 16; ++splats) {
          const auto bytes = hidden_stream(config, mode, splats, above);
          const auto beats = to_beats(bytes);
          const std::size_t first = first_tile_beat(bytes);
          const auto tables = frame_tables(config, std::span(beats).first(first));
          ASSERT_TRUE(tables);
          Tally tally;
          if (tables->plan.narrow)
            compare<std::uint16_t>(config, *tables, beats, first, tally);
          else
            compare<std::uint32_t>(config, *tables, beats, first, tally);
          EXPECT_EQ(tally.mismatches, 0u) << name << ", mode " << mode << ", " << splats << " splats, above " << above;
          EXPECT_GT(tally.hidden, 0u) << name << ", mode " << mode << ": nothing froze";
          all += tally;
        }
      }
    }
  }
  std::printf("[figure] tiles with hidden splats = %llu, given up %llu, different %llu (limit 0)\n",
              static_cast<unsigned long long>(all.tiles), static_cast<unsigned long long>(all.redone),
              static_cast<unsigned long long>(all.mismatches));
  EXPECT_GT(all.redone, 0u) << "no sum was ever too large";
  EXPECT_GT(all.tiles, all.redone) << "every tile was given up";
}

// An omitted group does not affect the splats of the next tile, whose tags restart.
TEST(FastUnit, SetsLeftOutEndWithTheirTile) {
  Tally all;
  for (const char* name : {"base", "small", "tiny"}) {
    cmodel::Config config = named_config(name);
    config.cull_map = static_cast<int>(cmodel::CullMap::Block);
    StreamWriter stream(symbols_of(config));
    const auto largest = static_cast<std::uint32_t>(config.colour_format().max);
    const auto word = [&](int pixel) { return pixel * (1 << config.position_frac_bits); };
    stream.begin_frame(2 * config.tile_width, config.tile_height, 2);
    load_flat_footprint(stream, config);
    stream.load_table(2, 0, 0, 0, std::vector<std::uint32_t>(static_cast<std::size_t>(config.opacity_segments) + 1, 1));
    // A box without a pixel of the tile is hidden.
    stream.begin_tile(1, 0, 0, 0, config.tile_width, config.tile_height);
    stream.begin_sheet(0);
    stream.cull_block(0, -4, -4, 2, 2, 3);
    stream.end_sheet();
    stream.end_tile();
    stream.begin_tile(1, 1, config.tile_width, 0, config.tile_width, config.tile_height);
    stream.begin_sheet(0);
    for (int i = 1; i < 4; ++i)
      stream.splat(0, word(config.tile_width / 8 * i), word(config.tile_height / 8 * i), {largest, 0, 0, largest});
    stream.end_sheet();
    stream.end_tile();
    stream.end_frame();
    const auto beats = to_beats(stream.bytes());
    const std::size_t first = first_tile_beat(stream.bytes());
    const auto tables = frame_tables(config, std::span(beats).first(first));
    ASSERT_TRUE(tables);
    Tally tally;
    if (tables->plan.narrow)
      compare<std::uint16_t>(config, *tables, beats, first, tally);
    else
      compare<std::uint32_t>(config, *tables, beats, first, tally);
    EXPECT_EQ(tally.mismatches, 0u) << name;
    EXPECT_EQ(tally.redone, 0u) << name;
    all += tally;
  }
  std::printf("[figure] tiles behind one with a set left out, or that one = %llu, different %llu (limit 0)\n",
              static_cast<unsigned long long>(all.tiles), static_cast<unsigned long long>(all.mismatches));
  EXPECT_EQ(all.tiles, 6u);
}

}  // namespace
}  // namespace fastsplat::test
