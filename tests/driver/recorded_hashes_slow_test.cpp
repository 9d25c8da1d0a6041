// SPDX-License-Identifier: Apache-2.0
// A refactoring changes no word: streams, frames, counters and cycles of every configuration, method and view against
// the hashes in recorded_hashes.txt. To change numbers on purpose, copy the list that this test writes and give the
// reason.
#include <gtest/gtest.h>

#include <cstdio>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <sstream>

#include "cmodel/cycles/cycle_model.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/render.hpp"
#include "driver/tiles/run_device.hpp"
#include "scene/scene.hpp"
#include "tests/paths.hpp"

namespace fastsplat::driver {
namespace {

constexpr const char* kRecorded = FASTSPLAT_SOURCE_DIR "/tests/driver/recorded_hashes.txt";
constexpr const char* kMeasured = FASTSPLAT_BINARY_DIR "/recorded_hashes.txt";

/// FNV-1a over 32-bit words.
class Fnv {
 public:
  void add(std::uint32_t word) { value_ = (value_ ^ word) * 0x100000001b3ULL; }
  void add(std::uint64_t word) {
    add(static_cast<std::uint32_t>(word));
    add(static_cast<std::uint32_t>(word >> 32));
  }
  std::string text() const {
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value_));
    return text;
  }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

struct Method {
  const char* name;
  void (*apply)(scene::SceneDescription&);
};
const Method kHashedMethods[] = {
    {"image", [](scene::SceneDescription&) {}},
    {"image_additive", [](scene::SceneDescription& d) { d.slab_opacity = scene::SlabOpacity::Additive; }},
    {"image_half_slab", [](scene::SceneDescription& d) { d.slab_width = 0.5; }},
    {"image_wide_slab", [](scene::SceneDescription& d) { d.slab_width = 3.7; }},
    {"axis", [](scene::SceneDescription& d) { d.method = scene::Method::AxisAligned; }},
    {"xray", [](scene::SceneDescription& d) { d.method = scene::Method::XRay; }},
    {"xray_7", [](scene::SceneDescription& d) { d.method = scene::Method::XRay, d.xray_sheets = 7; }},
};
const Method kHashedViews[] = {
    {"front", [](scene::SceneDescription&) {}},
    {"turned", [](scene::SceneDescription& d) { d.camera.azimuth = 33, d.camera.elevation = 21, d.camera.roll = 5; }},
    {"near", [](scene::SceneDescription& d) { d.camera.azimuth = -50, d.camera.zoom = 2.3; }},
    {"perspective",
     [](scene::SceneDescription& d) {
       d.camera.projection = scene::Projection::Perspective, d.camera.azimuth = 20, d.camera.fov = 45;
     }},
};

/// Volume, transfer function, and whether the volume's own shading is on.
struct Content {
  const char* volume;
  const char* transfer_function;
};
const Content kContents[] = {{"marschner-lobb:20", "default"}, {"shells:18", "ct-head"}};

std::string measure(const scene::Scene& scene, const cmodel::Config& config) {
  Fnv stream, words, counts;
  const CompiledFrame compiled(scene, config);
  const auto take = [&](std::span<const cmodel::Beat> beats) {
    for (const auto& beat : beats) {
      for (const std::uint32_t word : beat) stream.add(word);
    }
  };
  compiled.emit(take);
  const DeviceRender out = render(scene, config, {.threads = 1, .progress = {}});
  for (const std::uint32_t word : out.frame.words) words.add(word);
  out.counters.for_each([&](const char*, std::uint64_t value, const char*) { counts.add(value); });
  for (const std::uint64_t value :
       {out.report.voxels, out.report.splat_records, out.report.tiles, out.report.sheets, out.report.saturated_voxels,
        out.report.saturated_records, out.report.vanished_voxels})
    counts.add(value);
  std::uint64_t cycles = 0;
  run_device(
      scene, config,
      [&](cmodel::PixelSink&) {
        return std::make_unique<cmodel::CycleModel>(config, cmodel::StreamScope::Subset, cmodel::CycleOptions{});
      },
      {.threads = 1, .progress = {}},
      [&](cmodel::Device& device) { cycles = static_cast<cmodel::CycleModel&>(device).stalls().busy; });
  return stream.text() + " " + words.text() + " " + counts.text() + " " + std::to_string(cycles);
}

// N-8-2: the order of operations; of shells:18, which is shaded, N-8-19 and N-8-21, too.
TEST(RecordedHashes, StreamsFramesCountersAndCycles) {
  std::map<std::string, std::string> recorded;
  std::ifstream in(kRecorded);
  std::string line;
  while (std::getline(in, line)) {
    if (line.empty() || line[0] == '#') continue;
    const auto bar = line.find(" | ");
    ASSERT_NE(bar, std::string::npos) << kRecorded << ": " << line;
    recorded[line.substr(0, bar)] = line.substr(bar + 3);
  }
  std::ofstream list(kMeasured);
  list << "# configuration method view volume | stream frame counters cycles (recorded_hashes_slow_test.cpp)\n";
  std::size_t compared = 0, refused = 0, different = 0;
  std::set<std::string> frames;
  for (const auto& name : config_names()) {
    const auto config = load_config(name);
    for (const Method& method : kHashedMethods) {
      for (const Method& view : kHashedViews) {
        for (const Content& content : kContents) {
          scene::SceneDescription description;
          description.volume = content.volume;
          description.transfer_function = content.transfer_function;
          description.width = 70, description.height = 45;
          method.apply(description);
          view.apply(description);
          std::string measured;
          try {
            measured = measure(scene::build_scene(description), config);
            frames.insert(measured);
          } catch (const UserError&) {
            measured = "refused";  // a footprint that the configuration's RLUT cannot hold
            ++refused;
          }
          const std::string key = name + " " + method.name + " " + view.name + " " + content.volume;
          list << key << " | " << measured << "\n";
          const auto expected = recorded.find(key);
          ++compared;
          if (expected == recorded.end() || expected->second != measured) {
            if (++different <= 5)
              ADD_FAILURE() << key << ": recorded " << (expected == recorded.end() ? "nothing" : expected->second)
                            << "\n  measured " << measured;
          }
          recorded.erase(key);
        }
      }
    }
  }
  for (const auto& [key, unused] : recorded) ADD_FAILURE() << key << " is recorded and no longer measured";
  std::printf("[figure] recorded runs compared = %zu, different %zu, refused by the configuration %zu, distinct %zu\n",
              compared, different, refused, frames.size());
  EXPECT_EQ(different, 0u) << "where numbers change on purpose: copy " << kMeasured << " to " << kRecorded;
  EXPECT_GT(compared, 300u);
  EXPECT_LT(refused, compared / 4);
  EXPECT_GT(frames.size(), compared / 2) << "the runs are too alike to see anything";
}

}  // namespace
}  // namespace fastsplat::driver
