// SPDX-License-Identifier: Apache-2.0
// The pixels of one footprint, with the kernel's line integral at each.
#pragma once

#include <cstddef>
#include <vector>

#include "golden/splat/projected_splat.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::golden {

/// Rows of the image, [first, end).
struct Rows {
  int first = 0;
  int end = 0;
};

/// The part of a splat's footprint inside a band of image rows. The weights do not depend on depth, so one
/// rasterisation serves every sheet the splat touches (splatting.md 1.6). Reused from splat to splat to avoid
/// allocations.
class Footprint {
 public:
  struct Span {
    int y = 0;
    int x = 0;  ///< first pixel
    int width = 0;
    std::size_t weights = 0;  ///< index of the first pixel's weight
  };

  /// Weight of pixel (i,j) = kernel.footprint(q) with q = d^T S^-1 d, d its offset from the centre and S the splat's
  /// shape; strict support. For a textured splat times 1 + m t(u,v), (u,v) = d in kernel units along x and y.
  void rasterise(const scene::Kernel& kernel, const ProjectedSplat& splat, Rows rows, int image_width);

  const std::vector<Span>& spans() const { return spans_; }
  const double* weights(const Span& span) const { return &weights_[span.weights]; }

 private:
  void modulate(const ProjectedSplat& splat);

  std::vector<Span> spans_;
  std::vector<double> weights_;  ///< may be longer than its used part
};

}  // namespace fastsplat::golden
