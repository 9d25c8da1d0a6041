// SPDX-License-Identifier: Apache-2.0
#include "tests/driver/oracle_helper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "base/error.hpp"
#include "cmodel/stream/stream_layout.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::driver {
namespace {

using D = scene::SceneDescription;
using scene_oracle::Beat;

/// A method of the device with its settings.
struct OracleMethod {
  const char* name;
  void (*apply)(scene::SceneDescription&);
};
constexpr OracleMethod kMethods[] = {
    {"image 0.3", [](D& d) { d.slab_width = 0.3; }},
    {"image 0.5", [](D& d) { d.slab_width = 0.5; }},
    {"image 1", [](D&) {}},
    {"image 2", [](D& d) { d.slab_width = 2.0; }},
    {"image 3.7", [](D& d) { d.slab_width = 3.7; }},
    {"image additive 0.7", [](D& d) { d.slab_width = 0.7, d.slab_opacity = scene::SlabOpacity::Additive; }},
    {"axis", [](D& d) { d.method = scene::Method::AxisAligned; }},
    {"axis additive",
     [](D& d) { d.method = scene::Method::AxisAligned, d.slab_opacity = scene::SlabOpacity::Additive; }},
    {"xray", [](D& d) { d.method = scene::Method::XRay; }},
    {"xray exposed", [](D& d) { d.method = scene::Method::XRay, d.xray_exposure = 0.37; }},
    {"xray 7", [](D& d) { d.method = scene::Method::XRay, d.xray_sheets = 7, d.slab_width = 0.9; }},
    {"xray 2 exposed", [](D& d) { d.method = scene::Method::XRay, d.xray_sheets = 2, d.xray_exposure = 5.0; }},
};

double real(test::Random& random, double low, double high) {
  return low + (high - low) * std::ldexp(static_cast<double>(random.next() >> 11), -53);
}

/// With equal ratios equally likely.
double ratio(test::Random& random, double low, double high) {
  return low * std::pow(high / low, real(random, 0.0, 1.0));
}

std::shared_ptr<const volume::Volume> random_volume(test::Random& random) {
  glm::ivec3 dims;
  glm::dvec3 spacing(1.0);
  const bool cubic = random.once_in(3);
  for (int axis = 0; axis < 3; ++axis) {
    dims[axis] = random.once_in(5) ? 1 : static_cast<int>(random.between(2, 6));
    if (!cubic) spacing[axis] = real(random, 0.4, 2.5);
  }
  std::vector<float> voxels;
  for (int i = 0; i < dims.x * dims.y * dims.z; ++i)
    voxels.push_back(random.once_in(2) ? 0.0F : static_cast<float>(real(random, 0.0, 1.0)));
  voxels[static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(voxels.size()) - 1))] = 1.0F;
  return volume_of(dims, spacing, voxels);
}

/// An angle, often one at which axes are parallel to the view or equally far from it.
double angle(test::Random& random, double range) {
  if (random.once_in(3)) return 45.0 * static_cast<double>(random.between(-4, 4)) * range / 180.0;
  return real(random, -range, range);
}

/// A few voxels on a random grid under a random camera, in an image of a few of the configuration's tiles; the support
/// radius mostly fits its RLUT.
scene::Scene random_scene(test::Random& random, const cmodel::Config& config, const OracleMethod& method,
                          scene::Projection projection) {
  while (true) {
    const auto volume = random_volume(random);
    D description;
    method.apply(description);
    constexpr const char* kFunctions[] = {"default", "binary", "checker", "linear", "two-colours", "x-ray"};
    description.transfer_function = kFunctions[random.between(0, 5)];
    description.kernel = random.once_in(3) ? "gauss2" : random.once_in(2) ? "smooth" : "";
    description.kernel_a = real(random, 0.5, 4.0);
    description.kernel_radius = real(random, 0.6, 3.0);
    description.shading = static_cast<int>(random.between(-1, 1));
    description.opacity_scale = random.once_in(4)   ? ratio(random, 10.0, 1e4)
                                : random.once_in(4) ? ratio(random, 1e-5, 0.01)
                                                    : ratio(random, 0.02, 10.0);
    description.width = static_cast<int>(random.between(1, random.once_in(4) ? 2 * config.tile_width + 9 : 60));
    description.height = static_cast<int>(random.between(1, random.once_in(4) ? 2 * config.tile_height + 9 : 60));
    description.camera.projection = projection;
    description.camera.azimuth = angle(random, 180.0);
    description.camera.elevation = angle(random, 90.0);
    description.camera.roll = random.once_in(2) ? 0.0 : angle(random, 180.0);
    description.camera.fov = real(random, 5.0, 100.0);
    const double most = config.max_extent() / 2.0;
    const double wanted = random.once_in(3) ? real(random, 0.3, 1.1) * most : ratio(random, 0.4, std::min(9.0, most));
    try {
      // Pixels per radius at zoom 1, then at the wanted zoom: in perspective the nearest is larger.
      const double usual = scene::build_scene(description, volume).kernel.radius() * volume->kernel_unit() *
                           scene::build_scene(description, volume).camera.scale_at(0.0);
      description.camera.zoom = std::clamp(wanted / usual, 1e-3, 1e3);
      return scene::build_scene(description, volume);
    } catch (const UserError&) {
      // an eye inside the volume: draw again
    }
  }
}

/// The beat as a record: its name and fields.
std::string text_of(const Beat& beat) {
  const cmodel::RecordLayout* layout = cmodel::find_layout(beat[0] & 0xFF);
  if (layout == nullptr) return "no record";
  std::string text = layout->name;
  for (const auto& [name, field] : layout->fields)
    text += std::string(" ") + name + "=" + std::to_string(cmodel::get(beat, field));
  return text;
}

/// The first field in which two beats of one record differ.
std::string differing_field(const Beat& expected, const Beat& got) {
  const cmodel::RecordLayout* layout = cmodel::find_layout(expected[0] & 0xFF);
  if (layout == nullptr || ((expected[0] ^ got[0]) & 0xFF) != 0) return "another record";
  for (const auto& [name, field] : layout->fields)
    if (cmodel::get(expected, field) != cmodel::get(got, field))
      return std::string(name) + " expected " + std::to_string(cmodel::get(expected, field)) + ", got " +
             std::to_string(cmodel::get(got, field));
  return "a bit that no field has";
}

/// Empty if they are equal. Payloads of tables are named by table and word.
std::string difference(const std::vector<Beat>& expected, const std::vector<cmodel::Beat>& got) {
  std::size_t payload = 0, word = 0;
  std::string table, sheet;
  for (std::size_t at = 0; at < expected.size(); ++at) {
    const Beat& beat = expected[at];
    const std::string where = "beat " + std::to_string(at) + ": ";
    if (at >= got.size()) return where + "ends early, expected " + text_of(beat);
    if (payload > 0) {
      for (std::size_t i = 0; i < beat.size(); ++i, ++word)
        if (beat[i] != got[at][i])
          return where + table + " word " + std::to_string(word) + " expected " + std::to_string(beat[i]) + ", got " +
                 std::to_string(got[at][i]);
      --payload;
      continue;
    }
    if (beat != got[at])
      return where + sheet + differing_field(beat, got[at]) + "\n  expected " + text_of(beat) + "\n  got      " +
             text_of(got[at]);
    if ((beat[0] & 0xFF) == static_cast<std::uint32_t>(cmodel::Opcode::LoadTable)) {
      table = text_of(beat);
      payload = cmodel::announced_beats(beat);
      word = 0;
    }
    if ((beat[0] & 0xFF) == static_cast<std::uint32_t>(cmodel::Opcode::BeginSheet))
      sheet = "sheet " + std::to_string(beat[1]) + ", ";
  }
  if (got.size() > expected.size())
    return "beat " + std::to_string(expected.size()) + ": expected nothing more, got " + text_of(got[expected.size()]);
  return "";
}

/// Empty if the frames and their reports are equal.
std::string frame_difference(const scene_oracle::Frame& expected, const CompiledFrame& compiled) {
  const auto preamble = compiled.preamble();
  const std::string first = difference(expected.preamble, {preamble.begin(), preamble.end()});
  if (!first.empty()) return "preamble, " + first;
  if (static_cast<std::size_t>(compiled.grid().count()) != expected.tiles.size())
    return "tiles expected " + std::to_string(expected.tiles.size()) + ", got " +
           std::to_string(compiled.grid().count());
  TileReport sum;
  for (std::size_t tile = 0; tile < expected.tiles.size(); ++tile) {
    std::vector<cmodel::Beat> beats;
    const TileReport report = compiled.emit_tile(static_cast<int>(tile), [&](std::span<const cmodel::Beat> some) {
      beats.insert(beats.end(), some.begin(), some.end());
    });
    const std::string here = difference(expected.tiles[tile], beats);
    if (!here.empty()) return "tile " + std::to_string(tile) + ", " + here;
    sum.splat_records += report.splat_records;
    sum.saturated_records += report.saturated_records;
    sum.sheets += report.sheets;
  }
  const DriverReport report = compiled.report();
  const auto& met = expected.met;
  for (const auto& [name, wanted, counted] : {std::tuple{"voxels", met.voxels, report.voxels},
                                              {"vanished voxels", met.vanished_voxels, report.vanished_voxels},
                                              {"saturated voxels", met.saturated_voxels, report.saturated_voxels},
                                              {"splat records", met.splat_records, sum.splat_records},
                                              {"saturated records", met.saturated_records, sum.saturated_records},
                                              {"sheets", met.sheets, sum.sheets}})
    if (wanted != counted)
      return std::string("report: ") + name + " expected " + std::to_string(wanted) + ", got " +
             std::to_string(counted);
  return "";
}

}  // namespace

std::shared_ptr<const volume::Volume> volume_of(glm::ivec3 dims, glm::dvec3 spacing, std::vector<float> voxels) {
  auto volume = std::make_shared<volume::Volume>();
  volume->name = volume->source = "voxels of the test";
  volume->dims = dims;
  volume->spacing = spacing;
  volume->min = 0.0F;
  volume->max = 1.0F;
  volume->voxels = std::move(voxels);
  return volume;
}

void compare_with_oracle(const std::string& name, const scene::Scene& scene, const cmodel::Config& config,
                         OracleFigures& figures) {
  std::string wrong;
  std::optional<scene_oracle::Frame> expected;
  std::string refusal;
  try {
    expected = scene_oracle::compile(scene_oracle::given_by(scene, config));
  } catch (const scene_oracle::Refused& refused) {
    refusal = refused.what();
  }
  try {
    const CompiledFrame compiled(scene, config);
    wrong = expected ? frame_difference(*expected, compiled) : "the page refuses " + refusal + ", the driver does not";
  } catch (const UserError& error) {
    if (expected) wrong = std::string("refused, but not by the page: ") + error.what();
    if (!expected) ++figures.refused;
  }
  if (!wrong.empty()) {
    if (figures.mismatches++ == 0) figures.first = name + ": " + wrong;
    return;
  }
  if (!expected) return;
  ++figures.frames;
  const auto add = [&figures](const std::vector<Beat>& beats) {
    figures.beats += beats.size();
    figures.words += beats.size() * cmodel::kBeatWords;
    for (const Beat& beat : beats)
      for (const std::uint32_t word : beat) figures.hash = (figures.hash ^ word) * 0x100000001b3U;
  };
  add(expected->preamble);
  for (const auto& tile : expected->tiles) add(tile);
  for (const auto& [unused, member] : scene_oracle::met_names()) figures.met.*member += expected->met.*member;
}

void compare_random_frames(test::Random& random, int rounds, int random_configs, OracleFigures& figures) {
  constexpr scene::Projection kProjections[] = {scene::Projection::Orthographic, scene::Projection::Perspective};
  const auto compare = [&](const cmodel::Config& config, const OracleMethod& method, scene::Projection projection,
                           const std::string& round) {
    compare_with_oracle(config.name + ", " + method.name + ", " + round,
                        random_scene(random, config, method, projection), config, figures);
  };
  // Devices of all maps in turn.
  int number = 0;
  const auto culling = [&number](cmodel::Config config) {
    config.cull_map = number++ % 3;
    return config;
  };
  for (int round = 0; round < rounds; ++round)
    for (const auto& name : config_names())
      for (const OracleMethod& method : kMethods)
        for (const auto projection : kProjections)
          compare(culling(load_config(name)), method, projection, std::to_string(round));
  for (int i = 0; i < random_configs; ++i) {
    const auto method = static_cast<std::size_t>(i) % std::size(kMethods);
    compare(culling(test::random_config(random)), kMethods[method], kProjections[i % 2],
            "configuration " + std::to_string(i));
  }
}

void compare_random_frames_of(cmodel::IndexKind kind, test::Random& random, int rounds, int random_configs,
                              OracleFigures& figures) {
  constexpr scene::Projection kProjections[] = {scene::Projection::Orthographic, scene::Projection::Perspective};
  int number = 0;
  const auto compare = [&](cmodel::Config config, const OracleMethod& method, scene::Projection projection) {
    config.index_kind = static_cast<int>(kind);
    if (kind == cmodel::IndexKind::Linear) config.ellipse_frac_bits = 0;
    if (cmodel::first_violation(config)) config.radial_interpolate = 0;
    if (kind == cmodel::IndexKind::Blit2d) {
      config.phases = std::min(config.phases, 8);
      config.rlut_columns = std::min(config.rlut_columns, 32);
      config.index_symmetry = number % 2;
    }
    ASSERT_FALSE(cmodel::first_violation(config)) << one_line(*cmodel::first_violation(config));
    compare_with_oracle(config.name + ", " + method.name + ", number " + std::to_string(number++),
                        random_scene(random, config, method, projection), config, figures);
  };
  for (int round = 0; round < rounds; ++round)
    for (const auto& name : config_names())
      for (const OracleMethod& method : kMethods)
        for (const auto projection : kProjections) compare(load_config(name), method, projection);
  for (int i = 0; i < random_configs; ++i)
    compare(test::random_config(random, kind), kMethods[static_cast<std::size_t>(i) % std::size(kMethods)],
            kProjections[i % 2]);
}

void print_and_expect_equal(const OracleFigures& figures) {
  const auto print = [](const char* name, std::uint64_t value, const char* limit) {
    std::printf("[figure] %s = %llu%s\n", name, static_cast<unsigned long long>(value), limit);
  };
  print("frames compared", figures.frames, " (limit > 0)");
  print("frames refused by both", figures.refused, "");
  print("beats compared", figures.beats, " (limit > 0)");
  print("words compared", figures.words, " (limit > 0)");
  for (const auto& [name, member] : scene_oracle::met_names()) {
    if (figures.met.*member > 0) print(name, figures.met.*member, "");
  }
  std::printf("[figure] hash of the words = %016llx\n", static_cast<unsigned long long>(figures.hash));
  print("frames that differ", figures.mismatches, " (limit 0)");
  EXPECT_GT(figures.words, 0U);
  EXPECT_EQ(figures.mismatches, 0U) << "first: " << figures.first;
}

void expect_all_met(const OracleFigures& figures) {
  EXPECT_GT(figures.refused, 0U);
  for (const auto& [name, member] : scene_oracle::met_names()) {
    if (member == &scene_oracle::Met::rims_kept || scene_oracle::is_of_ellipses(member)) continue;
    EXPECT_GT(figures.met.*member, 0U) << name;
  }
}

}  // namespace fastsplat::driver
