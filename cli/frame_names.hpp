// Names of numbered frames: head.####.png is head.0000.png, head.0001.png, ...
#pragma once

#include <string>

namespace fastsplat::cli {

/// UserError (Usage) where the name of a still's file has a place for a frame's number.
void check_still_name(const std::string& path);

class FrameNames {
 public:
  /// UserError (Usage) unless the file name in `pattern` holds exactly one run of '#', wide enough for the number of
  /// the last of `frames`. `of`: what is numbered, if not frames.
  FrameNames(const std::string& pattern, int frames, const std::string& of = "frame");

  std::string operator()(int frame) const;  ///< padded with zeros to the width of the run
  /// The same as a printf format: head.%04d.png, where a % of the name is doubled.
  std::string format() const;

 private:
  std::string before_, after_;
  int digits_ = 0;
};

}  // namespace fastsplat::cli
