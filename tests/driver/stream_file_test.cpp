// SPDX-License-Identifier: Apache-2.0
// Recorded streams: the replayed frame is the rendered frame, and a stream that leaves a hole in the image is refused.
#include "driver/files/stream_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "cmodel/cycles/cycle_model.hpp"
#include "cmodel/stream/crc32.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/config/config_file.hpp"
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

/// Number of the first beat after begin_frame and the tables.
std::size_t first_tile(const std::vector<cmodel::Beat>& beats) {
  std::size_t at = 1;
  while (get(beats[at], cmodel::layout::kOpcode) == static_cast<std::int64_t>(cmodel::Opcode::LoadTable))
    at += 1 + cmodel::announced_beats(beats[at]);
  return at;
}

/// The message of a UserError; empty if none.
std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

class StreamFile : public ::testing::Test {
 protected:
  // Named after this process: tests run in parallel.
  std::filesystem::path path_ =
      std::filesystem::path(::testing::TempDir()) / ("fastsplat_stream_file_" + std::to_string(::getpid()) + ".fss");
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

// S-file-1.
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
  // Every reader has the rule and gives the place: at the end, the last beat.
  const auto end = "beat " + std::to_string(beats.size()) + " (byte offset " +
                   std::to_string(beats.size() * cmodel::kBeatBytes) + "): tiles do not cover the image";
  cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, {});
  EXPECT_THAT(refusal([&] { feed_stream(path_, cycles); }), ::testing::HasSubstr(end));
  EXPECT_THAT(refusal([&] { require_covered(path_); }), ::testing::HasSubstr(end));
  EXPECT_THAT(refusal([&] { replay_stream(path_, config); }), ::testing::HasSubstr(end));
}

// S-file-2: two tiles at the same place that differ in their mode, in either order.
TEST_F(StreamFile, the_last_of_overlapping_tiles_wins) {
  const auto config = load_config("tiny");
  record_stream(scene::build_scene(view_of("shells:8", config.tile_width)), config, path_);
  auto recorded = read_beats(path_);
  recorded.pop_back();
  const auto first = recorded.begin() + static_cast<std::ptrdiff_t>(first_tile(recorded));
  const std::vector<cmodel::Beat> tile(first, recorded.end());
  recorded.erase(first, recorded.end());
  const auto picture = [&](std::initializer_list<cmodel::Mode> modes) {
    auto beats = recorded;
    beats[0][5] = static_cast<std::uint32_t>(modes.size());
    std::uint32_t number = 0;
    for (const cmodel::Mode mode : modes) {
      auto copy = tile;
      copy.front()[0] = static_cast<std::uint32_t>(cmodel::Opcode::BeginTile) | static_cast<std::uint32_t>(mode) << 8;
      copy.front()[1] = copy.back()[1] = number++;
      beats.insert(beats.end(), copy.begin(), copy.end());
    }
    write_beats(path_, beats);
    return replay_stream(path_, config).frame.words;
  };
  using enum cmodel::Mode;
  const auto exponential = picture({Exponential}), sum = picture({Sum});
  std::size_t different = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) different += sum[i] != exponential[i] ? 1 : 0;
  figure("words in which the two tiles differ", static_cast<double>(different));
  EXPECT_GT(different, 0U);
  EXPECT_EQ(picture({Exponential, Sum}), sum);
  EXPECT_EQ(picture({Sum, Exponential}), exponential);
}

// A file of version 1: 24 bytes a beat, so all after begin_frame is elsewhere. It is refused by name, by all readers
// (S-frame-2).
TEST_F(StreamFile, a_file_of_the_version_before_is_refused_by_name) {
  const auto config = load_config("tiny");
  record_stream(scene::build_scene(view_of("shells:8", 24)), config, path_);
  constexpr std::size_t kOldWords = 6;
  std::vector<std::uint32_t> old;
  for (const auto& beat : read_beats(path_)) old.insert(old.end(), beat.begin(), beat.begin() + kOldWords);
  old[0] = (old[0] & 0xffffU) | 1U << 16;
  std::ofstream(path_, std::ios::binary)
      .write(reinterpret_cast<const char*>(old.data()), static_cast<std::streamsize>(4 * old.size()));
  cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, {});
  const std::string message =
      "beat 0 (byte offset 0): stream version 1, this program reads version 2 (expected 2, got 1)";
  int readers = 0;
  const std::function<void()> all[] = {[&] { replay_stream(path_, config); }, [&] { feed_stream(path_, cycles); },
                                       [&] { require_covered(path_); },
                                       [&] { dump_stream(path_, [](const std::string&) { return true; }); }};
  for (const auto& read : all) {
    try {
      read();
      FAIL() << "accepted";
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Input);
      EXPECT_THAT(error.what(), ::testing::HasSubstr(path_.string() + ": " + message));
      EXPECT_THAT(error.what(), ::testing::HasSubstr("record it again"));
      ++readers;
    }
  }
  std::printf("[figure] readers that refuse version 1 by name = %d\n", readers);
  EXPECT_EQ(readers, 4);
}

// Cut at any byte: refused at the missing or incomplete beat, by every reader of the file (S-reader-2).
TEST_F(StreamFile, a_short_file_is_refused_at_the_missing_beat) {
  const auto config = load_config("tiny");
  record_stream(scene::build_scene(view_of("shells:8", 24)), config, path_);
  const auto size = std::filesystem::file_size(path_);
  int cuts = 0;
  constexpr std::uintmax_t beat_bytes = cmodel::kBeatBytes;
  for (const std::uintmax_t left : {std::uintmax_t{0}, std::uintmax_t{3}, beat_bytes - 1, beat_bytes, beat_bytes + 10,
                                    size / 2, size - beat_bytes, size - beat_bytes + 1, size - 1}) {
    if (left >= std::filesystem::file_size(path_))
      record_stream(scene::build_scene(view_of("shells:8", 24)), config, path_);
    std::filesystem::resize_file(path_, left);
    const auto beat = left / cmodel::kBeatBytes;
    const auto place = path_.string() + ": beat " + std::to_string(beat) + " (byte offset " +
                       std::to_string(beat * cmodel::kBeatBytes) + ")";
    cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, {});
    EXPECT_THAT(refusal([&] { replay_stream(path_, config); }), ::testing::HasSubstr(place)) << left;
    EXPECT_THAT(refusal([&] { feed_stream(path_, cycles); }), ::testing::HasSubstr(place)) << left;
    int lines = 0;
    EXPECT_THAT(refusal([&] {
                  dump_stream(path_, [&](const std::string&) {
                    ++lines;
                    return true;
                  });
                }),
                ::testing::HasSubstr(place))
        << left;
    EXPECT_EQ(lines, static_cast<int>(beat)) << "lines of whole beats come first";
    ++cuts;
  }
  figure("cuts", cuts);
}

// S-reader-3.
TEST_F(StreamFile, a_dump_names_the_wrong_end) {
  const auto config = load_config("tiny");
  record_stream(scene::build_scene(view_of("shells:8", 24)), config, path_);
  const auto whole = read_beats(path_);
  const auto dumped = [&](std::vector<cmodel::Beat> beats) {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(beats.data()),
               static_cast<std::streamsize>(beats.size() * cmodel::kBeatBytes));
    return refusal([&] { dump_stream(path_, [](const std::string&) { return true; }); });
  };
  EXPECT_EQ(dumped(whole), "");
  auto wrong = whole;
  wrong.back()[3] ^= 1;
  EXPECT_THAT(dumped(wrong), ::testing::HasSubstr("checksum"));
  wrong = whole;
  wrong.back()[1] += 1;
  EXPECT_THAT(dumped(wrong), ::testing::HasSubstr("wrong number of beats"));
  wrong = whole;
  wrong.push_back(whole.back());
  EXPECT_THAT(dumped(wrong), ::testing::HasSubstr("nothing after end_frame"));
  // A reader with its number of beats stops reading.
  EXPECT_EQ(refusal([&] { dump_stream(path_, [](const std::string&) { return false; }); }), "");
}

// The first beat in words: all of its fields in docs/stream.md.
TEST_F(StreamFile, a_dump_prints_the_header_of_the_stream) {
  const auto config = load_config("tiny");
  auto description = view_of("shells:8", 40);
  description.height = 24;
  record_stream(scene::build_scene(description), config, path_);
  std::string first;
  dump_stream(path_, [&](const std::string& line) {
    first = line;
    return false;
  });
  std::printf("[figure] first line of a dump = %s\n", first.c_str());
  EXPECT_EQ(first, "       0 begin_frame version=2 magic=0x31535346 hash=" + hash_text(cmodel::config_hash(config)) +
                       " width=40 height=24 tiles=2");
}

// A short stream is written when the file is closed: an error at that time is reported too, and the old file stays.
TEST_F(StreamFile, a_disk_that_fills_up_at_the_end_is_reported) {
  const std::vector<cmodel::Beat> beats(10);  // 320 bytes
  driver::write_beats(path_, std::span(beats).first(1));
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 100, .rlim_max = before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string message = refusal([&] { driver::write_beats(path_, std::span(beats)); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  const auto left = std::filesystem::file_size(path_);
  figure("bytes of the file after a write that failed", static_cast<double>(left));
  EXPECT_THAT(message, ::testing::HasSubstr("cannot write"));
  EXPECT_EQ(left, 32U);
}

// S-file-3.
TEST_F(StreamFile, what_no_replay_takes_is_not_recorded) {
  auto description = view_of("shells:8", 64);
  description.width = 8193;
  description.height = 8192;
  EXPECT_THAT(refusal([&] { record_stream(scene::build_scene(description), load_config("base"), path_); }),
              ::testing::HasSubstr("67108864"));
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_NO_THROW(check_image_size(8192, 8192));
}

// S-file-4: a replay refuses the header. Readers without an image (`cycles`, `verify`, `dump`) miss only the pixels
// that no tile covers (S-file-1).
TEST_F(StreamFile, only_a_replay_refuses_an_image_for_its_size) {
  const auto config = load_config("tiny");
  record_stream(scene::build_scene(view_of("shells:8", 24)), config, path_);
  auto beats = read_beats(path_);
  beats.pop_back();
  beats[0][4] = 8192U << 16 | 8193U;
  write_beats(path_, beats);
  EXPECT_THAT(refusal([&] { replay_stream(path_, config); }),
              ::testing::AllOf(::testing::HasSubstr("image too large to replay"), ::testing::HasSubstr("67108864")));
  cmodel::CycleModel cycles(config, cmodel::StreamScope::Whole, {});
  EXPECT_THAT(refusal([&] { feed_stream(path_, cycles); }), ::testing::HasSubstr("tiles do not cover the image"));
  EXPECT_THAT(refusal([&] { require_covered(path_); }), ::testing::HasSubstr("tiles do not cover the image"));
  EXPECT_EQ(refusal([&] { dump_stream(path_, [](const std::string&) { return true; }); }), "");
  figure("pixels of the image", 8193.0 * 8192.0, "(limit of a replay 67108864)");
}

}  // namespace
}  // namespace fastsplat::driver
