// Splatting as graphics hardware does it: a textured, blended quad for every voxel (Crawfis, Max 1993), in Mesa's
// software OpenGL, without a window.
#pragma once

#include <memory>
#include <string>

#include "base/image.hpp"
#include "scene/scene.hpp"

namespace fastsplat::bench {

/// Words of the picture's four channels: what sums are rounded to, quad after quad.
enum class Sums { Half, Float };

/// An X-ray, whose sum does not depend on the order: footprint texture (128 x 128, 16-bit float, bilinear) times the
/// splat's colour, added into a picture of floats.
class GlSplatter {
 public:
  /// Classifies, projects and uploads the scene's splats; `scene` is a Method::XRay.
  GlSplatter(const scene::Scene& scene, Sums sums);
  ~GlSplatter();

  /// Clears, draws all quads and waits until they are drawn.
  void draw();
  /// The last picture, rows downwards.
  Image picture() const;
  std::string renderer() const;  ///< what GL calls itself
  std::size_t quads() const;

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

}  // namespace fastsplat::bench
