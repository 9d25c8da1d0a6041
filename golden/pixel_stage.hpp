// SPDX-License-Identifier: Apache-2.0
// A classified pixel of one sheet, and the steps that modify it before shading.
#pragma once

#include <glm/glm.hpp>

namespace fastsplat::golden {

struct PixelSample {
  glm::dvec3 position{0.0};  ///< world, mm, in the middle of the sheet
  glm::dvec3 gradient{0.0};  ///< world, value per mm
  glm::dvec3 colour{0.0};    ///< 0..1, not multiplied by opacity
};

/// One step between classifying and shading a pixel; steps run in sequence.
class PixelStage {
 public:
  virtual ~PixelStage() = default;
  virtual void apply(PixelSample& sample) const = 0;
};

}  // namespace fastsplat::golden
