// SPDX-License-Identifier: Apache-2.0
// Derived ranges from both sides: no value of any stream lies outside, and streams that are written for it reach both
// ends of every range.
#include "analysis/errors/derived_ranges.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "cmodel/model.hpp"
#include "cmodel/numbers/window_geometry.hpp"
#include "tests/cmodel/compare_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Config;
using cmodel::IndexKind;
using cmodel::Site;
using Words = std::vector<std::uint32_t>;

/// Runs the model on a whole stream and adds what its sites see.
void watch(const Config& config, const std::vector<std::uint8_t>& bytes, cmodel::Ranges& ranges) {
  test::Collector nowhere;
  cmodel::Ranges seen;
  cmodel::Model model(config, cmodel::StreamScope::Whole, nowhere, nullptr, &seen);
  model.consume(test::to_beats(bytes));
  model.finish();
  ranges += seen;
}

struct Witness {
  bool radial_rises = false;  ///< the radial table's first entry is 0, the others the largest; or the other way round
  bool last_factor = false;   ///< the factor table falls from 1 to 0 in its last segment; or is 1 throughout
  bool off_centre = false;    ///< q lies just below the second radial entry; or is 0
};

/// Words of a set of rho 1: the largest weight at every pixel, or for off_centre the largest rest below entry 1.
Words set_words(const Config& c, const Witness& witness, std::uint32_t columns) {
  const std::uint32_t rest = witness.off_centre ? (1U << c.rlut_guard_bits) - 1 : 0;
  const auto shift = static_cast<std::uint32_t>(c.rlut_guard_bits), phases = static_cast<std::uint32_t>(c.phases);
  switch (c.index()) {
    case IndexKind::Linear:
      return {0, 0};
    case IndexKind::Squared:
      return {rest, shift};
    case IndexKind::SquaredElliptic:
      return {rest, 0, rest, shift};
    case IndexKind::Blit2d: {
      const std::uint32_t n = c.index_symmetry == 0 ? phases : phases == 1 ? 1 : phases / 2 + 1;
      const std::uint32_t pairs = c.index_symmetry == 0 ? n * n : n * (n + 1) / 2;
      return Words(std::size_t{pairs} * columns * columns, static_cast<std::uint32_t>(c.weight_format().max));
    }
    case IndexKind::Separable:
      return Words(std::size_t{phases} * columns,
                   witness.off_centre ? 0 : static_cast<std::uint32_t>(c.axis_weight_format().max));
    case IndexKind::Rlut:
      break;
  }
  Words words;
  for (std::uint32_t m = 0; m < phases; ++m)
    for (std::uint32_t i = 0; i < columns; ++i) words.push_back((m + i) % 2 * rest);
  return words;
}

/// A stream that drives every sum to its largest word and every table to its ends, in modes 0 to 2.
std::vector<std::uint8_t> witness_stream(const Config& c, const Witness& witness) {
  test::StreamWriter w(test::symbols_of(c));
  const bool plain = !witness.radial_rises && !witness.last_factor && !witness.off_centre;
  w.begin_frame(c.tile_width, c.tile_height, plain ? 6 : 1);
  const std::uint32_t columns = cmodel::window_geometry(c, 1).padded;
  w.load_table(0, 0, 1, 0, set_words(c, witness, columns));
  Words radial(static_cast<std::size_t>(c.radial_words()), static_cast<std::uint32_t>(c.weight_format().max));
  if (witness.radial_rises) radial.front() = 0;
  if (!witness.radial_rises && witness.off_centre) radial[1] = 0;
  w.load_table(1, 0, 0, 0, radial);
  Words factor(static_cast<std::size_t>(c.opacity_segments) + 1, static_cast<std::uint32_t>(c.factor_format().max));
  if (witness.last_factor) factor.back() = 0;
  w.load_table(2, 0, 0, 0, factor);

  const int unit = 1 << (c.position_frac_bits - c.grid_bits());  // a step of the grid
  const auto most = static_cast<std::uint32_t>(c.colour_format().max);
  const auto first = static_cast<std::int32_t>(c.position_format().min), last = -1 - first;
  // A product is above a quarter of 2^ci, and the largest word of a sheet below 2^si.
  const int splats = std::max(1, (8 << c.sheet_int_bits) >> c.colour_int_bits) + 1;
  // In a clear tile each sheet adds 2^ci or 2^si to colours below 2^(1+ci).
  const int sheets = 3 + std::max(2, 2 << std::max(0, c.colour_int_bits - c.sheet_int_bits));
  std::uint32_t tile = 0;
  for (const int mode : {0, 1, 2}) {  // of other tables one tile is enough
    for (const std::uint32_t tau : {most, 0U}) {
      if (tile == 1 && !plain) break;
      const oracle::Ellipse everywhere{.v = {most, most, 0, tau}};
      w.begin_tile(mode, tile++, 0, 0, std::min(c.tile_width, 2 * c.lanes), std::min(c.tile_height, 2 * c.lanes));
      for (int sheet = 0; sheet < sheets; ++sheet) {
        w.begin_sheet(static_cast<std::uint32_t>(sheet));
        for (int n = 0; n < splats; ++n) w.splat(0, witness.off_centre ? -unit : 0, 0, {most, most, 0, tau});
        w.splat(0, first, last, {0, 0, 0, 0});
        // Ellipses read the radial table, whatever the index kind: here its first entry everywhere.
        if (c.has_ellipses()) w.ellipse(everywhere);
        w.end_sheet();
      }
      w.end_tile();
    }
  }
  w.end_frame();
  return w.bytes();
}

cmodel::Ranges witnessed(const Config& config) {
  cmodel::Ranges ranges;
  watch(config, witness_stream(config, {}), ranges);
  watch(config, witness_stream(config, {.last_factor = true}), ranges);
  watch(config, witness_stream(config, {.off_centre = true}), ranges);
  watch(config, witness_stream(config, {.radial_rises = true, .off_centre = true}), ranges);
  return ranges;
}

/// Configurations of all index kinds, with ellipses, densities, patterns and culling.
Config any_config(test::Random& random, int n) {
  const auto kind = static_cast<IndexKind>(n % 6);
  const bool ellipses = n / 6 % 3 == 1 && kind != IndexKind::Linear, densities = n / 6 % 3 == 2;
  Config config = ellipses    ? test::random_ellipse_config(random, kind)
                  : densities ? test::random_density_config(random, kind)
                              : test::random_config(random, kind);
  if (n % 4 == 0 && !densities) config.cull_map = static_cast<int>(random.between(1, 2));
  if (n % 5 == 0) config.pattern_node_bits = 2;
  EXPECT_FALSE(cmodel::first_violation(config));
  return config;
}

struct Totals {
  std::uint64_t values = 0, sites = 0, unreachable = 0, saturated = 0;
};
/// Expects every value seen inside its derived range, and saturation only where it is derived.
void contain(const Config& config, const cmodel::Ranges& seen, Totals& totals) {
  std::map<Site, DerivedRange> derived;
  for (const DerivedRange& range : derived_ranges(config)) derived[range.site] = range;
  for (std::size_t i = 0; i < cmodel::kSiteCount; ++i) {
    const cmodel::Range& range = seen.at(static_cast<Site>(i));
    if (range.count == 0) continue;
    const char* name = cmodel::kSiteFacts[i].name;
    ASSERT_TRUE(derived.contains(static_cast<Site>(i))) << name;
    const DerivedRange& bound = derived[static_cast<Site>(i)];
    EXPECT_GE(range.least, bound.least) << name;
    EXPECT_LE(range.greatest, bound.greatest) << name;
    EXPECT_TRUE(bound.saturates() || range.overflow == 0) << name;
    // A site without a counter cannot saturate.
    EXPECT_TRUE(cmodel::kSiteFacts[i].counts != nullptr || !bound.saturates()) << name;
    totals.values += range.count;
    totals.saturated += range.overflow;
    totals.unreachable += bound.saturates() ? 0 : 1;
    ++totals.sites;
  }
}

/// Expects both ends of every derived range to be reached, and every saturation that is derived.
void reach(const Config& config, const cmodel::Ranges& seen, std::uint64_t& ends, std::uint64_t& saturating) {
  for (const DerivedRange& range : derived_ranges(config)) {
    const cmodel::Range& one = seen.at(range.site);
    const char* name = cmodel::facts(range.site).name;
    ASSERT_GT(one.count, 0u) << name;
    EXPECT_EQ(one.least, range.least) << config.name << ", " << name;
    EXPECT_EQ(one.greatest, range.greatest) << config.name << ", " << name;
    EXPECT_EQ(one.overflow > 0, range.saturates()) << config.name << ", " << name;
    ends += 2;
    saturating += range.saturates() ? 1 : 0;
  }
}

TEST(DerivedRanges, HoldEveryValueOfRandomStreams) {
  test::Random random(test::seed_or(4100));
  Totals totals;
  int configs = 0;
  for (; configs < 180 && !testing::Test::HasFailure(); ++configs) {
    const Config config = any_config(random, configs);
    cmodel::Ranges seen;
    for (int stream = 0; stream < 2; ++stream)
      watch(config, test::random_stream(test::symbols_of(config), random, 40).bytes, seen);
    contain(config, seen, totals);
  }
  std::printf(
      "[figure] configurations = %d, values compared = %llu, ranges = %llu (%llu cannot saturate), saturated = %llu\n",
      configs, static_cast<unsigned long long>(totals.values), static_cast<unsigned long long>(totals.sites),
      static_cast<unsigned long long>(totals.unreachable), static_cast<unsigned long long>(totals.saturated));
  EXPECT_GT(totals.unreachable, 100u);
  EXPECT_GT(totals.saturated, 0u);
}

TEST(DerivedRanges, AreReachedAtBothEnds) {
  test::Random random(test::seed_or(4101));
  std::uint64_t ends = 0, saturating = 0;
  Totals totals;
  std::vector<Config> configs;
  for (const std::string& name : test::config_names()) configs.push_back(test::named_config(name));
  for (int n = 0; n < 60; ++n) configs.push_back(any_config(random, n));
  for (Config& config : configs) {
    config.cull_map = 0;  // hidden splats reach nothing
    const cmodel::Ranges seen = witnessed(config);
    contain(config, seen, totals);
    reach(config, seen, ends, saturating);
    if (testing::Test::HasFailure()) break;
  }
  std::printf("[figure] configurations = %zu, ends reached = %llu, saturating sites reached = %llu\n", configs.size(),
              static_cast<unsigned long long>(ends), static_cast<unsigned long long>(saturating));
  EXPECT_GT(saturating, 0u);
}

/// The formulas of docs/errors.md, evaluated from the symbols of docs/numerics.md in doubles, which are exact here.
TEST(DerivedRanges, AreThoseOfTheirFormulas) {
  test::Random random(test::seed_or(4102));
  std::set<std::string> formulas;
  int compared = 0;
  for (int n = 0; n < 300; ++n) {
    const Config config = any_config(random, n);
    const oracle::Symbols c = test::symbols_of(config);
    const auto power = [](int exponent) { return std::ldexp(1.0, exponent); };
    const auto cut = [&](oracle::Rounding rounding, double value, int from_f, const oracle::Words& words) {
      const auto exact = static_cast<std::int64_t>(std::ldexp(value, from_f));
      const auto narrowed = oracle::narrow(rounding, oracle::Overflow::Sat, exact, from_f, words);
      return std::ldexp(static_cast<double>(narrowed.word), -words.f);
    };
    const double E = power(c.wi) - power(-c.wf), V = power(c.ci) - power(-c.cf), S = power(c.si) - power(-c.sf);
    const double axis = std::min(1.0, E), C = power(1 + c.ci) - power(-c.tf);
    const double W = c.index == "separable" && c.f == 0
                         ? cut(oracle::Rounding::Rnd, axis * axis, 2 * (c.wf + c.g), oracle::u(c.wi, c.wf))
                         : E;
    const double P = cut(c.Rp, V * W, c.cf + c.wf, oracle::u(c.si, c.sf));
    const double L = cut(c.Ra, S, c.sf, c.ci == 0 ? oracle::one(c.tf) : oracle::u(c.ci, c.tf));
    const int b = c.si + c.sf - oracle::log2_of(c.G);
    const std::map<std::string, double> value{{"2^(pi-1) - 2^-pf", power(c.pi - 1) - power(-c.pf)},
                                              {"min(1, E)^2", axis * axis},
                                              {"E (1 - 2^-g)", E * (1 - power(-c.g))},
                                              {"V W", V * W},
                                              {"S + P", S + P},
                                              {"1 - 2^-b", 1 - power(-b)},
                                              {"S 1", S},
                                              {"S", S},
                                              {"1 L", L},
                                              {"1 1", 1},
                                              {"C + L", C + L},
                                              {"S + S", S + S},
                                              {"C", C}};
    for (const DerivedRange& range : derived_ranges(config)) {
      const int from = cmodel::narrowing(config, range.site).from_frac();
      const double least = range.site == Site::Snap         ? -power(c.pi - 1)
                           : range.site == Site::RadialFall ? -E * (1 - power(-c.g))
                                                            : 0.0;
      ASSERT_EQ(std::ldexp(static_cast<double>(range.greatest), -from), value.at(range.formula)) << range.formula;
      ASSERT_EQ(std::ldexp(static_cast<double>(range.least), -from), least) << range.formula;
      formulas.insert(range.formula);
      compared += 2;
    }
  }
  std::printf("[figure] formulas = %zu, ends compared = %d\n", formulas.size(), compared);
  EXPECT_EQ(formulas.size(), 13u);
}

/// tests/rtl/proofs/prove_unsaturated.sh proves these sites of the RTL.
TEST(DerivedRanges, CannotSaturateWhereTheRtlIsProvedNotTo) {
  for (const char* name : {"tiny", "small", "base"}) {
    std::set<std::string> proved{"snap", "product", "fall", "light", "absorbed"}, fits;
    if (std::string(name) != "tiny") proved.insert("pixel_out");
    for (const DerivedRange& range : derived_ranges(test::named_config(name)))
      if (!range.saturates()) fits.insert(cmodel::facts(range.site).name);
    EXPECT_EQ(fits, proved) << name;
  }
}

/// The table of docs/errors.md, section 4.
TEST(DerivedRanges, OfBaseAreThoseOfThePage) {
  const Config base = test::named_config("base");
  std::string table;
  for (const DerivedRange& range : derived_ranges(base)) {
    const cmodel::Narrowing site = cmodel::narrowing(base, range.site);
    table += fmt::format("| {} | {} | {} | {} | {} |\n", cmodel::facts(range.site).name, range.formula,
                         format_text(site.to()), interval_text(range.least, range.greatest, site.from_frac()),
                         verdict(range));
  }
  std::ifstream file(std::string(FASTSPLAT_SOURCE_DIR) + "/docs/errors.md");
  const std::string page((std::istreambuf_iterator<char>(file)), {});
  EXPECT_NE(page.find("|\n" + table + "\n"), std::string::npos) << "the page should have\n" << table;
}

}  // namespace
}  // namespace fastsplat::analysis
