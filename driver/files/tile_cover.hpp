// SPDX-License-Identifier: Apache-2.0
// Checks that the tiles of a recorded stream cover its image (docs/stream.md).
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/stream/beat.hpp"

namespace fastsplat::driver {

/// A set of rectangles that may overlap. Memory grows with their number, not with the image.
class TileCover {
 public:
  void add(std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height);
  /// Number of pixels in at least one rectangle.
  std::int64_t pixels() const;

 private:
  struct Rectangle {
    std::int64_t x0, y0, x1, y1;
  };
  std::vector<Rectangle> rectangles_;
};

/// Receives the beats of a whole, otherwise valid stream. Throws UserError (Input) at the end_frame if the tiles leave
/// out pixels: where = "beat N (byte offset M)".
class CoverRule {
 public:
  void see(const cmodel::Beat& beat);

 private:
  TileCover cover_;
  std::int64_t image_ = 0;  ///< pixels
  std::uint64_t beats_ = 0, payload_left_ = 0;
};

}  // namespace fastsplat::driver
