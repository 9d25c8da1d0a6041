// SPDX-License-Identifier: Apache-2.0
// One pixel followed: equal to the picture's pixel in every mixture, with the words of the model's taps.
#include "analysis/pipeline/pixel_trace.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "analysis/errors/pixel_report.hpp"
#include "analysis/pipeline/weight_steps.hpp"
#include "base/error.hpp"
#include "cmodel/composite/slab_opacity.hpp"
#include "cmodel/model.hpp"
#include "driver/tables/tables.hpp"
#include "driver/tiles/compile.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/pipeline/mixtures_helper.hpp"

namespace fastsplat::stages {
namespace {

using fastsplat::test::Random;

/// What the model's taps say of one pixel.
class PixelTaps final : public cmodel::TapSink {
 public:
  struct Sheet {
    std::vector<std::uint32_t> weights;  ///< above 0, sorted
    std::array<std::uint32_t, 4> sums{}, after{};
  };
  PixelTaps(const driver::TileGrid& grid, int lanes, int x, int y)
      : lanes_(lanes),
        tile_(static_cast<std::uint32_t>(y / grid.tile_height * grid.columns() + x / grid.tile_width)),
        x_(x % grid.tile_width),
        y_(y % grid.tile_height) {}
  void on_tap(const cmodel::TapRecord& record) override {
    const int i = x_ - record.x, j = y_ - record.y;
    if (record.tile != tile_ || record.tap == cmodel::Tap::Snap) return;
    if (record.tap == cmodel::Tap::Pixel) {
      if (i == 0 && j == 0) std::copy_n(record.payload.begin(), 4, out.begin());
      return;
    }
    if (i < 0 || j < 0 || i >= lanes_ || j >= lanes_) return;
    const auto lane = static_cast<std::size_t>(j * lanes_ + i);
    if (record.tap == cmodel::Tap::Footprint) {
      if (record.payload[lane] != 0) sheets[record.sheet].weights.push_back(record.payload[lane]);
      return;
    }
    auto& four = record.tap == cmodel::Tap::Sheet ? sheets[record.sheet].sums : sheets[record.sheet].after;
    std::copy_n(record.payload.begin() + static_cast<std::ptrdiff_t>(4 * lane), 4, four.begin());
  }
  std::map<std::uint32_t, Sheet> sheets;
  std::array<std::uint32_t, 4> out{};

 private:
  int lanes_;
  std::uint32_t tile_;
  int x_, y_;
};

double word(double value, int frac_bits) { return std::ldexp(value, frac_bits); }

struct Compared {
  std::size_t pixels = 0, words = 0, different = 0, saturated = 0;
  void add(double ours, std::uint32_t theirs) {
    ++words;
    different += ours == static_cast<double>(theirs) ? 0 : 1;
  }
  void print(const char* what) const {
    std::printf("[figure] %s: %zu pixels, %zu words compared, %zu different; %zu saturated sums\n", what, pixels, words,
                different, saturated);
  }
};

/// Hands on to each.
class AllTaps final : public cmodel::TapSink {
 public:
  void on_tap(const cmodel::TapRecord& record) override {
    for (PixelTaps& one : pixels) one.on_tap(record);
  }
  std::vector<PixelTaps> pixels;
};

/// Every word of the trace against the taps.
void against_taps(const scene::Scene& scene, const cmodel::Config& config, Random& random, Compared& all) {
  const Chain chain(scene, config);
  const driver::CompiledFrame compiled(scene, config);
  std::vector<cmodel::Beat> beats;
  compiled.emit([&](std::span<const cmodel::Beat> some) { beats.insert(beats.end(), some.begin(), some.end()); });
  const bool xray = scene.description.method == scene::Method::XRay;
  const int sf = config.sheet_frac_bits, state_bits = xray ? sf : config.composite_frac_bits;
  AllTaps all_taps;
  std::vector<glm::ivec2> places;
  for (int pixel = 0; pixel < 8; ++pixel) {
    const auto x = static_cast<int>(random.between(0, scene.description.width - 1));
    places.emplace_back(x, random.between(0, scene.description.height - 1));
    all_taps.pixels.emplace_back(compiled.grid(), config.lanes, places.back().x, places.back().y);
  }
  cmodel::NullPixels nowhere;
  cmodel::Model device(config, cmodel::StreamScope::Subset, nowhere, &all_taps);
  device.consume(beats);
  device.finish();
  for (std::size_t pixel = 0; pixel < places.size(); ++pixel) {
    PixelTaps& taps = all_taps.pixels[pixel];
    const int x = places[pixel].x, y = places[pixel].y;
    const PixelTrace trace = PixelChain(chain, x, y, 1)(Mixture::all_device());
    for (std::size_t c = 0; c < 4; ++c) all.add(word(trace.out[c], config.pixel_frac_bits), taps.out[c]);
    const WeightSteps steps(scene.kernel, config);
    for (const SplatTrace& splat : trace.splats) {
      if (!splat.entries) continue;
      EXPECT_EQ(steps.weight(*splat.entries, Mixture::all_device()), splat.weight);
    }
    cmodel::SlabOpacity opacity(config);
    opacity.load(driver::factor_table(config).words);
    for (const SheetTrace& sheet : trace.sheets) {
      EXPECT_TRUE(xray || &sheet == &trace.sheets.back() || word(sheet.after[3], state_bits) >= config.freeze_below);
      const PixelTaps::Sheet& theirs = taps.sheets[static_cast<std::uint32_t>(sheet.sheet)];
      std::vector<std::uint32_t> weights = theirs.weights;
      std::vector<double> ours;
      for (const ShareTrace& share : sheet.shares)
        ours.push_back(word(trace.splats[share.splat].weight, config.radial_frac_bits));
      std::ranges::sort(weights);
      std::ranges::sort(ours);
      EXPECT_EQ(weights.size(), ours.size());
      for (std::size_t i = 0; i < std::min(weights.size(), ours.size()); ++i) all.add(ours[i], weights[i]);
      for (std::size_t c = 0; c < 4; ++c) {
        all.add(word(sheet.sums[c], sf), theirs.sums[c]);
        all.add(word(sheet.after[c], state_bits), theirs.after[c]);
      }
      if (xray || scene.description.slab_opacity == scene::SlabOpacity::Additive) continue;
      cmodel::Nothing nobody;
      const cmodel::SheetWord sums{theirs.sums[0], theirs.sums[1], theirs.sums[2], theirs.sums[3]};
      const cmodel::Slab slab = opacity.exponential(sums, nobody);
      all.add(word(sheet.factor, config.opacity_frac_bits), opacity.factor(sums[3], nobody));
      all.add(word(sheet.slab.opacity, config.composite_frac_bits), slab.opacity);
      for (std::size_t c = 0; c < 3; ++c)
        all.add(word(sheet.slab.colour[c], config.composite_frac_bits), slab.colour[c]);
      all.saturated += std::ranges::max(theirs.sums) == static_cast<std::uint32_t>(config.sheet_format().max) ? 1 : 0;
    }
    ++all.pixels;
  }
}

TEST(PixelTrace, AllItsWordsAreTheModelsTaps) {
  Random random(53);
  Compared all;
  for (int round = 0; round < 60; ++round) {
    const auto kind = static_cast<cmodel::IndexKind>(round % 6);
    cmodel::Config config = round % 2 == 0 || kind == cmodel::IndexKind::Linear
                                ? fastsplat::test::random_config(random, kind)
                                : fastsplat::test::random_ellipse_config(random, kind);
    scene::SceneDescription description = test::random_scene(random);
    if (round % 4 == 3) {  // sums saturate
      config = fastsplat::test::named_config("base");
      config.sheet_int_bits = 1;
      description = {.volume = "binary-cube:12", .width = 20, .height = 20, .opacity_scale = 1000.0};
    }
    const scene::Scene scene = scene::build_scene(description);
    try {
      against_taps(scene, config, random, all);
    } catch (const UserError&) {
      continue;  // the device cannot draw this scene
    }
    ASSERT_EQ(all.different, 0U) << test::text_of(config);
  }
  all.print("taps");
  EXPECT_GT(all.words, 5000U);
  EXPECT_GT(all.saturated, 10U);
}

/// The pixel in a mixture against the whole picture's.
TEST(PixelTrace, IsThePicturesPixelInEveryMixture) {
  Random random(54);
  std::size_t compared = 0, different = 0;
  double farthest = 0.0;
  const auto scenes = test::small_scenes();
  for (int round = 0; round < 30; ++round) {
    cmodel::Config config = fastsplat::test::named_config(round % 2 == 0 ? "base" : "ellipse");
    if (round % 3 == 2) config.rounding_carry = static_cast<int>(cmodel::Carry::On);
    scene::SceneDescription description = scenes[static_cast<std::size_t>(round) % scenes.size()];
    if (round % 5 == 4) {  // every sample composited
      config.composite_lanes = 0;
      config.composite_every_sample = 1;
      description.method = scene::Method::Westover;
      description.slab_width = scene::SceneDescription{}.slab_width;
    }
    const scene::Scene scene = scene::build_scene(description);
    const Chain chain(scene, config);
    for (const Mixture& mixture : {test::random_mixture(random), Mixture{}}) {
      const Picture picture = chain(mixture);
      const bool golden_units = mixture.real(Step::Position, Step::Sheet);
      for (int pixel = 0; pixel < 6; ++pixel) {
        const auto x = static_cast<int>(random.between(0, picture.width - 1)),
                   y = static_cast<int>(random.between(0, picture.height - 1));
        const golden::Sums whole = picture.pixels[static_cast<std::size_t>(y) * picture.width + x];
        const golden::Sums one = PixelChain(chain, x, y, 1)(mixture).out;
        ++compared;
        if (!golden_units) different += one == whole ? 0 : 1;
        for (std::size_t c = 0; c < 4; ++c) farthest = std::max(farthest, std::abs(one[c] - whole[c]));
      }
    }
  }
  std::printf("[figure] pixels compared = %zu, different = %zu, farthest = %.3g (limit 1e-12)\n", compared, different,
              farthest);
  EXPECT_EQ(different, 0U);
  EXPECT_LT(farthest, 1e-12);
  EXPECT_GT(compared, 300U);
}

// Rounding errors reach the pixel from splats that do not touch it.
TEST(PixelTrace, FollowsErrorDiffusion) {
  scene::SceneDescription description;
  description.volume = "binary-cube:20";  // solid: errors go far
  description.width = description.height = 48;
  description.method = scene::Method::XRay;
  description.camera.azimuth = 40.0;
  description.camera.elevation = 20.0;
  const scene::Scene scene = scene::build_scene(description);
  const cmodel::Config config = fastsplat::test::named_config("tiny");
  const Chain chain(scene, config);
  ASSERT_TRUE(chain.steps().carries());
  const Picture picture = chain(Mixture::all_device());
  std::size_t compared = 0, different = 0;
  for (int y = 0; y < 48; y += 5) {
    for (int x = 0; x < 48; x += 5) {
      const golden::Sums one = PixelChain(chain, x, y, 1)(Mixture::all_device()).out;
      ++compared;
      different += one == picture.pixels[static_cast<std::size_t>(y) * 48 + static_cast<std::size_t>(x)] ? 0 : 1;
    }
  }
  std::printf("[figure] pixels compared = %zu, different = %zu\n", compared, different);
  EXPECT_EQ(different, 0U);
}

// In the JSON: a splat has its own quantities on a side that has no share of it in the first sheet.
TEST(PixelReport, WordsAreIntegersAndSplatsWhole) {
  Random random(55);
  std::size_t words = 0, fractions = 0, splats = 0, torn = 0;
  for (int round = 0; round < 30; ++round) {
    const auto kind = static_cast<cmodel::IndexKind>(round % 6);
    const cmodel::Config config = round % 2 == 0 || kind == cmodel::IndexKind::Linear
                                      ? fastsplat::test::random_config(random, kind)
                                      : fastsplat::test::random_ellipse_config(random, kind);
    const scene::Scene scene = scene::build_scene(test::random_scene(random));
    try {
      const Chain chain(scene, config);
      const auto report = analysis::explain(chain, scene.description.width / 2, scene.description.height / 2, 1);
      const auto json = analysis::to_json(report, chain);
      const auto take = [&](const nlohmann::ordered_json& quantities) {
        for (const auto& [name, one] : quantities.items()) {
          if (one.at("word").is_null()) continue;
          ++words;
          fractions += std::floor(one.at("word").get<double>()) == one.at("word").get<double>() ? 0 : 1;
        }
      };
      const std::string counts =
          std::to_string(json.at("splats").size()) + " splats, " + std::to_string(json.at("sheets").size()) + " sheets";
      EXPECT_NE(analysis::to_text(report, chain, {}, 8).find(counts), std::string::npos) << counts;
      take(json.at("pixel"));
      for (const auto& sheet : json.at("sheets")) {
        take(sheet.at("together"));
        for (const auto& share : sheet.at("shares")) take(share.at("values"));
      }
      std::size_t of_device = 0;
      for (const auto& splat : json.at("splats")) {
        take(splat.at("values"));
        of_device += splat.at("values").at("weight").at("device").is_null() ? 0 : 1;
      }
      splats += of_device;
      std::set<std::uint32_t> seen;  // by the device, in a sheet that is composited
      for (const auto& sheet : report.device.sheets)
        for (const auto& share : sheet.shares) seen.insert(share.splat);
      torn += of_device < seen.size() ? 1 : 0;
    } catch (const UserError&) {
      continue;  // the device cannot draw this scene
    }
  }
  std::printf("[figure] words = %zu, not integers = %zu; splats of the device = %zu, pixels that lack some = %zu\n",
              words, fractions, splats, torn);
  EXPECT_GT(words, 1000U);
  EXPECT_EQ(fractions, 0U);
  EXPECT_EQ(torn, 0U);
}

TEST(PixelTrace, PartsAddUpToTheError) {
  const scene::Scene scene = scene::build_scene(test::small_scenes().front());
  const cmodel::Config config = fastsplat::test::named_config("tiny");
  const Chain chain(scene, config);
  const int x = scene.description.width / 2, y = scene.description.height / 2;
  const analysis::PixelReport report = analysis::explain(chain, x, y, 1);
  golden::Sums sum{};
  for (const auto& part : report.parts)
    for (std::size_t c = 0; c < 4; ++c) sum[c] += part.error[c];
  const golden::Sums error = report.error();
  double most = 0.0;
  for (std::size_t c = 0; c < 4; ++c) most = std::max(most, std::abs(sum[c] - error[c]));
  std::printf("[figure] error %.3g %.3g %.3g %.3g, parts differ by %.3g (limit 1e-15)\n", error[0], error[1], error[2],
              error[3], most);
  EXPECT_LE(most, 1e-15);
  EXPECT_NE(error[report.channel], 0.0);
}

TEST(PixelTrace, RefusesWhatItCannotFollow) {
  const scene::Scene scene = scene::build_scene(test::small_scenes().front());
  const cmodel::Config config = fastsplat::test::named_config("base");
  const Chain chain(scene, config);
  EXPECT_THROW(PixelChain(chain, -1, 0, 1), UserError);
  EXPECT_THROW(PixelChain(chain, 0, scene.description.height, 1), UserError);
  const scene::Scene densities = scene::build_scene(test::small_density_scenes().front());
  cmodel::Config classifying = fastsplat::test::named_config("fine");
  classifying.classify_segment_bits = 9;
  const Chain of_densities(densities, classifying);
  EXPECT_THROW(PixelChain(of_densities, 0, 0, 1), UserError);
}

}  // namespace
}  // namespace fastsplat::stages
