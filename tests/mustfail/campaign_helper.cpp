#include "tests/mustfail/campaign_helper.hpp"

#include <gtest/gtest.h>

#include "base/error.hpp"
#include "cmodel/model.hpp"
#include "testbench/check/scoreboard.hpp"
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

/// Splats of one window each on two neighbouring centres, in sheets that follow each other without a stall: every
/// sheet's buffer is free again before it is wanted, so the words of sheet s+1 come three cycles after those of sheet
/// s.
std::vector<cmodel::Beat> hot_spot(const cmodel::Config& config, std::uint64_t seed, int dimming = 4) {
  const oracle::Symbols c = symbols_of(config);
  Random random(seed);
  StreamWriter w(c);
  const auto columns = static_cast<std::size_t>(c.P);
  std::vector<std::uint32_t> rlut(static_cast<std::size_t>(c.k) * columns), radial(static_cast<std::size_t>(c.N)),
      factor(static_cast<std::size_t>(c.G) + 1);
  for (auto& word : rlut) word = static_cast<std::uint32_t>(random.between(0, (std::int64_t{c.N} << c.g) / 4));
  for (auto& word : radial) word = static_cast<std::uint32_t>(random.between(1, (1 << (c.wf - dimming)) - 1));
  for (std::size_t j = 0; j < factor.size(); ++j)
    factor[j] = static_cast<std::uint32_t>((std::size_t{1} << c.of) * factor.size() / (factor.size() + j));
  w.begin_frame(c.W, c.H, 1);
  w.load_table(0, 0, static_cast<std::uint32_t>(c.P * c.k / 2), 0, rlut);
  w.load_table(1, 0, 0, 0, radial);
  w.load_table(2, 0, 0, 0, factor);
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

std::vector<cmodel::Beat> random_beats(const cmodel::Config& config, std::uint64_t seed) {
  Random random(seed);
  return to_beats(random_stream(symbols_of(config), random, 300).bytes);
}

std::vector<Run> runs_of(const cmodel::Config& config, Stimulus stimulus) {
  switch (stimulus) {
    case Stimulus::Random:
      return {{random_beats(config, 1), "burst-16", "random-50", 1},
              {random_beats(config, 2), "always", "every-3", 2},
              {random_beats(config, 3), "random-50", "never-40", 3},
              {random_beats(config, 4), "always", "always", 4}};
    case Stimulus::HotSpot:
      return {{hot_spot(config, 1), "always", "always", 1}, {hot_spot(config, 2), "random-50", "always", 2}};
    case Stimulus::Bright:
      return {{hot_spot(config, 4, 0), "always", "always", 4}};
    case Stimulus::WarmReset: {
      auto beats = hot_spot(config, 3);
      const std::size_t tables = beats.size() / 2;
      return {{std::move(beats), "always", "always", 3, tables}};
    }
  }
  return {};
}

struct NoPixels final : cmodel::PixelSink {
  void on_tile(cmodel::TilePixels&&) override {}
};

/// Passes taps on once a reset is over.
struct Gate final : cmodel::TapSink {
  explicit Gate(cmodel::TapSink& next) : sink(next) {}
  cmodel::TapSink& sink;
  bool open = true;
  void on_tap(const cmodel::TapRecord& record) override {
    if (open) sink.on_tap(record);
  }
};

Detector detector_of(cmodel::Tap tap) { return static_cast<Detector>(static_cast<int>(tap)); }

Outcome run_one(const cmodel::Config& config, const Run& run, Stimulus stimulus, const MakeDevice& make) {
  testbench::Scoreboard board;
  Outcome outcome;
  const auto judge = [&] {
    outcome.comparisons = board.comparisons();
    if (!board.first()) return false;
    const auto& first = *board.first();
    outcome.caught = Caught{detector_of((first.model ? first.model : first.rtl)->tap), describe(config, first)};
    return true;
  };
  NoPixels pixels;
  cmodel::Model model(config, cmodel::StreamScope::Whole, pixels, &board.model());
  model.consume(run.beats);
  model.finish();

  Gate gate(board.rtl());
  try {
    const auto device =
        make(config, pixels,
             {.input = testbench::Pattern(run.input, run.seed),
              .output = testbench::Pattern(run.output, run.seed + 1),
              .fill = stimulus == Stimulus::WarmReset ? testbench::ResetFill::Zero : testbench::ResetFill::Random,
              .seed = run.seed,
              .timeout = kTimeout,
              .taps = &gate,
              .wave = {}});
    if (run.reset_after != 0) {
      gate.open = false;
      device->consume(std::span(run.beats).first(run.reset_after));
      device->warm_reset();
      gate.open = true;
    }
    for (const auto& beat : run.beats) {
      device->consume({&beat, 1});
      if (judge()) return outcome;
    }
    device->finish();
    board.finish();
    if (judge()) return outcome;
    const auto& counters = device->counters();
    if (!(counters == model.counters())) {
      std::string report = "counters differ:";
      std::vector<std::uint64_t> expected;
      model.counters().for_each([&](const char*, std::uint64_t value, const char*) { expected.push_back(value); });
      std::size_t n = 0;
      counters.for_each([&](const char* name, std::uint64_t value, const char*) {
        if (value != expected[n])
          report += std::string(" ") + name + " " + std::to_string(expected[n]) + ", RTL " + std::to_string(value);
        ++n;
      });
      outcome.caught = Caught{Detector::Counters, report};
    }
  } catch (const UserError& error) {
    const std::string text = error.what();
    if (text.find(": assertion ") != std::string::npos) {
      outcome.caught = Caught{Detector::Assertion, text};
      return outcome;
    }
    if (judge()) return outcome;
    outcome.caught = Caught{text.find("hangs") != std::string::npos ? Detector::Timeout : Detector::Other, text};
  }
  return outcome;
}

}  // namespace

const char* to_string(Detector detector) {
  constexpr const char* kNames[] = {"tap snap", "tap footprint", "tap sheet", "tap composite", "tap pixel",
                                    "counters", "timeout",       "assertion", "other"};
  return kNames[static_cast<int>(detector)];
}

const char* to_string(Stimulus stimulus) {
  constexpr const char* kNames[] = {"random", "hot spot", "bright", "warm reset"};
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
