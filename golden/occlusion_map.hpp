// SPDX-License-Identifier: Apache-2.0
// Occlusion map: which pixels are opaque after the sheets so far, and whether all pixels of a window are.
#pragma once

#include <span>
#include <vector>

#include "golden/sheet.hpp"
#include "golden/splat/composite.hpp"
#include "golden/summed_area_table.hpp"
#include "scene/culling.hpp"

namespace fastsplat::golden {

class OcclusionMap {
 public:
  OcclusionMap(int width, int height, const scene::Culling& culling);

  /// Call after each sheet: rereads the pixels of each row's run. The picture's transmittances must not have grown.
  void update(std::span<const FrontToBack> picture, std::span<const Run> changed);

  /// Visibility test of a non-empty window inside the image.
  ///   Count: every pixel's transmittance is below culling.freeze. Exact.
  ///   Average: the mean opacity is at least theta, so its transmittances add up to at most area * (1 - theta). A
  ///   hidden splat can contribute up to min(1, area * (1 - theta)) to one pixel. Opacities are rounded down to 1/256
  ///   (a map of bytes, as in the papers), so the mean is never overestimated.
  bool hides(const Window& window) const;

  /// Per pixel. Count: 1 if opaque. Average: the opacity in units of 1/256, at most 255.
  std::span<const std::uint8_t> levels() const { return levels_; }
  /// Per pixel: number of updates after which its transmittance was below culling.freeze; 0: not yet.
  const std::vector<std::uint32_t>& opaque_after() const { return opaque_after_; }

 private:
  int width_;
  bool average_;
  double freeze_, theta_;
  std::vector<std::uint8_t> levels_;
  std::vector<std::uint32_t> opaque_after_;
  std::uint32_t updates_ = 0;
  SummedAreaTable table_;
  bool any_ = false;  ///< whether any level is above 0; until then nothing is hidden
};

/// Pixels whose centres lie within reach_x, reach_y of (x,y), clipped to the image; empty outside it.
Window window_around(double x, double y, double reach_x, double reach_y, int width, int height);

}  // namespace fastsplat::golden
