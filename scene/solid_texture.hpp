// SPDX-License-Identifier: Apache-2.0
// Procedural solid textures: a solid pattern as a tint that multiplies colours.
#pragma once

#include "scene/solid_field.hpp"

namespace fastsplat::scene {

/// Where the texture is applied: at the voxels, before they are splatted, or at the pixels of every sheet.
enum class TextureWhere { Voxel, Pixel };

struct Texture {
  SolidKind kind = SolidKind::None;
  TextureWhere where = TextureWhere::Pixel;
  double scale = 20.0;     ///< mm, one unit of the pattern
  double amplitude = 1.0;  ///< 0..1: how far the tint departs from white
  bool operator==(const Texture&) const = default;
};

/// A solid pattern as a relief.
struct Bump {
  SolidKind kind = SolidKind::None;  ///< not Checker, which has no slope
  double scale = 10.0;               ///< mm, one unit of the pattern
  double amplitude = 0.3;            ///< height of the pattern's range 0..1, in units of the scale
};

/// 1 - amplitude (1 - colour(pattern)) at a place in mm: in [0,1], exactly 1 for amplitude 0. The colour runs between
/// two tints of the kind.
glm::dvec3 tint(const Texture& texture, const glm::dvec3& position);

/// The same for a pattern's value; linear in it.
glm::dvec3 tint_of_value(const Texture& texture, double value);

}  // namespace fastsplat::scene
