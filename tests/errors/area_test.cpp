// SPDX-License-Identifier: Apache-2.0
// The area model against syntheses that its fit never sees, and what a model of area must never do.
#include "analysis/errors/area.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "analysis/errors/cost.hpp"
#include "analysis/errors/synthesised.hpp"
#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "driver/config/config_file.hpp"
#include "tests/paths.hpp"

namespace fastsplat::analysis {
namespace {

double off(double model, double measured) { return 100.0 * (model / measured - 1.0); }

TEST(Area, SamplesAreOfTheConfigurationsTheyName) {
  const auto samples = area_samples();
  for (const AreaSample& sample : samples) {
    EXPECT_EQ(sample.hash, hash_text(cmodel::config_hash(sample.config))) << sample.name << ": tools/synth area";
    EXPECT_FALSE(cmodel::first_violation(sample.config)) << sample.name;
  }
  EXPECT_GE(samples.size(), 10U);
}

/// The table of docs/errors.md, section 5, without commas.
std::string area_table() {
  std::ifstream in(FASTSPLAT_SOURCE_DIR "/docs/errors.md");
  std::string page(std::istreambuf_iterator<char>(in), {});
  std::erase(page, ',');
  const auto begin = page.find("Eight configurations are kept out");
  return page.substr(begin, page.find("Block RAM and DSP equal", begin) - begin);
}

/// Each by a fit without it. The one sample of ellipses is needed to know what they cost.
TEST(Area, IsWithin15PercentOfSynthesesThatTheFitDoesNotSee) {
  double worst = 0.0;
  int compared = 0, told = 0;
  const std::string table = area_table();
  for (const AreaSample& sample : area_samples()) {
    if (sample.name == "sample_ellipses") continue;
    const Area model = area_without(sample);
    const double lut = off(model.lut, sample.cells.lut), ff = off(model.ff, sample.cells.ff);
    std::printf("[figure] %s: LUT %.0f, model %+.1f %%; FF %.0f, model %+.1f %% (limit 15)\n", sample.name.c_str(),
                sample.cells.lut, lut, sample.cells.ff, ff);
    worst = std::max({worst, std::abs(lut), std::abs(ff)});
    ++compared;
    char row[80];
    std::snprintf(row, sizeof row, "| %.0f | %+.1f %% | %.0f | %+.1f %% |", sample.cells.lut, lut, sample.cells.ff, ff);
    told += table.find(row) != std::string::npos ? 1 : 0;
  }
  RecordProperty("worst_percent", std::to_string(worst));
  EXPECT_LE(worst, 15.0);
  EXPECT_GE(compared, 20);
  EXPECT_GE(told, 10);
  EXPECT_EQ(2 * told, std::ranges::count(table, '%')) << table;
}

/// Pairs of synthesised configurations, ranked by their LUTs: how many does a figure put in the other order? None may
/// be of two that somebody chose. With an error of up to 15 % a random one (a number ends its name) and another may be,
/// if they differ by less.
TEST(Area, RanksAsSynthesisDoes) {
  const auto samples = area_samples();
  int pairs = 0, by_area = 0, by_cost = 0;
  double widest = 1.0;
  for (const AreaSample& a : samples) {
    for (const AreaSample& b : samples) {
      if (!(a.cells.lut < b.cells.lut)) continue;
      ++pairs;
      by_cost += cost(a.config).total() < cost(b.config).total() ? 0 : 1;
      if (area(a.config).lut < area(b.config).lut) continue;
      ++by_area;
      const auto random = [](const AreaSample& one) { return std::isdigit(one.name.back()) != 0; };
      EXPECT_TRUE(random(a) || random(b)) << a.name << " and " << b.name;
      widest = std::max(widest, b.cells.lut / a.cells.lut);
      std::printf("[figure] area puts %s (%.0f LUT) above %s (%.0f LUT)\n", a.name.c_str(), a.cells.lut, b.name.c_str(),
                  b.cells.lut);
    }
  }
  std::printf("[figure] pairs = %d, in the other order by area %d, at most %.2f times apart (limit 1.15), by cost %d\n",
              pairs, by_area, widest, by_cost);
  EXPECT_GE(pairs, 200);
  EXPECT_LE(widest, 1.15);
}

TEST(Area, BlockRamsAndDspsAreExact) {
  for (const AreaSample& sample : area_samples()) {
    const Area model = area(sample.config);
    EXPECT_EQ(model.bram, sample.cells.bram) << sample.name;
    EXPECT_EQ(model.dsp, sample.cells.dsp) << sample.name;
  }
}

/// Of a Kintex-7 XC7K325T: 203,800 LUTs, 407,600 flip-flops, 890 halves of block RAM, 840 DSPs.
TEST(Area, OneNumberCountsEachResourceByItsShareOfTheChip) {
  const double lut = 203800.0;
  std::printf("[figure] a chip's flip-flops, block RAMs and DSPs = %.0f, %.0f, %.0f LUTs (%.0f each)\n",
              Area{.ff = 407600}.equivalent_luts(), Area{.half_bram = 890}.equivalent_luts(),
              Area{.dsp = 840}.equivalent_luts(), lut);
  EXPECT_EQ((Area{.lut = 2, .memory_lut = 3}.equivalent_luts()), 5.0);
  EXPECT_DOUBLE_EQ(Area{.ff = 407600}.equivalent_luts(), lut);
  EXPECT_DOUBLE_EQ(Area{.half_bram = 890}.equivalent_luts(), lut);
  EXPECT_DOUBLE_EQ(Area{.dsp = 840}.equivalent_luts(), lut);
}

TEST(Area, IsNearTheFiguresOfSynthesisWhereThereAreSome) {
  for (const char* name : {"tiny", "small", "base"}) {
    const auto config = driver::load_config(name);
    const auto measured = synthesised(config).at("xc7");
    const Area model = area(config);
    EXPECT_LE(std::abs(off(model.lut, measured.at("lut"))), 15.0) << name;
    EXPECT_LE(std::abs(off(model.ff, measured.at("ff"))), 15.0) << name;
    EXPECT_EQ(model.bram, measured.at("bram")) << name;
    EXPECT_EQ(model.dsp, measured.at("dsp")) << name;
  }
}

TEST(Area, OfEveryShippedConfigurationIsPlausible) {
  for (const auto& name : driver::config_names()) {
    const Area model = area(driver::load_config(name));
    std::printf("[figure] %s: LUT %.0f, FF %.0f, block RAM %.0f, DSP %.0f, equivalent LUT %.0f\n", name.c_str(),
                model.lut, model.ff, model.bram, model.dsp, model.equivalent_luts());
    EXPECT_GT(model.lut, 2000.0) << name;
    EXPECT_LT(model.lut, 2e6) << name;
    EXPECT_GT(model.ff, 0.4 * model.lut) << name;
    EXPECT_LT(model.ff, 1.5 * model.lut) << name;
    EXPECT_GT(model.equivalent_luts(), model.lut) << name;
  }
}

/// One bit, or factor of two, more of a key. A table that moves from look-up tables to block RAM may save some.
TEST(Area, MoreIsNeverMuchCheaper) {
  constexpr double kAllowed = 0.03;
  int compared = 0;
  for (const char* name : {"tiny", "small", "base", "compact", "fine", "ellipse"}) {
    const auto less = driver::load_config(name);
    for (const char* key : {"array.lanes", "tile.width", "tile.height", "position.int_bits", "position.frac_bits",
                            "snap.phases", "rlut.sets", "rlut.columns", "rlut.guard_bits", "radial.entries",
                            "radial.frac_bits", "sheet.int_bits", "sheet.frac_bits", "opacity.segments",
                            "opacity.frac_bits", "composite.frac_bits", "pixel.int_bits", "pixel.frac_bits"}) {
      auto more = less;
      const auto* entry = cmodel::find_key(key);
      int& value = more.*entry->member;
      const bool doubled = entry->power_of_two || std::string(key).starts_with("tile") ||
                           std::string(key).starts_with("rlut.s") || std::string(key).starts_with("rlut.c");
      value = doubled ? 2 * value : value + 1;
      if (cmodel::first_violation(more)) continue;
      double small = 0.0, large = 0.0;
      try {
        small = area(less).equivalent_luts();
        large = area(more).equivalent_luts();
      } catch (const UserError&) {
        continue;  // the RTL cannot be built
      }
      EXPECT_GE(large, (1.0 - kAllowed) * small) << name << " " << key;
      ++compared;
    }
  }
  std::printf("[figure] steps compared = %d (limit > 60)\n", compared);
  EXPECT_GT(compared, 60);
}

TEST(Area, IsRefusedWhereTheRtlIs) {
  auto config = driver::load_config("base");
  config.index_kind = static_cast<int>(cmodel::IndexKind::Squared);
  EXPECT_THROW(area(config), UserError);
  EXPECT_TRUE(area_json(config).is_null());
}

}  // namespace
}  // namespace fastsplat::analysis
