// SPDX-License-Identifier: Apache-2.0
// The driver against docs/numerics.md, section 8: every beat of random frames, over all configurations, methods and
// both projections; and the ends of the formats, exactly.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "cmodel/stream/records.hpp"
#include "driver/config/config_file.hpp"
#include "driver/files/stream_file.hpp"
#include "driver/tiles/compile.hpp"
#include "tests/driver/oracle_helper.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

constexpr scene::Projection kProjections[] = {scene::Projection::Orthographic, scene::Projection::Perspective};

TEST(DriverOracle, EveryBeatOfEveryConfigurationMethodAndProjection) {
  test::Random random(test::seed_or(1));
  OracleFigures figures;
  compare_random_frames(random, 1, 24, figures);
  print_and_expect_equal(figures);
  expect_all_met(figures);
}

/// One row of `voxels` full voxels along x, looked at from the left, in an image of one small tile.
scene::SceneDescription row_from_the_left() {
  scene::SceneDescription description;
  description.transfer_function = "binary";
  description.camera.azimuth = 90.0;
  description.camera.elevation = 0.0;
  description.width = description.height = 12;
  description.camera.zoom = 0.5;
  return description;
}

scene::Scene row_of(int voxels, const scene::SceneDescription& description, glm::dvec3 spacing = glm::dvec3(1.0)) {
  return build_scene(description,
                     volume_of({voxels, 1, 1}, spacing, std::vector<float>(static_cast<std::size_t>(voxels), 1.0F)));
}

// N-8-66: the first and last slab begin and end with the volume. A kernel whose rounded ends reach beyond them loses
// nothing.
TEST(DriverOracle, RimsAtBothEndsOfTheSlabs) {
  OracleFigures figures;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    for (int step = 0; step < 12; ++step) {
      auto description = row_from_the_left();
      description.kernel = "";
      description.kernel_a = 0.3;
      description.kernel_radius = 1.2 + 0.01 * step;
      description.slab_width = (1.0 + description.kernel_radius) / (1 + step % 3);  // half the row is 1 kernel unit
      description.opacity_scale = 10.0;
      compare_with_oracle(name + ", step " + std::to_string(step), row_of(3, description), config, figures);
    }
  }
  print_and_expect_equal(figures);
  EXPECT_GT(figures.met.rims_kept, 0U);
}

// N-8-64. Slabs have one depth step each, or three steps and splats at each third of them. Every entry of the slice
// table occurs in a record, also with an odd number of steps made even. Where slabs must have eleven fine steps, some
// entries occur.
TEST(DriverOracle, EveryStepOfTheSliceTable) {
  OracleFigures figures;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    for (const double steps_too_many : {0.0, 0.3, 0.7}) {
      auto description = row_from_the_left();
      description.kernel = "";
      description.kernel_a = 0.3;
      description.kernel_radius = 1.0 + std::ldexp(steps_too_many, -config.slice_phase_bits);
      const int bits = config.slice_phase_bits;  // slabs are no thinner than 1/100
      description.slab_width = std::ldexp(bits > 8 ? 11.0 : bits > 6 ? 3.0 : 1.0, -bits);
      description.opacity_scale = 1e3;
      compare_with_oracle(name + ", " + std::to_string(steps_too_many), row_of(3, description), config, figures);
    }
  }
  print_and_expect_equal(figures);
  EXPECT_EQ(figures.met.odd_steps, config_names().size());
}

/// Both sides of the number at which `is` changes within low..high: neighbouring doubles.
template <typename Is>
std::pair<double, double> change(double low, double high, const Is& is) {
  const bool at_low = is(low);
  EXPECT_NE(at_low, is(high));
  while (std::nextafter(low, high) < high) {
    const double middle = low + (high - low) / 2.0;
    (is(middle) == at_low ? low : high) = middle;
  }
  return {low, high};
}

// N-8-1, N-8-37, N-8-38: an X-ray's exposure scales a splat's words by any double: the last one with which a word is
// still 0, or still fits.
TEST(DriverOracle, WordsVanishAndSaturateAtTheSameDouble) {
  OracleFigures figures;
  std::uint64_t changes = 0;
  for (const char* name : {"base", "compact", "tiny"}) {
    const auto config = load_config(name);
    for (const auto projection : kProjections) {
      auto description = row_from_the_left();
      description.method = scene::Method::XRay;
      description.camera.projection = projection;
      const auto exposed = [&](double exposure) {
        description.xray_exposure = exposure;
        return row_of(2, description, {1.3, 0.7, 1.1});
      };
      const auto met = [&](double exposure) {
        return scene_oracle::compile(scene_oracle::given_by(exposed(exposure), config)).met;
      };
      const std::function<bool(double)> cases[] = {
          [&](double exposure) { return met(exposure).vanished_voxels == 2; },
          [&](double exposure) { return met(exposure).saturated_records > 0; },
          [&](double exposure) { return met(exposure).saturated_voxels > 0; },
      };
      for (const auto& is : cases) {
        const auto [below, above] = change(1e-7, 1e3, is);
        for (const double exposure : {below, above}) {
          compare_with_oracle(std::string(name) + ", exposure " + std::to_string(exposure), exposed(exposure), config,
                              figures);
          ++changes;
        }
      }
    }
  }
  figure("exposures at which a word begins to be, is cut in a record, is cut whole", static_cast<double>(changes));
  print_and_expect_equal(figures);
}

// N-8-62: westover.
TEST(DriverOracle, EverySampleIsOfOneSheetInItsOrder) {
  OracleFigures figures;
  for (const char* name : {"base", "tiny", "ellipse"}) {
    auto config = load_config(name);
    config.composite_every_sample = 1;
    for (const auto projection : kProjections) {
      for (const auto opacity : {scene::SlabOpacity::Exponential, scene::SlabOpacity::Additive}) {
        auto description = row_from_the_left();
        description.method = scene::Method::Westover;
        description.slab_opacity = opacity;
        description.camera.projection = projection;
        compare_with_oracle(std::string(name) + ", every sample", row_of(12, description), config, figures);
      }
    }
  }
  print_and_expect_equal(figures);
}

// N-8-59, N-8-60: a flat kernel in coarse sheets shows words longer than they are: the surplus is taken from the splats
// behind.
TEST(DriverOracle, SurplusEnergyIsCarried) {
  OracleFigures figures;
  for (const auto& name : config_names()) {
    auto config = load_config(name);
    config.sheet_frac_bits = std::max(4, config.colour_frac_bits - 3);
    auto description = row_from_the_left();
    description.method = scene::Method::XRay;
    description.kernel = "";
    description.kernel_a = 0.1;
    description.kernel_radius = 1.0;
    for (const double words : {0.7, 2.3, 5.1, 9.9, 40.0}) {
      description.xray_exposure = std::ldexp(words, -config.colour_frac_bits);
      compare_with_oracle(name, row_of(12, description), config, figures);
    }
  }
  print_and_expect_equal(figures);
  EXPECT_GT(figures.met.carried_words, 100U);
}

// N-8-26: the largest radius that the RLUT holds, to the last double of the zoom.
TEST(DriverOracle, TheSameRadiusIsTheFirstRefused) {
  OracleFigures figures;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    auto description = row_from_the_left();
    const auto zoomed = [&](double zoom) {
      description.camera.zoom = zoom;
      return row_of(2, description);
    };
    const auto [below, above] = change(0.1, 1e3, [&](double zoom) {
      const auto given = scene_oracle::given_by(zoomed(zoom), config);
      return given.R * given.u * given.scale_at_corner[0] > config.rlut_columns / 2.0;
    });
    compare_with_oracle(name, zoomed(below), config, figures);
    compare_with_oracle(name, zoomed(above), config, figures);
  }
  print_and_expect_equal(figures);
  EXPECT_EQ(figures.frames, config_names().size());
  EXPECT_EQ(figures.refused, config_names().size());
}

// N-8-27: radii within 10^-9 of each other are one set: the turn of a row, in perspective, at which they become two.
TEST(DriverOracle, TheSameRatioOfRadiiIsTheFirstWithSeveralSets) {
  OracleFigures figures;
  const std::vector<std::string> names = {"base", "year2000"};
  for (const auto& name : names) {
    const auto config = load_config(name);
    auto description = row_from_the_left();
    description.camera.projection = scene::Projection::Perspective;
    const auto turned = [&](double azimuth) {
      description.camera.azimuth = azimuth;
      return row_of(2, description);
    };
    const auto [below, above] = change(0.0, 1.0, [&](double azimuth) {
      return scene_oracle::compile(scene_oracle::given_by(turned(azimuth), config)).met.several_sets > 0;
    });
    compare_with_oracle(name, turned(below), config, figures);
    compare_with_oracle(name, turned(above), config, figures);
  }
  print_and_expect_equal(figures);
  EXPECT_EQ(figures.met.several_sets, names.size());
}

/// Splat records of the whole frame.
std::vector<cmodel::SplatRecord> splats_of(const CompiledFrame& compiled) {
  std::vector<cmodel::SplatRecord> splats;
  for (int tile = 0; tile < compiled.grid().count(); ++tile)
    compiled.emit_tile(tile, [&](std::span<const cmodel::Beat> beats) {
      for (const auto& beat : beats)
        if (cmodel::get(beat, cmodel::layout::kOpcode) == static_cast<int>(cmodel::Opcode::Splat))
          splats.push_back(cmodel::to_splat(beat));
    });
  return splats;
}

// N-8-37, N-8-38, N-8-67, without the oracle: thin slices of a splat beyond U 4.cf sum to its largest word, and one
// record has that of U 0.cf.
TEST(DriverOracle, TheEndsOfTheFormatsAreTheirLargestWords) {
  int compared = 0;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    auto description = row_from_the_left();
    description.opacity_scale = 1e4;
    if (config.slice_phase_bits >= 6) {
      description.slab_width = 0.05;  // 1/25 of the kernel at most: no share reaches U 0.cf's end
      const CompiledFrame sliced(row_of(1, description), config);
      std::array<std::uint64_t, 4> sum{};
      for (const auto& splat : splats_of(sliced))
        for (std::size_t c = 0; c < 4; ++c) sum[c] += splat.colour[c];
      const std::uint64_t largest = (std::uint64_t{1} << (config.colour_frac_bits + 4)) - 1;
      EXPECT_EQ(sum, (std::array{largest, largest, largest, largest})) << name;
      EXPECT_EQ(sliced.report().saturated_voxels, 1U) << name;
      compared += 4;
    }
    description.method = scene::Method::AxisAligned;
    const auto whole = splats_of(CompiledFrame(row_of(1, description), config));
    ASSERT_EQ(whole.size(), 1U) << name;
    for (const std::uint32_t word : whole[0].colour)
      EXPECT_EQ(word, (std::uint32_t{1} << config.colour_frac_bits) - 1) << name;
    description.opacity_scale = 1e-6;
    const CompiledFrame nothing(row_of(1, description), config);
    EXPECT_EQ(splats_of(nothing).size(), 0U) << name;
    EXPECT_EQ(nothing.report().vanished_voxels, 1U) << name;
    compared += 5;
  }
  figure("ends compared", compared);
  EXPECT_GT(compared, 50);
}

// N-8-72: the stream that render and record_stream make from a frame's beats, with its end and checksum.
TEST(DriverOracle, ARecordedStreamIsTheWholePage) {
  std::uint64_t compared = 0;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    const auto scene = row_of(3, row_from_the_left());
    const auto frame = scene_oracle::compile(scene_oracle::given_by(scene, config));
    std::vector<scene_oracle::Beat> expected = frame.preamble;
    for (const auto& tile : frame.tiles) expected.insert(expected.end(), tile.begin(), tile.end());
    expected.push_back(scene_oracle::end_frame(frame));
    const auto path =
        std::filesystem::path(::testing::TempDir()) / ("oracle_" + std::to_string(::getpid()) + name + ".fss");
    record_stream(scene, config, path);
    std::vector<cmodel::Beat> got;
    read_beats(path, [&](std::span<const cmodel::Beat> beats) { got.insert(got.end(), beats.begin(), beats.end()); });
    std::filesystem::remove(path);
    EXPECT_EQ(got, expected) << name;
    compared += expected.size();
  }
  figure("recorded beats compared", static_cast<double>(compared));
  EXPECT_GT(compared, 0U);
}

}  // namespace
}  // namespace fastsplat::driver
