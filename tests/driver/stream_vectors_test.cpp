// SPDX-License-Identifier: Apache-2.0
// The pixel beats of a stream's vectors are the replayed picture, tile by tile, also if the image cuts tiles and if a
// tile's last beat of a row is not full. (Beats, taps and checksums: tests/capi/vectors_slow_test.cpp.)
#include "driver/files/stream_vectors.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/error.hpp"
#include "driver/config/config_file.hpp"
#include "driver/files/stream_file.hpp"
#include "tests/driver/scenes_helper.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::driver {
namespace {

class StreamVectors : public volume::TemporaryFolder {};

/// A line of output.hex: last, keep and data with _ between them.
struct PixelBeat {
  bool last = false;
  std::uint64_t keep = 0;
  std::string data;
};

std::vector<PixelBeat> pixel_beats(const std::filesystem::path& path) {
  std::vector<PixelBeat> out;
  std::ifstream in(path);
  for (std::string last, keep, data;
       std::getline(in, last, '_') && std::getline(in, keep, '_') && std::getline(in, data);)
    out.push_back({last == "1", std::stoull(keep, nullptr, 16), data});
  return out;
}

TEST_F(StreamVectors, PixelBeatsAreTheReplayedPicture) {
  for (const int lanes : {2, 4}) {
    auto config = load_config("tiny");
    config.lanes = lanes;
    ASSERT_FALSE(cmodel::first_violation(config));
    // Tiles of 32 x 32: the image ends 11 pixels into the second column and 5 into the second row.
    auto description = view_of("shells:8", 43);
    description.height = 37;
    const auto stream = folder_ / "scene.fss";
    record_stream(scene::build_scene(description), config, stream);
    const VectorReport report = write_vectors(stream, config, folder_ / "vectors");
    const cmodel::Frame frame = replay_stream(stream, config).frame;
    const auto beats = pixel_beats(folder_ / "vectors" / "output.hex");
    EXPECT_EQ(report.pixel_beats, beats.size());

    std::size_t at = 0, pixels = 0, lit = 0, wrong = 0;
    const auto words = static_cast<std::size_t>(lanes);
    for (const auto& [x0, y0, width, height] :
         {std::array{0, 0, 32, 32}, {32, 0, 11, 32}, {0, 32, 32, 5}, {32, 32, 11, 5}}) {
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; x += lanes, ++at) {
          ASSERT_LT(at, beats.size());
          const PixelBeat& beat = beats[at];
          EXPECT_EQ(beat.last, y == height - 1 && x + lanes >= width) << "beat " << at;
          ASSERT_EQ(beat.data.size(), 32 * words);
          for (int lane = 0; lane < lanes; ++lane) {
            const bool inside = x + lane < width;
            EXPECT_EQ((beat.keep >> lane & 1) != 0, inside) << "beat " << at;
            for (int channel = 0; channel < 4; ++channel) {
              // The first pixel's R has the lowest digits.
              const auto from = 32 * words - 8 * static_cast<std::size_t>(4 * lane + channel + 1);
              const auto word = std::stoul(beat.data.substr(from, 8), nullptr, 16);
              const std::uint32_t want = inside ? frame.pixel(x0 + x + lane, y0 + y)[channel] : 0;
              wrong += word != want ? 1 : 0;
              lit += want != 0 ? 1 : 0;
            }
            pixels += inside ? 1 : 0;
          }
        }
      }
    }
    figure("pixel beats, lanes " + std::to_string(lanes), static_cast<double>(beats.size()));
    figure("words that are not 0", static_cast<double>(lit));
    figure("words that are not the picture's", static_cast<double>(wrong));
    EXPECT_EQ(at, beats.size());
    EXPECT_EQ(pixels, 43U * 37U);
    EXPECT_GT(lit, 500U);
    EXPECT_EQ(wrong, 0U);
  }
}

// As with every other result: the parent folder must exist, and a failed run leaves no folder.
TEST_F(StreamVectors, AFolderIsMadeInOneThatIsThere) {
  const auto config = load_config("tiny");
  const auto stream = folder_ / "scene.fss";
  record_stream(scene::build_scene(view_of("shells:8", 16)), config, stream);
  int refused = 0;
  const auto refuse = [&](const std::filesystem::path& of, const std::filesystem::path& folder, const char* why) {
    try {
      write_vectors(of, config, folder);
      ADD_FAILURE() << folder << " was made";
    } catch (const UserError& error) {
      ++refused;
      EXPECT_EQ(error.code(), ExitCode::Input);
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
  };
  refuse(stream, folder_ / "no" / "v", "no does not exist");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "no"));
  refuse(stream, stream, "it is a file");
  refuse(stream, folder_ / std::string(300, 'v'), "name too long");
  refuse(folder_ / "none.fss", folder_ / "v", "none.fss");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "v")) << "nothing was written there";
  figure("folders refused", refused);
  EXPECT_GT(write_vectors(stream, config, (folder_ / "v").string() + "/").beats, 0u) << "a slash at its end";
  EXPECT_EQ(write_vectors(stream, config, folder_ / "v").files.size() + 1, vector_file_names().size()) << "again";
}

}  // namespace
}  // namespace fastsplat::driver
