// SPDX-License-Identifier: Apache-2.0
// The search with formulas for verdicts: for any formula, its result cannot be lowered.
#include "analysis/errors/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "analysis/errors/cost.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Config;

/// Bits of a knob: its own, or the logarithm of a power of two.
double bits(const Config& config, std::size_t knob) {
  const int value = config.*knobs()[knob].member;
  return cmodel::find_key(knobs()[knob].key)->power_of_two ? std::log2(value) : value;
}

/// Noises that add: weight_k 4^-bits_k, and the share of early termination.
struct Noises {
  std::vector<double> weights;
  double freeze = 0.0, allowed = 1.0;
  Verdict operator()(const Config& config) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < freeze_knob(); ++k) sum += weights[k] * std::pow(4.0, -bits(config, k));
    const double level = std::ldexp(static_cast<double>(config.freeze_below), -config.composite_frac_bits);
    sum += freeze * level * level;
    const double excess = std::sqrt(sum) / allowed;
    return {excess <= 1.0, excess};
  }
};

double price(const Config& config) { return cost(config).total(); }

/// Independent of the search: every knob one step down, evaluated again.
int lowerable(const Config& best, const Evaluate& evaluate) {
  int count = 0;
  for (std::size_t k = 0; k < freeze_knob(); ++k) {
    Steps lower(knobs().size(), 0);
    lower[k] = -1;
    const auto config = turned(best, lower);
    count += config && price(*config) <= price(best) && evaluate(*config).meets ? 1 : 0;
  }
  return count;
}

/// The same for pairs: one knob down by one or two steps, another up by one, cheaper and good enough.
int exchangeable(const Config& best, const Evaluate& evaluate, int& tried) {
  int count = 0;
  for (std::size_t down = 0; down < freeze_knob(); ++down) {
    for (std::size_t up = 0; up < freeze_knob(); ++up) {
      for (const int depth : {1, 2}) {
        if (up == down) continue;
        Steps both(knobs().size(), 0);
        both[down] = -depth, both[up] = 1;
        const auto config = turned(best, both);
        if (!config || price(*config) >= price(best)) continue;
        ++tried;
        count += evaluate(*config).meets ? 1 : 0;
      }
    }
  }
  return count;
}

/// The lowest value of a knob with which the start, otherwise unchanged, still meets the target.
std::string lowest_alone(const Config& start, std::size_t knob, const Evaluate& evaluate) {
  Steps steps(knobs().size(), 0);
  std::string text;
  for (auto config = std::optional(start); config && evaluate(*config).meets; config = turned(start, steps)) {
    text = cmodel::text_of(*config, *cmodel::find_key(knobs()[knob].key));
    --steps[knob];
  }
  return text;
}

TEST(Search, EndsWhereNoKeyCanBeLoweredAndNoPairExchanged) {
  test::Random random(4);  // its formula 14 needs a knob two steps down
  const Config base = test::named_config("base");
  int most = 0, met = 0, pairs = 0, dearer = 0;
  double dearest = 0.0;
  for (int n = 0; n < 40; ++n) {
    Noises noises{std::vector<double>(freeze_knob(), 0.0), 0.0, 1.0};
    for (double& weight : noises.weights) weight = std::ldexp(1.0, static_cast<int>(random.between(-4, 18)));
    noises.allowed = std::ldexp(1.0, static_cast<int>(random.between(-4, 4)));
    const SearchOutcome out = Search(base, noises, price).run();
    if (!out.met) continue;
    ++met;
    EXPECT_TRUE(noises(out.best).meets);
    EXPECT_EQ(lowerable(out.best, noises), 0) << "formula " << n;
    EXPECT_EQ(exchangeable(out.best, noises, pairs), 0) << "formula " << n;
    for (std::size_t k = 0; k < knobs().size(); ++k) {
      Steps lower(knobs().size(), 0);
      lower[k] = -1;
      const auto config = turned(out.best, lower);
      EXPECT_EQ(out.keys[k].dearer, config && price(*config) > price(out.best)) << knobs()[k].key;
      EXPECT_EQ(out.keys[k].alone, lowest_alone(out.start, k, noises)) << knobs()[k].key;
      dearer += out.keys[k].dearer ? 1 : 0;
    }
    most = std::max(most, out.evaluated);
    if (noises(base).meets) {
      EXPECT_LE(price(out.best), price(base));
      dearest = std::max(dearest, price(out.best) / price(base));
    }
    const SearchOutcome again = Search(base, noises, price).run();
    EXPECT_EQ(again.best, out.best);
    EXPECT_EQ(again.evaluated, out.evaluated);
  }
  std::printf(
      "[figure] searches that met their target = %d, most configurations evaluated = %d, dearest = %.3f of base, pairs "
      "tried on them = %d, keys whose step down costs more = %d (limit > 0)\n",
      met, most, dearest, pairs, dearer);
  EXPECT_GT(dearer, 0);
  EXPECT_GE(met, 20);
  EXPECT_GT(pairs, 1000);
  // Halving 14 keys, rounds of 14, and pairs at the end: more frames than this take too long.
  EXPECT_LE(most, 500);
}

/// If all noises are known, the best of all: with few keys, every combination is evaluated.
TEST(Search, IsNearTheBestOfAllWhereThatCanBeKnown) {
  const Config base = test::named_config("base");
  double worst = 0.0;
  for (const double scale : {1.0, 0.2, 0.03}) {
    Noises noises{std::vector<double>(freeze_knob(), 0.0), 0.0, scale};
    const std::vector<std::size_t> free{4, 5, 9, 12};  // weights, colours, sheets, compositing
    for (const std::size_t k : free) noises.weights[k] = 1000.0;
    // The others fall off a cliff one step down: they stay.
    const auto evaluate = [&](const Config& config) {
      for (std::size_t k = 0; k < freeze_knob(); ++k) {
        if (std::ranges::find(free, k) == free.end() && bits(config, k) < bits(base, k)) return Verdict{false, 100.0};
      }
      return noises(config);
    };
    const SearchOutcome out = Search(base, evaluate, price).run();
    ASSERT_TRUE(out.met);
    double best = price(base);
    Steps steps(knobs().size(), 0);
    for (int a = -12; a <= 0; ++a) {
      for (int b = -12; b <= 0; ++b) {
        for (int c = -12; c <= 2; ++c) {
          for (int d = -12; d <= 2; ++d) {
            steps[4] = a, steps[5] = b, steps[9] = c, steps[12] = d;
            const auto config = turned(base, steps);
            if (config && evaluate(*config).meets) best = std::min(best, price(*config));
          }
        }
      }
    }
    std::printf("[figure] allowed error %g: %.4f times the cost of the best of 38,025, %d evaluated\n", scale,
                price(out.best) / best, out.evaluated);
    worst = std::max(worst, price(out.best) / best);
  }
  // A local optimum under exchanges of two keys; a step of one key is worth about 4 % here.
  EXPECT_LE(worst, 1.04);
}

TEST(Search, BeginsFinerWhereTheStartFails) {
  const Config tiny = test::named_config("tiny");
  Noises noises{std::vector<double>(freeze_knob(), 4.0), 0.0, 1.0};
  noises.allowed = 0.5 * noises(tiny).excess;
  const SearchOutcome out = Search(tiny, noises, price).run();
  ASSERT_TRUE(out.met);
  EXPECT_FALSE(noises(tiny).meets);
  EXPECT_NE(out.start, tiny);
  EXPECT_TRUE(noises(out.start).meets);
  EXPECT_EQ(lowerable(out.best, noises), 0);
  EXPECT_EQ(out.keys.size(), knobs().size());
}

TEST(Search, TurnsFreezingOnlyWhereNothingElseHelps) {
  const Config base = test::named_config("base");
  const double level = std::ldexp(static_cast<double>(base.freeze_below), -base.composite_frac_bits);
  Noises harmless{std::vector<double>(freeze_knob(), 1.0), 0.0, 0.01};
  const SearchOutcome kept = Search(base, harmless, price).run();
  ASSERT_TRUE(kept.met);
  EXPECT_GE(std::ldexp(static_cast<double>(kept.best.freeze_below), -kept.best.composite_frac_bits), level);
  Noises ruled = harmless;
  ruled.freeze = 4.0 * ruled.allowed * ruled.allowed / (level * level);  // freezing alone makes twice the allowed error
  const SearchOutcome finer = Search(base, ruled, price).run();
  ASSERT_TRUE(finer.met);
  EXPECT_LT(std::ldexp(static_cast<double>(finer.best.freeze_below), -finer.best.composite_frac_bits), level);
}

TEST(Search, SaysSoWhereNothingMeetsTheTarget) {
  const Config base = test::named_config("base");
  int asked = 0;
  const auto stubborn = [&](const Config& config) {
    ++asked;
    return Verdict{false, config.rlut_columns > base.rlut_columns ? 1.5 : 3.0};
  };
  const SearchOutcome out = Search(base, stubborn, price).run();
  EXPECT_FALSE(out.met);
  EXPECT_EQ(out.verdict.excess, 3.0);
  ASSERT_TRUE(out.geometry) << "twice the columns were better";
  EXPECT_EQ(out.geometry->rlut_columns, 2 * base.rlut_columns);
  std::printf("[figure] asked before giving up = %d (limit 25)\n", asked);
  EXPECT_LE(asked, 25);
  // Finer words are worse, more columns no better: the start is the nearest, and nothing would help.
  const auto best_as_it_is = [&](const Config& config) {
    return Verdict{false, config == base || config.rlut_columns > base.rlut_columns ? 3.0 : 4.0};
  };
  const SearchOutcome kept = Search(base, best_as_it_is, price).run();
  EXPECT_EQ(kept.best, base);
  EXPECT_EQ(kept.verdict.excess, 3.0);
  EXPECT_FALSE(kept.geometry);
}

TEST(Knobs, StayWithinTheLimitsAndTakeCompanionsAlong) {
  const Config base = test::named_config("base");
  Steps steps(knobs().size(), 0);
  steps[0] = -2;
  ASSERT_TRUE(turned(base, steps));
  EXPECT_EQ(turned(base, steps)->phases, 16);
  EXPECT_EQ(turned(base, steps)->position_frac_bits, 4);
  steps.assign(knobs().size(), 0);
  steps[12] = -3;  // composite.frac_bits: the level of freezing stays
  EXPECT_EQ(turned(base, steps)->composite_frac_bits, 13);
  EXPECT_EQ(turned(base, steps)->freeze_below, 8);
  steps[12] = -8;
  EXPECT_EQ(turned(base, steps)->freeze_below, 1) << "the least that is not nothing";
  steps.assign(knobs().size(), 0);
  steps[freeze_knob()] = 3;
  EXPECT_EQ(turned(base, steps)->freeze_below, 8);
  steps[freeze_knob()] = -1;
  EXPECT_FALSE(turned(base, steps)) << "freezing more saves no bit";
  steps.assign(knobs().size(), 0);
  steps[0] = -6;
  EXPECT_FALSE(turned(base, steps)) << "one phase cannot be built in RTL";
  for (std::size_t k = 0; k < knobs().size(); ++k) EXPECT_NE(cmodel::find_key(knobs()[k].key), nullptr);
}

TEST(Cost, CountsWhatTheRtlHas) {
  Config c = test::named_config("base");
  // By hand for base: P = 8, W = H = 128, k = 64, 128 columns, nl + g + 1 = 17. Tables: N = 1024 of 15 bits, G = 256 of
  // twice 17. Sheets and picture have 18 bits.
  EXPECT_EQ(cost(c).storage_bits, 2 * 128 * 64 * 17 + 64 * 1024 * 15 + 64 * 256 * 34 + 2 * 16384 * 72 + 16384 * 72);
  EXPECT_EQ(cost(c).multiplier_bits, 64 * (4 * 16 * 15 + 17 * 10 + 4 * 18 * 17 + 4 * 17 * 17));
  EXPECT_EQ(cost(c).adder_bits, 2 * 18 + 64 * (17 + 72) + 64 * (34 + 68) + 8 * 4 * 17);
  Config shaped = c;
  shaped.ellipse_frac_bits = 11;
  EXPECT_EQ(cost(shaped).adder_bits - cost(c).adder_bits, (10 + 6 + 6 + 10 + 11) * (8 + 14 * 8 + 3 * 64));
  EXPECT_EQ(cost(shaped).multiplier_bits - cost(c).multiplier_bits, 92 * 17 + 17 * 43 + 17 * 41);
  EXPECT_EQ(cost(shaped).storage_bits, cost(c).storage_bits);
  // No key of a search makes a device cheaper by being finer.
  for (std::size_t k = 0; k < freeze_knob(); ++k) {
    Steps finer(knobs().size(), 0);
    finer[k] = 1;
    if (const auto config = turned(c, finer)) {
      EXPECT_GE(price(*config), price(c)) << knobs()[k].key;
    }
  }
}

}  // namespace
}  // namespace fastsplat::analysis
