// SPDX-License-Identifier: Apache-2.0
// Names of numbered frames: head.####.png is head.0000.png, head.0001.png, ...
#pragma once

#include <string>

namespace fastsplat::cli {

/// UserError (Usage) if the file name of a still contains a place for frame numbers.
void check_still_name(const std::string& path);

class FrameNames {
 public:
  /// UserError (Usage) unless the file name in `pattern` has exactly one run of '#', wide enough for the last of
  /// `frames` numbers. `of`: noun for error messages.
  FrameNames(const std::string& pattern, int frames, const std::string& of = "frame");

  std::string operator()(int frame) const;  ///< zero-padded to the width of the run
  /// The pattern as a printf format: head.%04d.png; a % in the name is doubled.
  std::string format() const;

 private:
  std::string before_, after_;
  int digits_ = 0;
};

}  // namespace fastsplat::cli
