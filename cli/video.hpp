// SPDX-License-Identifier: Apache-2.0
// A video from numbered PNG frames, made by ffmpeg.
#pragma once

#include <string>

namespace fastsplat::cli {

struct Video {
  std::string path;    ///< .mp4, .mkv or .webm; selects the container
  std::string frames;  ///< frame names as a printf format, numbered from 0
  int count = 0;
  double rate = 24.0;  ///< frames per second
};

/// UserError if the extension is unknown (Usage) or ffmpeg is not in PATH (Input).
void check_video(const std::string& path);

/// Writes the complete file or nothing. UserError (Input), with ffmpeg's last output line, if it fails.
void write_video(const Video& video);

}  // namespace fastsplat::cli
