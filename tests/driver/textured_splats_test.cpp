// SPDX-License-Identifier: Apache-2.0
// Textured splats on the device: pictures in the footprints of blit2d's sets, against golden's; refusals.
#include "scene/textured_splats.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tables/index_tables.hpp"
#include "driver/tables/radius_sets.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/driver/oracle/tables.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

constexpr int kPhases = 12;

scene::SceneDescription flame(scene::Method method) {
  auto description = view_of("fire:8", 96, "fire");
  description.method = method;
  description.camera.azimuth = 20;
  description.camera.elevation = 6;
  description.footprint.texture = {.phases = kPhases, .amplitude = 1.0, .frame = 5, .scale = 0.28};
  return description;
}

cmodel::Config with_pictures(int phases = 8) {
  auto config = load_config("base");
  config.index_kind = static_cast<int>(cmodel::IndexKind::Blit2d);
  config.phases = phases;
  config.rlut_sets = 64;
  EXPECT_FALSE(cmodel::first_violation(config)) << one_line(*cmodel::first_violation(config));
  return config;
}

// N-4.4-7: the words. A centre is up to 1/(2k) pixel off: half as far, 6 dB more, until another error dominates.
TEST(TexturedOnDevice, TheMorePlacesTheNearerToGolden) {
  for (const auto method : {scene::Method::ImageAligned, scene::Method::AxisAligned, scene::Method::XRay}) {
    const auto scene = scene::build_scene(flame(method));
    const Image reference = golden::render(scene);
    auto plain = flame(method);
    plain.footprint.texture.amplitude = 0.0;
    const double detail = distance(reference, golden::render(scene::build_scene(plain))).psnr_db;
    double before = 0.0;
    for (const int k : {4, 8, 16}) {
      const auto device = render(scene, with_pictures(k));
      const auto apart = distance(reference, to_image(device.frame));
      const std::string what = std::string(scene::to_string(method)) + ", k = " + std::to_string(k);
      figure(what + ": PSNR", apart.psnr_db, "dB");
      figure(what + ": max", apart.largest, "LSB8");
      EXPECT_GE(apart.psnr_db, 50.0) << what;
      EXPECT_GE(apart.psnr_db, before + (k == 16 ? 0.0 : 3.0)) << what;
      before = apart.psnr_db;
    }
    figure(std::string(scene::to_string(method)) + ": without the detail", detail, "dB");
    EXPECT_LT(detail, before - 10.0) << "plain splats are as near: the pictures show nothing";
  }
}

// In perspective each picture has sets of several radii.
TEST(TexturedOnDevice, PerspectiveHasPicturesOfSeveralRadii) {
  auto description = flame(scene::Method::ImageAligned);
  description.camera.projection = scene::Projection::Perspective;
  const auto scene = scene::build_scene(description);
  const auto config = with_pictures();
  const auto apart = distance(golden::render(scene), to_image(render(scene, config).frame));
  figure("perspective: PSNR", apart.psnr_db, "dB");
  EXPECT_GE(apart.psnr_db, 50.0);
}

// N-4.4-7, N-8-29: a set for each picture of a radius. Order of the sets: all radii of the first picture, then those of
// the next; a radius is nearest to its own.
TEST(TexturedOnDevice, ASetIsAPictureOfARadius) {
  auto config = with_pictures();
  config.rlut_sets = 50;
  const RadiusSets sets(config, 2.0, 3.0, kPhases);
  const std::size_t radii = sets.size() / kPhases;
  figure("radii of each picture", static_cast<double>(radii), "(limit 4 of 50 sets and 12 pictures)");
  EXPECT_EQ(radii, 4u);
  ASSERT_EQ(sets.size(), radii * kPhases);
  for (std::uint32_t set = 0; set < sets.size(); ++set) {
    EXPECT_EQ(sets.picture(set), set / radii);
    EXPECT_EQ(sets.nearest(sets.radius(set), sets.picture(set)), set);
    EXPECT_EQ(sets.radius(set), sets.radius(set % static_cast<std::uint32_t>(radii)));
  }
}

// N-4.4-7. The pictures of a cycle cancel out: at each place the sum of N words is N times the plain word. Each of the
// words, and each plain one, may be off by half a word of rounding.
TEST(TexturedOnDevice, PicturesOfACycleCancelInTheTables) {
  const scene::Kernel kernel(2.0, 2.0);
  const scene::TexturedSplats textures({.phases = kPhases, .amplitude = 1.0, .frame = 0, .scale = 0.4}, kernel);
  const auto config = with_pictures();
  const auto plain = set_table(config, kernel, 0, 6.3, 0);
  std::vector<double> sums(plain.words.size(), 0.0);
  std::set<std::vector<std::uint32_t>> different;
  for (std::size_t number = 0; number < kPhases; ++number) {
    const auto table = set_table(config, kernel, 0, 6.3, 0, {.textures = &textures, .number = number});
    ASSERT_EQ(table.words.size(), sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += table.words[i];
    different.insert(table.words);
  }
  double most = 0.0;
  for (std::size_t i = 0; i < sums.size(); ++i) most = std::max(most, std::abs(sums[i] - kPhases * plain.words[i]));
  figure("words summed over a cycle, minus those of plain splats: largest", most, "(limit 12: half a word each)");
  EXPECT_LE(most, kPhases);
  EXPECT_GT(most, 0.0);
  EXPECT_EQ(different.size(), std::size_t{kPhases});
}

// N-4.4-7: every word, in the order of N-4.4-1.
TEST(TexturedOnDevice, WordsAreThoseOfThePage) {
  constexpr double kAmplitude = 0.7;
  const scene::Kernel kernel(2.0, 2.0);
  const double R = kernel.radius();
  const scene::TexturedSplats textures({.phases = kPhases, .amplitude = kAmplitude, .frame = 0, .scale = 0.4}, kernel);
  const auto config = with_pictures();
  const std::int64_t k = config.phases;
  std::size_t compared = 0, different = 0, above = 0;
  for (const double r : {2.6, 6.3}) {
    const auto set = scene_oracle::radius_set(test::symbols_of(config), r);
    const double rk = r * static_cast<double>(k);
    for (const std::size_t number : {std::size_t{0}, std::size_t{7}}) {
      const auto words = set_table(config, kernel, 0, r, 0, {.textures = &textures, .number = number}).words;
      ASSERT_EQ(words.size(), static_cast<std::size_t>(k * k * set.Ea * set.Ea));
      for (std::size_t at = 0; at < words.size(); ++at) {
        auto rest = static_cast<std::int64_t>(at);
        const auto next = [&rest](std::int64_t count) { return std::exchange(rest, rest / count) % count; };
        const std::int64_t i = next(set.Ea), j = next(set.Ea), mx = next(k), my = next(k);
        const auto dx = static_cast<double>((i + 1) * k - mx - set.rho);
        const auto dy = static_cast<double>((j + 1) * k - my - set.rho);
        const double square = dx * dx + dy * dy, F = std::exp(-kernel.a() * R * R * (square / (rk * rk)));
        const double t = textures.phases()[number](R * dx / rk, R * dy / rk);
        const std::int64_t word =
            square < rk * rk && i < set.E && j < set.E
                ? scene_oracle::nearest(std::ldexp(F * (1.0 + kAmplitude * t), config.radial_frac_bits))
                : 0;
        different += words[at] != word ? 1 : 0;
        above += word > 1 << config.radial_frac_bits ? 1 : 0;
        ++compared;
      }
    }
  }
  figure("words of sets with pictures compared", static_cast<double>(compared));
  figure("words above 1", static_cast<double>(above));
  EXPECT_EQ(different, 0U);
  EXPECT_GT(above, 0U);
}

// The plain unit, and any number of threads, draw the same words.
TEST(TexturedOnDevice, UnitsAndThreadsNeverShow) {
  const auto scene = scene::build_scene(flame(scene::Method::ImageAligned));
  const auto config = with_pictures();
  const auto fast = render(scene, config);
  EXPECT_NE(fast.units.vectors, nullptr) << fast.units.why_plain;
  for (const int threads : {1, 3}) {
    const auto plain = render(scene, config, {.threads = threads, .unit = Unit::Plain});
    EXPECT_EQ(plain.frame.words, fast.frame.words);
    EXPECT_EQ(plain.counters, fast.counters);
  }
}

// N-8-29: without detail the splats are plain, word for word; N pictures on another frame are another picture.
TEST(TexturedOnDevice, AmplitudeZeroIsOffAndFramesDiffer) {
  auto description = flame(scene::Method::ImageAligned);
  const auto config = with_pictures();
  const auto words = [&] { return render(scene::build_scene(description), config).frame.words; };
  const auto now = words();
  description.footprint.texture.frame = 6;
  EXPECT_NE(words(), now);
  description.footprint.texture.frame = 5 + kPhases;
  EXPECT_EQ(words(), now);
  description.footprint.texture.amplitude = 0.0;
  const auto off = words();
  description.footprint.texture = {};
  EXPECT_EQ(words(), off);
}

std::string refused(const scene::SceneDescription& description, const cmodel::Config& config) {
  try {
    CompiledFrame(scene::build_scene(description), config);
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    return error.what();
  }
  return "";
}

// N-4.4-7: only without symmetry; N-4.4-8: only with wi = 1.
TEST(TexturedOnDevice, UnsupportedPatternsAreRefused) {
  using ::testing::AllOf, ::testing::HasSubstr, ::testing::StartsWith;
  const auto description = flame(scene::Method::ImageAligned);
  EXPECT_THAT(refused(description, load_config("base")),
              AllOf(StartsWith("splat_texture.amplitude"), HasSubstr("set index.kind = blit2d")));
  auto config = with_pictures();
  config.index_symmetry = static_cast<int>(cmodel::IndexSymmetry::Eightfold);
  EXPECT_THAT(refused(description, config), StartsWith("splat_texture.amplitude"));
  config = with_pictures();
  config.rlut_sets = kPhases - 1;
  // N-8-29: floor(rlut.sets / N) is 0.
  EXPECT_THAT(refused(description, config),
              AllOf(StartsWith("splat_texture.phases"), HasSubstr("rlut.sets = 11"), HasSubstr("got 12")));
  config = with_pictures();
  config.radial_int_bits = 0;
  EXPECT_THAT(refused(description, config), HasSubstr("radial.int_bits=1"));
  config = with_pictures();
  config.ellipse_frac_bits = 12;
  ASSERT_FALSE(cmodel::first_violation(config));
  EXPECT_EQ(refused(description, config), "") << "circles on a device that has ellipses, too";
  auto shaped = description;
  shaped.footprint.antialias = true;
  // N-8-30
  EXPECT_THAT(refused(shaped, config), AllOf(StartsWith("splat_texture.amplitude"), HasSubstr("ellipses")));
  EXPECT_EQ(refused(description, with_pictures()), "");
}

}  // namespace
}  // namespace fastsplat::driver
