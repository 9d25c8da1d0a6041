// SPDX-License-Identifier: Apache-2.0
// Post-classified splatting (Mueller, Moeller, Crawfis 1999): densities are splatted, and each pixel of each sheet is
// classified and shaded after reconstruction. docs/techniques/post-classified.md.
#pragma once

#include <vector>

#include "golden/density_splats.hpp"
#include "golden/frame_sweep.hpp"
#include "golden/pixel_stage.hpp"
#include "golden/sheet_geometry.hpp"
#include "scene/shading.hpp"

namespace fastsplat::golden {

/// Converts density (and its gradient) to material: classifies value = base + sum / W by the transfer function, applies
/// the pixel stages, shades by the gradient, and multiplies by the slab's depth W.
class PostClassified final : public SheetStage {
 public:
  /// The scene chooses the kind of gradients; GradientKind::Splats needs the sums of GradientSplats. The scene and the
  /// stages must outlive this object.
  PostClassified(const scene::Scene& scene, const SheetGeometry& geometry, double base,
                 std::vector<const PixelStage*> stages);

  bool needs_neighbours() const override {
    return needs_gradient_ && scene_.description.gradients == scene::GradientKind::Central;
  }
  int margin() const override { return needs_neighbours() ? 1 : 0; }
  /// The whole row if the base value is visible, else `so_far`.
  Run extent(const SheetWindow& window, int y, Run so_far) const override;
  void row(const SheetWindow& window, int y, int begin, std::span<Sums> pixels) const override;

  /// In world space, value per mm.
  glm::dvec3 gradient(const SheetWindow& window, int x, int y, double pixels_per_unit) const;

 private:
  bool outside(const glm::dvec3& position) const;

  const scene::Scene& scene_;
  const SheetGeometry& geometry_;
  scene::Classifier classify_;
  scene::Shader shade_;
  double base_;
  std::vector<const PixelStage*> stages_;
  bool needs_gradient_;
  bool base_is_clear_;
};

}  // namespace fastsplat::golden
