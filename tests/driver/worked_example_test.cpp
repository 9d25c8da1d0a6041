// SPDX-License-Identifier: Apache-2.0
// The worked example of docs/numerics.md: the driver's words for one splat, the model's words at one pixel, and the
// table that the page shows.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "cmodel/composite/slab_opacity.hpp"
#include "cmodel/model.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tables/quantise.hpp"
#include "driver/tables/tables.hpp"
#include "tests/driver/scenes_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::driver {
namespace {

constexpr int kX = 21, kY = 13;                                    // the pixel
constexpr double kCentreX = 20.3, kCentreY = 12.7, kRadius = 2.0;  // pixels
constexpr double kRed = 0.4, kTau = 0.5;

/// The words at the pixel, by tap.
class PixelTaps final : public cmodel::TapSink {
 public:
  explicit PixelTaps(int lanes) : lanes_(lanes) {}
  void on_tap(const cmodel::TapRecord& record) override {
    if (record.tap == cmodel::Tap::Snap) snap = {record.payload.begin(), record.payload.end()};
    if (record.tap == cmodel::Tap::Pixel && record.x == kX && record.y == kY)
      pixel = {record.payload.begin(), record.payload.end()};
    const int i = kX - record.x, j = kY - record.y;
    if (i < 0 || j < 0 || i >= lanes_ || j >= lanes_) return;
    const auto lane = static_cast<std::size_t>(j * lanes_ + i);
    if (record.tap == cmodel::Tap::Footprint) weight = record.payload[lane];
    const auto four = [&] { return std::vector(&record.payload[4 * lane], &record.payload[4 * lane] + 4); };
    if (record.tap == cmodel::Tap::Sheet) sheet = four();
    if (record.tap == cmodel::Tap::Composite) states.push_back(four());
  }
  std::vector<std::uint32_t> snap, sheet, pixel;
  std::uint32_t weight = 0;
  std::vector<std::vector<std::uint32_t>> states;

 private:
  int lanes_;
};

/// Rows "| quantity | rule | exact | format | word | value |".
class Table {
 public:
  void row(const std::string& quantity, const std::string& rule, const std::string& exact, const std::string& format,
           std::int64_t word, const std::string& value) {
    std::ostringstream line;
    line << "| " << quantity << " | " << rule << " | " << exact << " | " << format << " | " << word << " | " << value
         << " |\n";
    text_ += line.str();
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

std::string decimal(double value) {
  std::ostringstream text;
  text.precision(6);
  text << std::fixed << value;
  return text.str();
}

TEST(WorkedExample, ThePageShowsTheWordsOfDriverAndModel) {
  const auto config = load_config("base");
  const auto kernel = scene::kernel_by_name("gauss2");
  const auto word = [&](Site site, double value) { return quantise(value, target(site, config)).word; };
  const auto rlut = rlut_table(config, 0, kRadius, 0), radial = radial_table(config, kernel);
  cmodel::SplatRecord splat{.x = static_cast<std::int32_t>(word(Site::Position, kCentreX)),
                            .y = static_cast<std::int32_t>(word(Site::Position, kCentreY))};
  splat.colour[0] = static_cast<std::uint32_t>(word(Site::Whole, kRed));
  splat.colour[3] = static_cast<std::uint32_t>(word(Site::Whole, kTau));

  // Two sheets, each with the splat.
  std::vector<cmodel::Beat> beats;
  const auto put = [&](const cmodel::Record& record) { append(beats, record); };
  put(cmodel::BeginFrame{.config_hash = cmodel::config_hash(config), .width = 32, .height = 32, .tiles = 1});
  put(rlut);
  put(radial);
  put(factor_table(config));
  put(cmodel::BeginTile{.width = 32, .height = 32});
  for (std::uint32_t sheet = 0; sheet < 2; ++sheet) {
    put(cmodel::BeginSheet{.sheet = sheet});
    splat.tag = sheet;
    put(splat);
    put(cmodel::EndSheet{.sheet = sheet, .splats = 1});
  }
  put(cmodel::EndTile{.tile = 0, .sheets = 2});
  PixelTaps taps(config.lanes);
  cmodel::NullPixels nowhere;
  cmodel::Model device(config, cmodel::StreamScope::Subset, nowhere, &taps);
  device.consume(beats);
  device.finish();
  ASSERT_EQ(taps.snap.size(), 4U);
  ASSERT_EQ(taps.states.size(), 2U);
  ASSERT_EQ(taps.pixel.size(), 4U);

  const auto x0 = static_cast<std::int32_t>(taps.snap[0]), y0 = static_cast<std::int32_t>(taps.snap[1]);
  const std::uint32_t mx = taps.snap[2], my = taps.snap[3];
  const auto columns = rlut.words.size() / static_cast<std::size_t>(config.phases);
  const std::uint32_t column = rlut.words[mx * columns + static_cast<std::size_t>(kX - x0)];
  const std::uint32_t line = rlut.words[my * columns + static_cast<std::size_t>(kY - y0)];
  const std::uint32_t q = column + line, t = q >> config.rlut_guard_bits;
  ASSERT_EQ(radial.words.at(t), taps.weight) << "the page's path to the weight is the model's";

  cmodel::SlabOpacity opacity(config);
  cmodel::Nothing nobody;
  opacity.load(factor_table(config).words);
  const cmodel::SheetWord sums{taps.sheet[0], taps.sheet[1], taps.sheet[2], taps.sheet[3]};
  const auto factor = opacity.factor(sums[3], nobody);
  const auto slab = opacity.exponential(sums, nobody);
  ASSERT_EQ(slab.colour[0], taps.states[0][0]) << "T is 1 before the first sheet";

  // Reals, without any rounding.
  const double dx = kX - kCentreX, dy = kY - kCentreY, entries = config.radial_entries / (kRadius * kRadius);
  const double weight = std::exp(-8.0 * (dx * dx + dy * dy) / (kRadius * kRadius)), tau = kTau * weight;
  const double clear = std::exp(-tau);
  const auto colour = [&](double alpha) { return kRed / kTau * alpha; };

  const auto real = [](std::int64_t w, int bits) { return std::ldexp(static_cast<double>(w), -bits); };
  const auto scaled = [&](std::int64_t w, int bits) { return decimal(real(w, bits)); };
  const auto format = [](const char* kind, int i, int f) {
    return std::string(kind) + " " + std::to_string(i) + "." + std::to_string(f);
  };
  const int pf = config.position_frac_bits, cf = config.colour_frac_bits, sf = config.sheet_frac_bits,
            g = config.rlut_guard_bits, of = config.opacity_frac_bits, tf = config.composite_frac_bits;
  const std::string position = format("S", config.position_int_bits, pf), u_cf = format("U", 0, cf),
                    sum = format("U", config.sheet_int_bits, sf), one = "One." + std::to_string(tf),
                    light = format("U", 1, tf), out = format("U", config.pixel_int_bits, config.pixel_frac_bits);
  const std::string rlut_entry = "RLUT[0][";
  Table table;
  table.row("x", "N-8-36", decimal(kCentreX), position, splat.x, scaled(splat.x, pf));
  table.row("y", "N-8-36", decimal(kCentreY), position, splat.y, scaled(splat.y, pf));
  table.row("v_R", "N-8-37", decimal(kRed), u_cf, splat.colour[0], scaled(splat.colour[0], cf));
  table.row("v_tau", "N-8-37", decimal(kTau), u_cf, splat.colour[3], scaled(splat.colour[3], cf));
  table.row("rho", "N-4-2", decimal(kRadius), "1/k pixel", rlut.radius.rho, scaled(rlut.radius.rho, 6));
  table.row("x0", "N-3-5", "", "pixel", x0, "");
  table.row("y0", "N-3-5", "", "pixel", y0, "");
  table.row("mx", "N-3-5", "", "1/k pixel", mx, scaled(mx, 6));
  table.row("my", "N-3-5", "", "1/k pixel", my, scaled(my, 6));
  table.row(rlut_entry + std::to_string(mx) + "][" + std::to_string(kX - x0) + "]", "N-4-2", decimal(dx * dx * entries),
            "2^-" + std::to_string(g) + " entry", column, scaled(column, g));
  table.row(rlut_entry + std::to_string(my) + "][" + std::to_string(kY - y0) + "]", "N-4-2", decimal(dy * dy * entries),
            "2^-" + std::to_string(g) + " entry", line, scaled(line, g));
  table.row("q", "N-4-6", decimal((dx * dx + dy * dy) * entries), "2^-" + std::to_string(g) + " entry", q,
            scaled(q, g));
  table.row("t", "N-4-6", "", "entry", t, "");
  table.row("w = RADIAL[t]", "N-4-6", decimal(weight), format("U", config.radial_int_bits, config.radial_frac_bits),
            taps.weight, scaled(taps.weight, config.radial_frac_bits));
  table.row("S_R", "N-5-3", decimal(kRed * weight), sum, taps.sheet[0], scaled(taps.sheet[0], sf));
  table.row("S_tau", "N-5-3", decimal(tau), sum, taps.sheet[3], scaled(taps.sheet[3], sf));
  table.row("f", "N-6-2", decimal((1.0 - clear) / tau), "One." + std::to_string(of), factor, scaled(factor, of));
  table.row("a", "N-6-3", decimal(1.0 - clear), one, slab.opacity, scaled(slab.opacity, tf));
  table.row("c_R", "N-6-3", decimal(colour(1.0 - clear)), one, slab.colour[0], scaled(slab.colour[0], tf));
  table.row("C_R, first sheet", "N-6-7", decimal(colour(1.0 - clear)), light, taps.states[0][0],
            scaled(taps.states[0][0], tf));
  table.row("T, first sheet", "N-6-7", decimal(clear), one, taps.states[0][3], scaled(taps.states[0][3], tf));
  table.row("C_R, second sheet", "N-6-7", decimal(colour(1.0 - clear * clear)), light, taps.states[1][0],
            scaled(taps.states[1][0], tf));
  table.row("T, second sheet", "N-6-7", decimal(clear * clear), one, taps.states[1][3], scaled(taps.states[1][3], tf));
  table.row("R", "N-7-2", decimal(colour(1.0 - clear * clear)), out, taps.pixel[0],
            scaled(taps.pixel[0], config.pixel_frac_bits));
  table.row("A", "N-7-2", decimal(1.0 - clear * clear), out, taps.pixel[3],
            scaled(taps.pixel[3], config.pixel_frac_bits));

  std::ifstream file(FASTSPLAT_SOURCE_DIR "/docs/numerics.md");
  std::stringstream page;
  page << file.rdbuf();
  EXPECT_NE(page.str().find(table.text()), std::string::npos) << "docs/numerics.md needs these rows:\n" << table.text();
  figure("error of R", std::abs(real(taps.pixel[0], config.pixel_frac_bits) - colour(1.0 - clear * clear)) * 255,
         "LSB8");
}

}  // namespace
}  // namespace fastsplat::driver
