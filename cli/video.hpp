// A video from numbered PNG frames, by ffmpeg where it is installed.
#pragma once

#include <string>

namespace fastsplat::cli {

struct Video {
  std::string path;    ///< .mp4, .mkv or .webm; the container follows the ending
  std::string frames;  ///< names of the frames as a printf format, numbered from 0
  int count = 0;
  double rate = 24.0;  ///< frames a second
};

/// UserError when the ending is unknown (Usage) or ffmpeg is not in PATH (Input).
void check_video(const std::string& path);

/// Whole or not at all, as every result. UserError (Input) with ffmpeg's last words when it fails.
void write_video(const Video& video);

}  // namespace fastsplat::cli
