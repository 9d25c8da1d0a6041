// SPDX-License-Identifier: Apache-2.0
// Energy by part against docs/errors.md, section 5, written out; and that more work never costs less.
#include "analysis/errors/energy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "driver/config/config_file.hpp"
#include "tests/cmodel/random_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Mode;

std::map<std::string, Joules> by_name(const cmodel::Config& config, const Activity& activity) {
  std::map<std::string, Joules> out;
  for (const EnergyPart& part : energy(config, activity)) out[part.name] = part.joules;
  return out;
}

void expect(const Joules& got, double low, double high, const char* what) {
  EXPECT_NEAR(got.low, low, 1e-9 * low) << what;
  EXPECT_NEAR(got.high, high, 1e-9 * high) << what;
}

TEST(Energy, IsWhatThePageSays) {
  const cmodel::Config c = driver::load_config("base");
  Activity a{.mode = Mode::Exponential, .counters = {}, .bytes_in = 320, .bytes_out = 160};
  a.counters.splats = 3;
  a.counters.windows = 5;
  a.counters.lanes_weighted = 70;
  a.counters.dirty_blocks = 2;
  a.counters.pixels_composited = 100;
  a.counters.frozen_pixels = 40;
  const double adder_low = 0.007e-12 / 8, adder_high = 0.03e-12 / 8, bit_low = 7.5e-12 / 64, bit_high = 10e-12 / 64,
               dram_low = 250e-12 / 64, dram_high = 2600e-12 / 64;
  const double p = c.lanes * c.lanes, s = c.sheet_int_bits + c.sheet_frac_bits,
               w = c.radial_int_bits + c.radial_frac_bits, q = c.radial_index_bits() + c.rlut_guard_bits + 1,
               f = c.opacity_frac_bits + 1, t = c.composite_frac_bits + 1, b = c.opacity_remainder_bits();
  const auto parts = by_name(c, a);
  expect(parts.at("stream"), 320 * 8 * dram_low, 320 * 8 * dram_high, "stream");
  expect(parts.at("pixels"), 160 * 8 * dram_low, 160 * 8 * dram_high, "pixels");
  const double positions = 3 * 2.0 * (c.position_int_bits + c.position_frac_bits);
  expect(parts.at("positions"), positions * adder_low, positions * adder_high, "positions");
  expect(parts.at("weights"), 70 * q * adder_low, 5 * p * q * adder_high, "weights");
  expect(parts.at("products"), 70 * 4 * c.colour_bits() * w * adder_low, 5 * p * 4 * c.colour_bits() * w * adder_high,
         "products");
  expect(parts.at("sums"), 70 * 4 * s * adder_low, 5 * p * 4 * s * adder_high, "sums");
  expect(parts.at("sheets"), (70 + 60) * 8 * s * bit_low, (5 + 2) * p * 8 * s * bit_high, "sheets");
  const double pixel = 2 * f + 4 * t + f * b + 4 * s * f + 4 * t * t;
  expect(parts.at("compositing"), 60 * pixel * adder_low, 2 * p * pixel * adder_high, "compositing");
  expect(parts.at("picture"), (60 * 2 + 10) * 4 * s * bit_low, (2 * p * 2 + 10) * 4 * s * bit_high, "picture");
  // A row of P words of the RLUT for each axis; a table of more than 8 KB.
  EXPECT_GT(c.rlut_columns * c.phases * q, 8 * 8192);
  EXPECT_LE(c.rlut_columns * c.phases * q, 8 * 32768);
  expect(parts.at("tables"), 5 * 2 * 8 * q * 8.5e-12 / 64 + (70 * w + 60 * 2 * f) * bit_low,
         5 * 2 * 8 * q * 20e-12 / 64 + (5 * p * w + 2 * p * 2 * f) * bit_high, "tables");
  expect(parts.at("output"), 10 * 4.0 * (c.pixel_int_bits + c.pixel_frac_bits) * adder_low,
         10 * 4.0 * (c.pixel_int_bits + c.pixel_frac_bits) * adder_high, "output");
  Joules sum;
  for (const auto& [name, part] : parts) sum += part;
  expect(total(energy(c, a)), sum.low, sum.high, "total");
  std::printf("[figure] parts compared = %zu (limit > 0)\n", parts.size());
  const auto json = to_json(energy(c, a));
  EXPECT_EQ(json.at("parts").size(), parts.size());
  EXPECT_DOUBLE_EQ(json.at("high_uj").get<double>(), 1e6 * sum.high);
}

TEST(Energy, HasThePicojoulesOfThePage) {
  std::ifstream in(FASTSPLAT_SOURCE_DIR "/docs/errors.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const auto row = [](const char* what, double unit, const char* name, const Joules& one, const char* low = "",
                      const char* high = "") {
    return fmt::format("| {} | {:.3g} {}{} | {:.3g} {}{} |\n", what, one.low / unit, name, low, one.high / unit, name,
                       high);
  };
  const std::string rows = row("full adder, or cell of a multiplier", 1e-15, "fJ", kCellEnergy) +
                           row("a bit of a memory up to 8 KB", 1e-12, "pJ", kMemoryEnergy[0].bit) +
                           row("up to 32 KB", 1e-12, "pJ", kMemoryEnergy[1].bit) +
                           row("above", 1e-12, "pJ", kMemoryEnergy[2].bit) +
                           row("a bit of DRAM", 1e-12, "pJ", kDramEnergy, " (HBM2)", " (DDR3)");
  EXPECT_NE(page.find(rows), std::string::npos) << rows;
}

TEST(Energy, HasOnlyThePartsOfTheMode) {
  const cmodel::Config c = driver::load_config("ellipse");
  Activity a{.counters = {}};
  a.counters.splats = a.counters.windows = a.counters.dirty_blocks = 10;
  a.counters.lanes_weighted = a.counters.pixels_composited = 20;
  a.mode = Mode::Sum;
  const auto xray = by_name(c, a);
  a.mode = Mode::Exponential;
  const auto sheets = by_name(c, a);
  a.ellipses = true;
  const auto ellipses = by_name(c, a);
  a.mode = Mode::SampleAdditive;
  const auto samples = by_name(c, a);
  EXPECT_LT(xray.at("compositing").high, 0.1 * sheets.at("compositing").high);
  EXPECT_LT(xray.at("tables").high, sheets.at("tables").high);
  EXPECT_GT(ellipses.at("positions").high, 10 * sheets.at("positions").high);
  EXPECT_LT(ellipses.at("tables").high, sheets.at("tables").high);  // no RLUT
  EXPECT_EQ(samples.at("sheets").high + samples.at("sums").high, 0.0);
  EXPECT_GT(samples.at("compositing").high, 0.0);
}

TEST(Energy, NeverFallsWithMoreWork) {
  test::Random random(test::seed_or(311));
  const auto up_to = [&](std::uint64_t most) {
    return static_cast<std::uint64_t>(random.between(0, static_cast<std::int64_t>(most)));
  };
  using cmodel::Counters;
  int compared = 0;
  for (const char* name : {"tiny", "small", "base", "ellipse", "hx8k"}) {
    const cmodel::Config c = driver::load_config(name);
    const auto lanes = static_cast<std::uint64_t>(c.lanes * c.lanes);
    for (const Mode mode : {Mode::Exponential, Mode::Additive, Mode::Sum, Mode::SampleAdditive}) {
      for (int i = 0; i < 50; ++i) {
        Activity less{.mode = mode, .ellipses = c.has_ellipses(), .counters = {}};
        Counters& n = less.counters;
        n.splats = up_to(1000);
        n.windows = n.splats + up_to(1000);
        n.dirty_blocks = up_to(1000);
        n.lanes_weighted = up_to(n.windows * lanes);
        n.pixels_composited = up_to((cmodel::every_sample(mode) ? n.windows : n.dirty_blocks) * lanes);
        n.frozen_pixels = up_to(n.pixels_composited);
        less.bytes_in = up_to(100'000);
        less.bytes_out = up_to(100'000);
        const auto parts = energy(c, less);
        for (const EnergyPart& part : parts) {
          EXPECT_LE(0.0, part.joules.low) << name << " " << part.name;
          EXPECT_LE(part.joules.low, part.joules.high) << name << " " << part.name;
        }
        const Joules before = total(parts);
        const auto compare = [&](const Activity& more, const char* what) {
          const Joules after = total(energy(c, more));
          EXPECT_GE(after.low, before.low) << name << " " << what;
          EXPECT_GE(after.high, before.high) << name << " " << what;
          EXPECT_GT(after.low + after.high, before.low + before.high) << name << " " << what;
          ++compared;
        };
        for (const auto& [what, counter] : {std::pair{"splats", &Counters::splats},
                                            {"windows", &Counters::windows},
                                            {"lanes_weighted", &Counters::lanes_weighted},
                                            {"pixels_composited", &Counters::pixels_composited}}) {
          Activity more = less;
          more.counters.*counter += lanes;
          compare(more, what);
        }
        Activity more = less;
        more.bytes_in += 32;
        compare(more, "bytes_in");
        more.bytes_in -= 32;
        more.bytes_out += 16;
        compare(more, "bytes_out");
      }
    }
  }
  std::printf("[figure] comparisons = %d (limit > 0)\n", compared);
  EXPECT_EQ(compared, 5 * 4 * 50 * 6);
}

TEST(Energy, SaysWhyThereIsNone) {
  EXPECT_TRUE(energy_violation(driver::load_config("base"), Mode::Exponential).empty());
  EXPECT_NE(energy_violation(driver::load_config("base"), Mode::DensityAdditive).find("classification"),
            std::string::npos);
  cmodel::Config separable = driver::load_config("base");
  separable.index_kind = static_cast<int>(cmodel::IndexKind::Separable);
  EXPECT_NE(energy_violation(separable, Mode::Exponential).find("index.kind"), std::string::npos);
}

}  // namespace
}  // namespace fastsplat::analysis
