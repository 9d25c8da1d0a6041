// SPDX-License-Identifier: Apache-2.0
#include "cli/video.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <vector>

#include "base/atomic_file.hpp"
#include "base/called.hpp"
#include "base/error.hpp"
#include "base/programs.hpp"

namespace fastsplat::cli {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failed(const std::string& path, const std::string& reason) {
  throw_input({.where = path,
               .what = "ffmpeg could not make the video: " + reason,
               .expected = {},
               .got = {},
               .fix = "run the command again to retry the video: the frames are kept"});
}

}  // namespace

void check_video(const std::string& path) {
  const std::string ending = fs::path(path).extension().string();
  if (ending != ".mp4" && ending != ".mkv" && ending != ".webm") {
    throw_usage({.where = path,
                 .what = "unsupported video extension",
                 .expected = ".mp4, .mkv, .webm",
                 .got = ending.empty() ? "none" : ending,
                 .fix = "end the name in .mp4"});
  }
  if (!in_path("ffmpeg")) {
    throw_input({.where = "--video",
                 .what = "ffmpeg is not installed",
                 .expected = {},
                 .got = {},
                 .fix = "apt-get install ffmpeg, or leave --video out and keep the frames"});
  }
}

void write_video(const Video& video) {
  AtomicFile file(video.path);
  // "file:" makes a colon or leading dash in a name literal; players need even sides and 4:2:0.
  const std::vector<std::string> words{"ffmpeg",
                                       "-nostdin",
                                       "-loglevel",
                                       "error",
                                       "-y",
                                       "-framerate",
                                       fmt::format("{}", video.rate),
                                       "-start_number",
                                       "0",
                                       "-i",
                                       "file:" + video.frames,
                                       "-frames:v",
                                       fmt::format("{}", video.count),
                                       "-vf",
                                       "pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                       "-pix_fmt",
                                       "yuv420p",
                                       "file:" + file.temporary().string()};
  const Called called = call(words, 0);
  if (called.code != 0) failed(video.path, called.last_words());
  file.commit();
}

}  // namespace fastsplat::cli
