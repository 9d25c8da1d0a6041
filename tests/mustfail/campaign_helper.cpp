// SPDX-License-Identifier: Apache-2.0
#include "tests/mustfail/campaign_helper.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "testbench/check/verify.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"

namespace fastsplat::test {
namespace {

/// Longer than any wait of a healthy device: a full tile at one beat in ten cycles.
constexpr std::uint64_t kTimeout = 20000;

struct Run {
  std::vector<cmodel::Beat> beats;
  const char* input = "always";
  const char* output = "always";
  std::uint64_t seed = 1;
  std::size_t reset_after = 0;  ///< beats before a warm reset; 0: none
};

/// Footprints of one window, all of it inside the rim; weights that dimming makes smaller.
struct Tables {
  Tables(const oracle::Symbols& c, Random& random, int dimming)
      : rho(static_cast<std::uint32_t>(c.P * c.k / 2)),
        rlut(static_cast<std::size_t>(c.k) * static_cast<std::size_t>(c.P)),
        radial(static_cast<std::size_t>(c.radial_words())),
        factor(static_cast<std::size_t>(c.G) + 1) {
    for (auto& word : rlut) word = static_cast<std::uint32_t>(random.between(0, (std::int64_t{c.N} << c.g) / 4));
    for (auto& word : radial) word = static_cast<std::uint32_t>(random.between(1, (1 << (c.wf - dimming)) - 1));
    for (std::size_t j = 0; j < factor.size(); ++j)
      factor[j] = static_cast<std::uint32_t>((std::size_t{1} << c.of) * factor.size() / (factor.size() + j));
  }
  void write(StreamWriter& w) const {
    w.load_table(0, 0, rho, 0, rlut);
    w.load_table(1, 0, 0, 0, radial);
    w.load_table(2, 0, 0, 0, factor);
  }
  std::uint32_t rho;
  std::vector<std::uint32_t> rlut, radial, factor;
};

/// Splats of one window each on two neighbouring centres, in successive sheets without a stall. Every sheet's buffer is
/// free before it is needed, so the words of sheet s+1 come three cycles after the words of sheet s.
std::vector<cmodel::Beat> hot_spot(const cmodel::Config& config, std::uint64_t seed, int dimming = 4) {
  const oracle::Symbols c = symbols_of(config);
  Random random(seed);
  StreamWriter w(c);
  const Tables tables(c, random, dimming);
  w.begin_frame(c.W, c.H, 1);
  tables.write(w);
  w.begin_tile(0, 0, 0, 0, c.W, c.H);
  const std::int32_t one = 1 << c.pf;
  for (std::uint32_t sheet = 0; sheet < 40; ++sheet) {
    w.begin_sheet(sheet);
    // Longer than the walk of a sheet of few blocks, so that no sheet waits.
    for (int i = 0; i < 40; ++i) {
      std::array<std::uint32_t, 4> colour{};
      for (auto& channel : colour)
        channel = static_cast<std::uint32_t>(random.between(1, (1 << (c.cf - dimming / 2)) - 1));
      const std::int32_t away = random.once_in(3) ? 2 * c.P * one : 0;
      // The first and the last of a sheet lie on the same words.
      w.splat(0, 5 * one + (i == 0 || i == 39 ? 0 : away), 7 * one, colour);
    }
    w.end_sheet();
  }
  w.end_tile();
  w.end_frame();
  return to_beats(w.bytes());
}

/// Tiles of few splats, so that no pixel terminates early. Windows lie on one place, beside it and far away, after 1 to
/// 6 cycles, and across the tile's left and upper edge. They are composited sample by sample if the device can, else by
/// sheets.
std::vector<cmodel::Beat> hot_samples(const cmodel::Config& config, std::uint64_t seed) {
  const oracle::Symbols c = symbols_of(config);
  constexpr std::uint32_t kTiles = 40;
  Random random(seed);
  StreamWriter w(c);
  const Tables tables(c, random, 4);
  w.begin_frame(c.W, c.H * static_cast<int>(kTiles), kTiles);
  tables.write(w);
  const std::int32_t one = 1 << c.pf;
  for (std::uint32_t tile = 0; tile < kTiles; ++tile) {
    w.begin_tile(c.every_sample != 0 ? 4 : 0, tile, 0, c.H * static_cast<int>(tile), c.W, c.H);
    w.begin_sheet(0);
    std::int64_t next = 0;
    for (int i = 0; i < 40; ++i) {
      std::array<std::uint32_t, 4> colour{};
      for (auto& channel : colour) channel = static_cast<std::uint32_t>(random.between(1, (1 << (c.cf - 2)) - 1));
      const bool hot = i == next;
      if (hot) next = i + random.between(1, 6);
      const bool corner = tile % 2 == 0;
      const std::int32_t at = corner ? 0 : 5 * one;
      const std::int32_t beside = one * static_cast<std::int32_t>(random.between(-c.P, c.P));
      const std::int32_t away = one * (corner ? c.W - c.P : 2 * c.P);
      const std::int32_t x = !hot ? at + away : random.once_in(2) ? at : at + beside;
      w.splat(0, x, at + (random.once_in(4) ? one : 0), colour);
    }
    w.end_sheet();
    w.end_tile();
  }
  w.end_frame();
  return to_beats(w.bytes());
}

/// Tiles in which sheets make whole blocks opaque at once, three of four one block wide. A waiting table begins in the
/// cycle after the one before it, in the block that is being put. Groups without splats, and splats, are tested against
/// the frozen blocks. Devices without culling get the splats alone.
std::vector<cmodel::Beat> early_freeze(const cmodel::Config& config, std::uint64_t seed) {
  const oracle::Symbols c = symbols_of(config);
  constexpr std::uint32_t kTiles = 120;
  Random random(seed);
  StreamWriter w(c);
  Tables tables(c, random, 0);
  // One splat is opaque: FACTOR multiplies a depth.
  for (auto& word : tables.factor) word = 1U << c.of;
  for (auto& word : tables.radial) word = (1U << c.wf) - 1;
  w.begin_frame(c.W, c.H * static_cast<int>(kTiles), kTiles);
  tables.write(w);
  const std::int32_t one = 1 << c.pf;
  for (std::uint32_t tile = 0; tile < kTiles; ++tile) {
    const int width = tile % 4 != 0 ? c.P : c.W, blocks_x = width / c.P, blocks_y = c.H / c.P;
    w.begin_tile(0, tile, 0, c.H * static_cast<int>(tile), width, c.H);
    for (std::uint32_t sheet = 0; sheet < 8; ++sheet) {
      w.begin_sheet(sheet);
      // The first freezes. The second, long enough for the first's table to be whole, freezes the last row of blocks
      // alone. Behind it comes a short one, whose table waits and begins there; the later ones are tested.
      const std::int64_t splats = sheet == 0   ? random.between(1, 2)
                                  : sheet == 1 ? random.between(1, 24)
                                  : sheet == 2 ? random.between(0, 1)
                                               : random.between(0, 4);
      const std::int64_t row =
          sheet == 1 || sheet > 3 ? blocks_y - 1 : random.between(0, std::int64_t{std::max(blocks_y - 2, 0)});
      const std::int32_t up = random.once_in(4) ? one : 0;  // else its window is a block
      for (std::int64_t i = 0; i < splats; ++i) {
        const auto bx = static_cast<std::int32_t>(random.between(0, blocks_x - 1)), by = static_cast<std::int32_t>(row);
        const auto rows = static_cast<int>(random.once_in(2) ? 1 : random.between(1, 2 * c.P));
        const auto from = static_cast<std::int32_t>(random.once_in(2) ? c.H - c.P : random.between(0, c.H - 1));
        if (c.cull != "off" && random.once_in(2)) w.cull_block(w.next_tag(), 0, from, width, rows, 0);
        w.splat(0, (bx * c.P + c.P / 2) * one - one / 2, (by * c.P + c.P / 2) * one - one / 2 + up,
                {1, 2, 3, (1U << c.cf) - 1});
      }
      w.end_sheet();
    }
    w.end_tile();
  }
  w.end_frame();
  return to_beats(w.bytes());
}

std::vector<cmodel::Beat> random_beats(const cmodel::Config& config, std::uint64_t seed) {
  Random random(seed);
  return to_beats(random_stream(symbols_of(config), random, 300).bytes);
}

std::vector<Run> runs_of(const cmodel::Config& config, Stimulus stimulus) {
  switch (stimulus) {
    case Stimulus::Random:
      return {{random_beats(config, 1), "burst-16", "random-50", 1},
              {random_beats(config, 2), "always", "every-3", 2},
              {random_beats(config, 3), "random-50", "alternate-40", 3},
              {random_beats(config, 4), "always", "always", 4}};
    case Stimulus::HotSpot:
      return {{hot_spot(config, 1), "always", "always", 1}, {hot_spot(config, 2), "random-50", "always", 2}};
    case Stimulus::Bright:
      return {{hot_spot(config, 4, 0), "always", "always", 4}};
    case Stimulus::HotSamples:
      return {{hot_samples(config, 5), "always", "always", 5}, {hot_samples(config, 6), "random-50", "always", 6}};
    case Stimulus::EarlyFreeze:
      return {{early_freeze(config, 7), "always", "always", 7},
              {early_freeze(config, 8), "burst-16", "always", 8},
              {early_freeze(config, 9), "random-50", "always", 9},
              {early_freeze(config, 10), "always", "always", 10}};
    case Stimulus::WarmReset: {
      auto beats = hot_spot(config, 3);
      const std::size_t tables = beats.size() / 2;
      return {{std::move(beats), "always", "always", 3, tables}};
    }
  }
  return {};
}

static_assert(static_cast<int>(Detector::Verdicts) == static_cast<int>(testbench::Detector::Verdicts));

Outcome run_one(const cmodel::Config& config, const Run& run, Stimulus stimulus, const MakeDevice& make) {
  testbench::VerifyOptions options;
  options.config = config;
  options.ready = run.output;
  options.input = run.input;
  options.fill = stimulus == Stimulus::WarmReset ? testbench::ResetFill::Zero : testbench::ResetFill::Random;
  options.seed = run.seed;
  options.reset_after = run.reset_after;
  options.timeout = kTimeout;
  options.stop_after = 1;
  options.device = [&](cmodel::PixelSink& pixels, const testbench::RtlOptions& rtl) {
    return make(config, pixels, rtl);
  };
  const auto result = testbench::verify(testbench::source_of(run.beats), options);
  Outcome outcome{.caught = std::nullopt, .comparisons = result.check.comparisons};
  if (result.error.find(": assertion ") != std::string::npos) {
    outcome.caught = Caught{Detector::Assertion, result.error};
  } else if (result.check.detector) {
    outcome.caught = Caught{static_cast<Detector>(*result.check.detector),
                            result.check.first ? describe(config, *result.check.first) : ""};
    for (const auto& difference : result.check.differences) outcome.caught->report += difference + "; ";
  } else if (result.verdict != testbench::Verdict::Pass) {
    outcome.caught = Caught{result.error.find("hangs") != std::string::npos ? Detector::Timeout : Detector::Other,
                            result.error + to_string(result.verdict)};
  }
  return outcome;
}

}  // namespace

const char* to_string(Detector detector) {
  switch (detector) {
    case Detector::Timeout:
      return "timeout";
    case Detector::Assertion:
      return "assertion";
    case Detector::Other:
      return "other";
    default:
      return to_string(static_cast<testbench::Detector>(detector));
  }
}

const char* to_string(Stimulus stimulus) {
  constexpr const char* kNames[] = {"random", "hot spot", "bright", "hot samples", "early freeze", "warm reset"};
  return kNames[static_cast<int>(stimulus)];
}

Outcome run(const cmodel::Config& config, Stimulus stimulus, const MakeDevice& make) {
  Outcome total;
  for (const Run& one : runs_of(config, stimulus)) {
    Outcome outcome = run_one(config, one, stimulus, make);
    total.comparisons += outcome.comparisons;
    total.caught = std::move(outcome.caught);
    if (total.caught) break;
  }
  return total;
}

}  // namespace fastsplat::test
