// Whether the tiles of a recorded stream cover its image (docs/stream.md).
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/stream/beat.hpp"

namespace fastsplat::driver {

/// Rectangles of which any may lie over others. Memory goes with their number, not with the image.
class TileCover {
 public:
  void add(std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height);
  /// Pixels that lie in at least one.
  std::int64_t pixels() const;

 private:
  struct Rectangle {
    std::int64_t x0, y0, x1, y1;
  };
  std::vector<Rectangle> rectangles_;
};

/// Shown the beats of a whole stream that is sound otherwise, throws UserError (Input) at the end_frame of one whose
/// tiles leave pixels out: where = "beat N (byte offset M)".
class CoverRule {
 public:
  void see(const cmodel::Beat& beat);

 private:
  TileCover cover_;
  std::int64_t image_ = 0;  ///< pixels
  std::uint64_t beats_ = 0, payload_left_ = 0;
};

}  // namespace fastsplat::driver
