// SPDX-License-Identifier: Apache-2.0
// 3-D Gaussians on the device: its picture against golden's, the words that matter, its records against their rules,
// its stream against the oracle.
#include "golden/gaussians.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>

#include "base/error.hpp"
#include "cmodel/splat/ellipse_unit.hpp"
#include "driver/config/config_file.hpp"
#include "driver/files/stream_file.hpp"
#include "driver/splats/ellipse_shape.hpp"
#include "driver/tables/quantise.hpp"
#include "driver/tiles/gaussian_frame.hpp"
#include "driver/tiles/gaussian_windows.hpp"
#include "driver/tiles/render.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/cmodel/compare_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

using scene::GaussianCloud;

/// The defaults of `render --gaussians`.
cmodel::Config usual_config() {
  cmodel::Config config = load_config("ellipse");
  config.composite_every_sample = 1;
  config.freeze_below = 7;  // 1e-4 of 2^16, rounded up
  return config;
}

scene::GaussianScene scene_of(const std::string& name, int width, int height, double zoom = 1.0,
                              scene::Projection projection = scene::Projection::Perspective) {
  scene::GaussianDescription description;
  description.camera.projection = projection;
  description.camera.zoom = zoom;
  description.width = width, description.height = height;
  description.up = scene::UpAxis::Z;
  return scene::build_gaussian_scene(description,
                                     std::make_shared<GaussianCloud>(scene::make_synthetic_gaussians(name)));
}

struct Seen {
  GaussianRender device;
  Lsb8 apart;
};

Seen seen(const scene::GaussianScene& scene, const cmodel::Config& config) {
  const auto projected = scene::project_all(scene);
  GaussianRender device = render_gaussians({scene, projected, config});
  const Lsb8 apart = distance(golden::render_gaussians(scene, projected), to_image(device.frame));
  return {std::move(device), apart};
}

// N-6-1, N-8-84: integer bits keep colours above 1, to within the errors of scenes without any.
TEST(Gaussians, IntegerBitsKeepColoursAbove1) {
  GaussianCloud cloud = scene::make_synthetic_gaussians("shells:2000");
  for (glm::vec3& harmonic : cloud.harmonics) harmonic *= 1.6F;
  scene::GaussianDescription description;
  description.width = 160, description.height = 120;
  description.up = scene::UpAxis::Z;
  const auto scene = scene::build_gaussian_scene(description, std::make_shared<GaussianCloud>(std::move(cloud)));
  std::vector<double> psnr;
  for (const int bits : {0, 1, 2}) {
    cmodel::Config config = usual_config();
    config.colour_int_bits = bits, config.colour_frac_bits = 16 - bits, config.pixel_int_bits = std::max(1, bits);
    config.sheet_int_bits = std::max(2, bits + config.radial_int_bits);
    ASSERT_FALSE(cmodel::first_violation(config));
    const auto [device, apart] = seen(scene, config);
    psnr.push_back(apart.psnr_db);
    std::printf("[figure] colour.int_bits %d: %.1f dB, largest %.1f LSB8, clamped %llu, brightest %.2f\n", bits,
                apart.psnr_db, apart.largest, static_cast<unsigned long long>(device.report.saturated),
                device.report.brightest);
    EXPECT_EQ(device.report.saturated > 0, bits == 0);
    EXPECT_GT(device.report.brightest, 1.0);
    EXPECT_LT(device.report.brightest, 2.0);
  }
  EXPECT_LT(psnr[0], 60.0);
  EXPECT_GT(psnr[1], 65.0);
  EXPECT_GT(psnr[2], 65.0);
}

/// shells:60, whose first Gaussian is a needle of this length along (1, 1, 1), a thousandth as thick.
scene::GaussianScene with_needle(float length) {
  GaussianCloud cloud = scene::make_synthetic_gaussians("shells:60");
  cloud.gaussians[0].scale = {length, 1e-3F, 1e-3F};
  cloud.gaussians[0].rotation = {0.88047F, 0.0F, -0.27985F, 0.36470F};
  scene::GaussianDescription description;
  description.width = 60, description.height = 50;
  description.up = scene::UpAxis::Z;
  return scene::build_gaussian_scene(description, std::make_shared<GaussianCloud>(std::move(cloud)));
}

// N-8-48: 4 A C >= B^2 however long a Gaussian is; what words or doubles cannot hold is counted, never lost unseen.
TEST(Gaussians, NeedlesAreDrawnOrCounted) {
  const auto config = usual_config();
  std::size_t thin = 0, degenerate = 0, sound = 0, negative = 0;
  for (float length = 1.0F; length < 1e12F; length *= 3.0F) {
    const auto scene = with_needle(length);
    scene::ProjectionReport report;
    const auto projected = scene::project_all(scene, &report);
    EXPECT_EQ(projected.size() + report.degenerate + report.outside, 60U);
    degenerate += report.degenerate;
    for (const auto& one : projected) {
      const double rim = scene.description.cutoff * scene.description.cutoff;
      const auto words = ellipse_words(config, {rim * one.shape.xx, rim * one.shape.xy, rim * one.shape.yy});
      negative += 4 * std::int64_t{words.a} * words.c < std::int64_t{words.b} * words.b ? 1 : 0;
    }
    const Seen here = seen(scene, config);
    thin += here.device.report.thin;
    sound += here.device.report.thin + report.degenerate == 0 && here.apart.largest < 3.0 ? 1 : 0;
    EXPECT_TRUE(here.apart.largest < 3.0 || here.device.report.thin > 0) << length << ": " << here.apart.largest;
  }
  figure("needles drawn well", static_cast<double>(sound), "(limit > 0)");
  figure("needles too thin for words", static_cast<double>(thin), "(limit > 0)");
  figure("needles too thin for doubles", static_cast<double>(degenerate), "(limit > 0)");
  figure("words with 4 A C < B^2", static_cast<double>(negative), "(limit 0)");
  EXPECT_GT(sound, 0U);
  EXPECT_GT(thin, 0U);
  EXPECT_GT(degenerate, 0U);
  EXPECT_EQ(negative, 0U);
}

// N-8-83: RADIAL.
TEST(Gaussians, AreWithin70dBOfGolden) {
  const auto config = usual_config();
  for (const auto& [name, zoom, projection] : {std::tuple{"shells:2000", 1.0, scene::Projection::Perspective},
                                               std::tuple{"shells:2000", 2.0, scene::Projection::Orthographic},
                                               std::tuple{"cloud:500", 1.0, scene::Projection::Perspective},
                                               std::tuple{"cloud:3000", 1.5, scene::Projection::Orthographic}}) {
    const auto scene = scene_of(name, 300, 200, zoom, projection);
    const Seen here = seen(scene, config);
    const std::string what = std::string(name) + ", zoom " + std::to_string(zoom).substr(0, 3);
    figure(what + ": PSNR", here.apart.psnr_db, "dB");
    figure(what + ": max", here.apart.largest, "LSB8");
    EXPECT_GE(here.apart.psnr_db, 70.0) << what;
    EXPECT_EQ(here.device.report.saturated, 0U);
    EXPECT_EQ(here.device.report.cut, 0U);
    EXPECT_EQ(here.device.report.vanished, 0U);
    EXPECT_EQ(here.device.report.drawn, scene::project_all(scene).size());
    EXPECT_EQ(here.device.counters.splats, here.device.report.records);
    EXPECT_GT(here.device.counters.lanes_weighted, 100000U);
    EXPECT_EQ(here.device.counters.composite_saturated + here.device.counters.opacity_saturated, 0U);
  }
}

// base's own words with ellipses of every sample: positions of 6 bits, frozen below 64. Words of shapes are made
// without a limit; shapes that exceed it are refused.
TEST(Gaussians, FootprintsTooSmallForTheWordsAreRefused) {
  cmodel::Config config = usual_config();
  config.rlut_guard_bits = 12;
  config.position_frac_bits = 3;
  config.phases = 8;
  const auto violation = cmodel::first_violation(config);
  ASSERT_FALSE(violation) << one_line(*violation);
  // 2^(10 + 12 - 6) steps per square pixel, and words below 2^22.
  const double least = std::ldexp(1.0, -6);
  auto scene = scene_of("cloud:50", 64, 64);
  scene.description.cutoff = 1.0;
  scene.description.low_pass = 1.01 * least;
  EXPECT_GT(render_gaussians({scene, scene::project_all(scene), config}).counters.splats, 0U);
  scene.description.low_pass = 0.99 * least;
  try {
    render_gaussians({scene, scene::project_all(scene), config});
    ADD_FAILURE() << "drawn";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Usage);
    EXPECT_NE(std::string(error.what()).find("0.01562"), std::string::npos) << error.what();
    std::printf("[figure] %s\n", error.what());
  }
}

TEST(Gaussians, BasesWordsAreAbove50dB) {
  auto config = load_config("base");
  config.ellipse_frac_bits = 11;
  config.composite_every_sample = 1;
  for (const int freeze : {64, 7}) {
    config.freeze_below = freeze;
    const Seen here = seen(scene_of("shells:2000", 256, 256), config);
    figure("base's words, freeze_below " + std::to_string(freeze), here.apart.psnr_db, "dB");
    EXPECT_GE(here.apart.psnr_db, 50.0);
  }
}

// The words that matter: each is shortened alone until it shows.
TEST(Gaussians, WordsThatMatter) {
  const auto scene = scene_of("cloud:500", 256, 256);
  const auto projected = scene::project_all(scene);
  const Image golden = golden::render_gaussians(scene, projected);
  const auto with = [&](const std::vector<std::pair<const char*, int>>& changes) {
    auto config = usual_config();
    for (const auto& [key, value] : changes) {
      const auto wrong = cmodel::set(config, key, std::to_string(value));
      EXPECT_FALSE(wrong) << key;
    }
    const auto violation = cmodel::first_violation(config);
    EXPECT_FALSE(violation) << (violation ? one_line(*violation) : "");
    return distance(golden, to_image(render_gaussians({scene, projected, config}).frame)).psnr_db;
  };
  const double whole = with({});
  figure("as it is", whole, "dB");
  std::map<std::string, double> found;
  const auto one = [&](const char* key, int value) {
    const double psnr = with({{key, value}});
    figure(std::string(key) + " = " + std::to_string(value), psnr, "dB");
    found[std::string(key) + "=" + std::to_string(value)] = psnr;
  };
  for (const int bits : {2, 4, 6}) {  // phases, which ellipses do not use, are no finer than positions
    found["position.frac_bits=" + std::to_string(bits)] =
        with({{"position.frac_bits", bits}, {"snap.phases", 1 << bits}});
    figure("position.frac_bits = " + std::to_string(bits), found["position.frac_bits=" + std::to_string(bits)], "dB");
  }
  for (const int entries : {64, 256, 2048, 4096}) one("radial.entries", entries);
  for (const int bits : {8, 10, 12}) one("radial.frac_bits", bits);
  for (const int bits : {8, 10, 12}) one("colour.frac_bits", bits);
  for (const int bits : {8, 10, 12}) one("sheet.frac_bits", bits);
  for (const int bits : {2, 5, 8}) one("ellipse.frac_bits", bits);
  for (const int freeze : {64, 655, 3277}) one("composite.freeze_below", freeze);
  for (const int bits : {8, 10, 12}) {
    const int below = std::max(1, static_cast<int>(std::ceil(1e-4 * (1 << bits))));
    const double psnr = with({{"composite.frac_bits", bits}, {"composite.freeze_below", below}});
    figure("composite.frac_bits = " + std::to_string(bits), psnr, "dB");
    found["composite.frac_bits=" + std::to_string(bits)] = psnr;
  }
  // The table's steps remain; twice the entries, 6 dB.
  EXPECT_GT(found["radial.entries=4096"], whole + 3.0);
  EXPECT_LT(found["radial.entries=64"], whole - 15.0);
  EXPECT_LT(found["composite.frac_bits=8"], whole - 15.0);
  EXPECT_LT(found["sheet.frac_bits=8"], whole - 10.0);
  EXPECT_LT(found["position.frac_bits=2"], whole - 10.0);
}

// N-8-86: the windows of a tile hold every pixel with a weight exactly once, for every shape, place and tile.
TEST(Gaussians, WindowsHoldEveryWeightedPixelOnce) {
  auto config = usual_config();
  config.tile_width = 64, config.tile_height = 48;
  ASSERT_FALSE(cmodel::first_violation(config));
  test::Random random(test::seed_or(63));
  const auto real = [&random](double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(random.next() >> 11U), -53);
  };
  const cmodel::EllipseUnit unit(config);
  std::uint64_t weighted = 0, windows = 0, missed = 0, twice = 0, none = 0;
  for (int round = 0; round < 3000; ++round) {
    const double longer = std::exp(real(0.5, 6.0)), shorter = std::max(1.6, longer * real(0.01, 1.0)),
                 angle = real(0.0, 3.1416), c = std::cos(angle), s = std::sin(angle), l = longer * longer,
                 m = shorter * shorter;
    const auto shape = ellipse_words(config, {c * c * l + s * s * m, c * s * (l - m), s * s * l + c * c * m});
    const auto x = static_cast<std::int32_t>(256.0 * real(-longer, 64.0 + longer));
    const auto y = static_cast<std::int32_t>(256.0 * real(-longer, 48.0 + longer));
    if (std::abs(x) > 256 * 400 || std::abs(y) > 256 * 400) continue;
    std::vector<int> covered(64 * 48, 0);
    const auto all = gaussian_windows(config, shape, x, y, 64, 48);
    none += all.empty() ? 1 : 0;
    for (const auto& window : all) {
      windows += window.columns * window.rows;
      const int x0 = (x >> 8) + window.left, y0 = (y >> 8) + window.top;
      for (int j = 0; j < static_cast<int>(window.rows) * 8; ++j)
        for (int i = 0; i < static_cast<int>(window.columns) * 8; ++i)
          if (x0 + i >= 0 && x0 + i < 64 && y0 + j >= 0 && y0 + j < 48)
            ++covered[static_cast<std::size_t>((y0 + j) * 64 + x0 + i)];
    }
    for (int py = 0; py < 48; ++py) {
      for (int px = 0; px < 64; ++px) {
        const std::int64_t q = cmodel::exact_q(shape, px * 256 - x, py * 256 - y) >> shape.shift;
        const int count = covered[static_cast<std::size_t>(py * 64 + px)];
        if (q < config.rlut_rim()) {
          ++weighted;
          missed += count == 0 ? 1 : 0;
          twice += count > 1 ? 1 : 0;
        }
      }
    }
  }
  figure("weighted pixels", static_cast<double>(weighted));
  figure("windows", static_cast<double>(windows));
  figure("footprints beside the tile", static_cast<double>(none));
  EXPECT_GT(weighted, 500000U);
  EXPECT_GT(none, 20U);
  EXPECT_EQ(missed, 0U);
  EXPECT_EQ(twice, 0U);
}

// A whole recorded stream: the reader accepts it by every rule. The oracle, written from the documents alone, has the
// words, taps and counters of the model.
TEST(Gaussians, ModelEqualsOracle) {
  test::Comparison total;
  for (const auto& [name, width, height, zoom] :
       {std::tuple{"shells:150", 70, 41, 1.0}, std::tuple{"cloud:200", 150, 60, 1.0},
        std::tuple{"cloud:120", 40, 140, 2.5}}) {
    for (const int lanes : {8, 4}) {
      auto config = usual_config();
      config.lanes = lanes;
      if (lanes == 4) config.tile_width = config.tile_height = 32;
      ASSERT_FALSE(cmodel::first_violation(config));
      const auto scene = scene_of(name, width, height, zoom);
      const GaussianFrame frame(scene, scene::project_all(scene), config);
      const auto path = std::filesystem::temp_directory_path() / ("gaussians-" + std::to_string(::getpid()) + ".fss");
      const GaussianReport report = record_stream(frame, path);
      std::vector<std::uint8_t> bytes(std::filesystem::file_size(path));
      std::ifstream(path, std::ios::binary)
          .read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      const DeviceRender replayed = replay_stream(path, config);
      std::filesystem::remove(path);
      EXPECT_EQ(replayed.counters.splats, report.records);
      EXPECT_EQ(difference(replayed.frame, render_gaussians(frame, {.threads = 2}).frame).different, 0U);
      total += test::compare(test::run_model(config, bytes), oracle::render(test::symbols_of(config), bytes));
    }
  }
  test::print("3-D Gaussians", total);
  EXPECT_EQ(total.mismatches, 0U) << total.first;
  EXPECT_GT(total.total(), 500000U);
}

// The recording holds no more of the stream than one block and a Gaussian's records, however long the stream is. The
// file is the frame's beats and its end_frame.
TEST(Gaussians, RecordingsAreTheBeatsAndAreWrittenInBlocks) {
  constexpr std::size_t kBlock = 4096, kMostOfOne = 512;
  const auto path = std::filesystem::temp_directory_path() / ("recorded-" + std::to_string(::getpid()) + ".fss");
  for (const char* name : {"outdoor:300", "outdoor:30000"}) {
    scene::GaussianDescription description;
    description.width = 400, description.height = 200;
    description.up = scene::UpAxis::Z;
    description.placed = scene::PlacedCamera{.eye = {0.0, -5.5, 1.5}};
    const auto scene = scene::build_gaussian_scene(
        description, std::make_shared<GaussianCloud>(scene::make_synthetic_gaussians(name)));
    const GaussianFrame frame(scene, scene::project_all(scene), usual_config());
    std::vector<cmodel::Beat> beats;
    std::size_t longest = 0, steps = 0;
    const GaussianReport report = frame.emit(
        [&](std::span<const cmodel::Beat> some) {
          beats.insert(beats.end(), some.begin(), some.end());
          longest = std::max(longest, some.size());
        },
        [&](std::size_t done, std::size_t total) {
          EXPECT_EQ(done, ++steps);
          EXPECT_EQ(total, static_cast<std::size_t>(frame.grid().count()));
        });
    EXPECT_EQ(steps, report.tiles);
    EXPECT_LE(longest, kBlock + kMostOfOne);
    EXPECT_EQ(record_stream(frame, path).records, report.records);
    std::vector<cmodel::Beat> recorded;
    read_beats(path,
               [&](std::span<const cmodel::Beat> some) { recorded.insert(recorded.end(), some.begin(), some.end()); });
    std::filesystem::remove(path);
    figure("beats of " + std::string(name), static_cast<double>(recorded.size()));
    ASSERT_EQ(recorded.size(), beats.size() + 1);
    EXPECT_TRUE(std::equal(beats.begin(), beats.end(), recorded.begin()));
    const auto end = std::get<cmodel::EndFrame>(cmodel::from_beat(recorded.back()));
    EXPECT_EQ(end.beats, beats.size());
  }
}

// A device with short positions: a record's centre fits S pi.pf in every tile that it is drawn in. In the farthest such
// tile it is the last pixel but one of the range (N-8-85).
TEST(Gaussians, CentresOfRecordsFitThePositionFormat) {
  auto config = usual_config();
  config.position_int_bits = 10;  // pixels -512..511
  ASSERT_FALSE(cmodel::first_violation(config));
  const auto scene = scene_of("cloud:3", 1000, 64);
  auto splat = scene::project_all(scene).front();
  splat.shape = {.xx = 1e6, .xy = 0.0, .yy = 1e6};  // all of the picture lies in it
  const double steps = std::ldexp(1.0, config.position_frac_bits);
  int farthest_right = -1, farthest_left = -1;
  std::uint64_t records = 0;
  for (int centre = 370; centre <= 530; ++centre) {
    splat.x = centre + 0.25, splat.y = 30.5;
    const GaussianFrame frame(scene, {splat}, config);
    for (int tile = 0; tile < frame.grid().count(); ++tile) {
      const int left = frame.grid().x(tile);
      const std::uint64_t before = records;
      frame.emit_tile(tile, [&](std::span<const cmodel::Beat> beats) {
        for (const cmodel::Beat& beat : beats) {
          const cmodel::Record record = cmodel::from_beat(beat);
          const auto* const ellipse = std::get_if<cmodel::EllipseRecord>(&record);
          if (ellipse == nullptr) continue;
          ++records;
          EXPECT_EQ(ellipse->x, std::lround((splat.x - left) * steps)) << "centre " << centre << ", tile " << tile;
          EXPECT_LT(ellipse->x, std::lround(512.0 * steps));
        }
      });
      if (records == before) continue;
      if (left <= centre) farthest_right = std::max(farthest_right, centre - left);
      if (left > centre) farthest_left = std::max(farthest_left, left - centre);
    }
  }
  // L = 2^9 - 1 - 128 = 383. Pixels within -L .. L-1 of the centre's pixel are drawn: a tile's last pixel, 127, is L
  // before a centre in pixel 510, and its first L - 1 behind one in pixel -382.
  figure("records", static_cast<double>(records));
  figure("farthest centre from a tile's first pixel, to the right", farthest_right);
  figure("farthest centre from a tile's first pixel, to the left", farthest_left);
  EXPECT_EQ(farthest_right, 510);
  EXPECT_EQ(farthest_left, 382);
  EXPECT_EQ(gaussian_reach(config), 383);
  config.position_int_bits = 12;
  EXPECT_EQ(gaussian_reach(config), 510 - 8) << "what a record's windows have room for";
}

// N-8-86, N-8-87: a footprint over all of a tile of 384 pixels: each row of windows is 32 and then 16 of them.
TEST(Gaussians, LongRowsAreCutInto32WindowsAtATime) {
  auto config = usual_config();
  config.tile_width = 384;
  ASSERT_FALSE(cmodel::first_violation(config));
  const auto shape = ellipse_words(config, {1e6, 0.0, 1e6});
  const auto all = gaussian_windows(config, shape, 192 * 256, 24 * 256, 384, 48);
  figure("records of six rows", static_cast<double>(all.size()));
  ASSERT_EQ(all.size(), 12U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool first = i % 2 == 0;
    EXPECT_EQ(all[i].left, first ? -192 : -192 + 256);
    EXPECT_EQ(all[i].top, -24 + 8 * static_cast<int>(i / 2));
    EXPECT_EQ(all[i].columns, first ? 32U : 16U);
    EXPECT_EQ(all[i].rows, 1U);
  }
}

// The device's work in its own unit, windows: one begins in each cycle, unless it waits for a pixel.
TEST(Gaussians, WindowsEqualTheRecords) {
  const auto config = usual_config();
  const cmodel::EllipseUnit unit(config);
  for (const char* name : {"shells:2000", "cloud:3000"}) {
    const auto scene = scene_of(name, 256, 256);
    const GaussianFrame frame(scene, scene::project_all(scene), config);
    std::uint64_t windows = 0, empty = 0;
    const auto count = [&](const cmodel::EllipseRecord& record) {
      const auto x = cmodel::ellipse_axis(config, record.x, record.windows.left);
      const auto y = cmodel::ellipse_axis(config, record.y, record.windows.top);
      const auto f = unit.coefficients(record.shape, x.distance, y.distance);
      for (std::uint32_t row = 0; row < record.windows.rows * 8; row += 8) {
        for (std::uint32_t column = 0; column < record.windows.columns * 8; column += 8, ++windows) {
          bool weighted = false;
          for (std::uint32_t lane = 0; lane < 64; ++lane)
            weighted = weighted || unit.index(f, column + lane % 8, row + lane / 8) < 1024;
          empty += weighted ? 0 : 1;
        }
      }
    };
    for (int tile = 0; tile < frame.grid().count(); ++tile) {
      frame.emit_tile(tile, [&](std::span<const cmodel::Beat> beats) {
        for (const cmodel::Beat& beat : beats) {
          const cmodel::Record record = cmodel::from_beat(beat);
          if (const auto* ellipse = std::get_if<cmodel::EllipseRecord>(&record)) count(*ellipse);
        }
      });
    }
    const GaussianRender device = render_gaussians(frame);
    EXPECT_EQ(device.counters.windows, windows);
    const double all = static_cast<double>(windows);
    figure(std::string(name) + ": windows a Gaussian and tile", all / static_cast<double>(device.report.in_tiles));
    figure(std::string(name) + ": windows without a weight", 100.0 * static_cast<double>(empty) / all, "%");
    figure(std::string(name) + ": lanes used",
           100.0 * static_cast<double>(device.counters.lanes_weighted) / (64.0 * all), "%");
    EXPECT_LT(static_cast<double>(empty), 0.002 * all);
  }
}

// The message of each unit; their words on more scenes are in fast_unit_slow_test.cpp.
TEST(Gaussians, BothUnitsDrawAndCountTheSame) {
  const auto scene = scene_of("shells:300", 150, 100);
  const GaussianFrame frame(scene, scene::project_all(scene), usual_config());
  const GaussianRender fast = render_gaussians(frame), plain = render_gaussians(frame, {.unit = Unit::Plain});
  const std::uint64_t tiles = static_cast<std::uint64_t>(frame.grid().count());
  EXPECT_EQ(fast.units.fast, tiles);
  EXPECT_EQ(plain.units.plain, tiles);
  EXPECT_EQ(fast.frame.words, plain.frame.words);
  EXPECT_EQ(fast.counters, plain.counters);
  figure("records", static_cast<double>(plain.report.records));
  EXPECT_GT(plain.report.records, 300U);
  for (const GaussianRender& one : {fast, plain}) {
    EXPECT_EQ(one.counters.splats, one.report.records);
    EXPECT_EQ(one.counters.tiles, tiles);
  }
}

// More Gaussians than a part of a thread's work has; some vanish, so that those behind them move up.
TEST(Gaussians, ThreadsNeverChangeTheStream) {
  auto cloud = scene::make_synthetic_gaussians("cloud:20000");
  for (std::size_t i = 0; i < cloud.gaussians.size(); i += 7) cloud.gaussians[i].opacity = 1e-7F;
  scene::GaussianDescription description;
  description.width = 200, description.height = 150;
  const auto scene = scene::build_gaussian_scene(description, std::make_shared<GaussianCloud>(std::move(cloud)));
  const auto projected = scene::project_all(scene);
  const auto stream = [&](int threads) {
    std::vector<cmodel::Beat> beats;
    const GaussianFrame frame(scene, projected, usual_config(), threads);
    frame.emit([&](std::span<const cmodel::Beat> more) { beats.insert(beats.end(), more.begin(), more.end()); });
    EXPECT_GT(frame.report().vanished, 2000U);
    EXPECT_EQ(frame.report().drawn + frame.report().vanished, projected.size());
    return beats;
  };
  const auto one = stream(1);
  for (const int threads : {2, 3, 8}) EXPECT_TRUE(stream(threads) == one) << threads << " threads";
  figure("beats", static_cast<double>(one.size()));
  EXPECT_GT(one.size(), 20000U);
}

// Against windows of every Gaussian in every tile: none is missing where a tile begins or ends.
TEST(Gaussians, EveryTileHasTheGaussiansThatMeetIt) {
  auto config = usual_config();
  config.tile_width = 32, config.tile_height = 16;
  const auto scene = scene_of("shells:2000", 300, 200);
  const auto projected = scene::project_all(scene);
  const GaussianFrame frame(scene, projected, config);
  const Target place = target(Site::EllipseCentre, config);
  const double rim = scene.description.cutoff * scene.description.cutoff;
  const int pixel = 1 << config.position_frac_bits;
  std::uint64_t records = 0;
  for (int tile = 0; tile < frame.grid().count(); ++tile) {
    const TileGrid& grid = frame.grid();
    GaussianReport expected;
    for (const scene::ProjectedGaussian& splat : projected) {
      const auto& shape = splat.shape;
      const auto windows = gaussian_windows(
          config, ellipse_words(config, {rim * shape.xx, rim * shape.xy, rim * shape.yy}),
          quantise_to<std::int32_t>(splat.x, place) - grid.x(tile) * pixel,
          quantise_to<std::int32_t>(splat.y, place) - grid.y(tile) * pixel, grid.width(tile), grid.height(tile));
      expected.records += windows.size();
      expected.in_tiles += windows.empty() ? 0 : 1;
    }
    const GaussianReport found = frame.emit_tile(tile, [](std::span<const cmodel::Beat>) {});
    EXPECT_EQ(found.records, expected.records) << "tile " << tile;
    EXPECT_EQ(found.in_tiles, expected.in_tiles) << "tile " << tile;
    records += expected.records;
  }
  figure("records, tile by tile", static_cast<double>(records));
  EXPECT_GT(records, 2000U);
}

// A picture equals that of smaller tiles, except for the rounding of six coefficients at another first pixel.
TEST(Gaussians, TilesHardlyShow) {
  auto config = usual_config();
  const auto scene = scene_of("shells:400", 200, 150);
  const auto projected = scene::project_all(scene);
  const Image large = to_image(render_gaussians({scene, projected, config}).frame);
  config.tile_width = 64, config.tile_height = 32;
  const Image small = to_image(render_gaussians({scene, projected, config}).frame);
  const Lsb8 apart = distance(large, small);
  figure("tiles of 128 x 128 against 64 x 32", apart.psnr_db, "dB");
  figure("largest", apart.largest, "LSB8");
  EXPECT_GE(apart.psnr_db, 85.0);
}

// N-8-83: the requirements.
TEST(Gaussians, ShapesThatDoNotFitAreCountedOrRefused) {
  const auto config = usual_config();
  for (const char* other : {"base", "ellipse"}) {
    try {
      const auto scene = scene_of("cloud:5", 32, 32);
      GaussianFrame(scene, scene::project_all(scene), load_config(other));
      ADD_FAILURE() << other;
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      EXPECT_EQ(error.parts().fix, "leave --config out, or use --config ellipse --set composite.every_sample=1");
    }
  }
  // One that fills a picture larger than a record's reach, one too bright, one too thin.
  GaussianCloud cloud = scene::make_synthetic_gaussians("cloud:3");
  for (auto& one : cloud.gaussians) one.position = glm::vec3(0.0F), one.scale = glm::vec3(0.1F);
  cloud.gaussians[0].scale = glm::vec3(5.0F);
  cloud.harmonics[4] = glm::vec3(9.0F), cloud.gaussians[1].opacity = 0.9F;
  cloud.gaussians[2].opacity = 1e-6F;
  auto scene = scene_of("cloud:3", 1400, 64);
  scene.description.camera.zoom = 1.0;
  scene.cloud = std::make_shared<GaussianCloud>(cloud);
  const auto projected = scene::project_all(scene);
  const GaussianRender device = render_gaussians({scene, projected, config});
  EXPECT_EQ(device.report.cut, 1U);
  EXPECT_EQ(device.report.saturated, 1U);
  EXPECT_EQ(device.report.vanished, 1U);
  EXPECT_EQ(device.report.drawn, 2U);
  EXPECT_GT(device.counters.windows, 0U);
}

}  // namespace
}  // namespace fastsplat::driver
