// SPDX-License-Identifier: Apache-2.0
// Procedural solid textures per pixel (docs/techniques/solid-textures.md): tints each pixel of each sheet, whether
// densities are classified there or colours were splatted.
#pragma once

#include "golden/frame_sweep.hpp"
#include "golden/pixel_stage.hpp"
#include "golden/sheet_geometry.hpp"
#include "scene/solid_texture.hpp"

namespace fastsplat::golden {

/// Tints the classified colour, before it is shaded.
class TextureOfPixel final : public PixelStage {
 public:
  explicit TextureOfPixel(const scene::Texture& texture) : texture_(texture) {}
  void apply(PixelSample& sample) const override { sample.colour *= scene::tint(texture_, sample.position); }

 private:
  scene::Texture texture_;
};

/// Tints the emission of pre-classified splats.
class TextureOfSheet final : public SheetStage {
 public:
  TextureOfSheet(const scene::Texture& texture, const SheetGeometry& geometry)
      : texture_(texture), geometry_(geometry) {}
  bool needs_neighbours() const override { return false; }
  void row(const SheetWindow& window, int y, int begin, std::span<Sums> pixels) const override {
    for (int i = 0; i < static_cast<int>(pixels.size()); ++i) {
      if (!(pixels[i][3] > 0.0)) continue;
      const glm::dvec3 tint = scene::tint(texture_, geometry_.position(begin + i, y, window.number));
      for (int c = 0; c < 3; ++c) pixels[i][c] *= tint[c];
    }
  }

 private:
  scene::Texture texture_;
  const SheetGeometry& geometry_;
};

}  // namespace fastsplat::golden
