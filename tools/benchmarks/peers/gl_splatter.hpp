// SPDX-License-Identifier: Apache-2.0
// Splatting as on graphics hardware: a textured, blended quad for every voxel (Crawfis, Max 1993), in Mesa's software
// OpenGL, without a window.
#pragma once

#include <memory>
#include <string>

#include "base/image.hpp"
#include "scene/scene.hpp"

namespace fastsplat::bench {

/// Format of the picture's four channels, to which sums are rounded after every quad.
enum class Sums { Half, Float };

/// An X-ray, whose sum does not depend on the order: footprint texture (128 x 128, 16-bit float, bilinear) times the
/// splat's colour, added to a picture of floats.
class GlSplatter {
 public:
  /// Classifies, projects and uploads the scene's splats; `scene` must be a Method::XRay.
  GlSplatter(const scene::Scene& scene, Sums sums);
  ~GlSplatter();

  /// Clears, draws all quads and waits for completion.
  void draw();
  /// The last picture, rows downwards.
  Image picture() const;
  std::string renderer() const;  ///< GL's renderer string
  std::size_t quads() const;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace fastsplat::bench
