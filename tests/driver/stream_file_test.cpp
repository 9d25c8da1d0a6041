// Recorded streams: the replayed frame is the rendered frame, and a stream that leaves a hole in the image is refused.
#include "driver/stream_file.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "cmodel/crc32.hpp"
#include "cmodel/records.hpp"
#include "driver/config_file.hpp"
#include "tests/driver/scenes_helper.hpp"

namespace fastsplat::driver {
namespace {

std::vector<cmodel::Beat> read_beats(const std::filesystem::path& path) {
  std::vector<cmodel::Beat> beats(std::filesystem::file_size(path) / cmodel::kBeatBytes);
  std::ifstream in(path, std::ios::binary);
  in.read(reinterpret_cast<char*>(beats.data()), static_cast<std::streamsize>(beats.size() * cmodel::kBeatBytes));
  return beats;
}

void write_beats(const std::filesystem::path& path, std::vector<cmodel::Beat> beats) {
  cmodel::Crc32 crc;
  for (const auto& beat : beats) crc.add(beat);
  cmodel::append(beats, cmodel::EndFrame{beats.size(), crc.value()});
  std::ofstream out(path, std::ios::binary);
  out.write(reinterpret_cast<const char*>(beats.data()),
            static_cast<std::streamsize>(beats.size() * cmodel::kBeatBytes));
}

class StreamFile : public ::testing::Test {
 protected:
  std::filesystem::path path_ = std::filesystem::path(::testing::TempDir()) / "fastsplat_stream_file_test.fss";
  void TearDown() override { std::filesystem::remove(path_); }
};

TEST_F(StreamFile, replay_equals_render) {
  for (const char* name : {"base", "small"}) {
    const auto config = load_config(name);
    auto description = view_of("shells:24", 150);
    description.camera.projection = scene::Projection::Perspective;
    const auto scene = scene::build_scene(description);
    const auto report = record_stream(scene, config, path_);
    const auto rendered = render(scene, config);
    const auto replayed = replay_stream(path_, config);
    const auto apart = difference(rendered.frame, replayed.frame);
    figure(std::string("words compared, ") + name, static_cast<double>(apart.compared));
    ASSERT_GT(apart.compared, 0u);
    EXPECT_EQ(apart.different, 0u);
    EXPECT_TRUE(rendered.counters == replayed.counters);
    EXPECT_EQ(report.splat_records, rendered.report.splat_records);
  }
}

TEST_F(StreamFile, a_hole_in_the_image_is_refused) {
  const auto config = load_config("base");
  record_stream(scene::build_scene(view_of("shells:16", 150)), config, path_);
  auto beats = read_beats(path_);
  beats.pop_back();
  // The second tile moves over the first: as many pixels, but not the image's.
  int tiles = 0, moved = 0;
  for (auto& beat : beats) {
    if (get(beat, cmodel::layout::kOpcode) != static_cast<std::int64_t>(cmodel::Opcode::BeginTile) ||
        beat[1] != static_cast<std::uint32_t>(tiles))
      continue;
    if (tiles++ == 1) {
      beat[2] = 0;
      ++moved;
    }
  }
  ASSERT_EQ(moved, 1);
  write_beats(path_, beats);
  try {
    replay_stream(path_, config);
    FAIL() << "accepted";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), ExitCode::Input);
    EXPECT_NE(std::string(error.what()).find("do not cover the image"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace fastsplat::driver
