// SPDX-License-Identifier: Apache-2.0
// Solid patterns: a value at every point of space, for textures and bumps (splatting.md section 2 item 12). They are
// functions of position alone, so they stay with the object in any view and at any resolution.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace fastsplat::scene {

/// Lengths are in units of the pattern's own scale.
/// - Stripes: (1 + cos 2 pi x) / 2, period 1 along x.
/// - Marble: stripes whose phase is stirred by turbulence, dark veins (0) in a light ground (1).
/// - Wood: rings of width 1 about the z axis, uneven and slightly tilted, 0 at the late wood.
/// - Noise: four octaves of gradient noise about 1/2.
/// - Checker: cubes of edge 1, alternately 0 and 1.
/// - None: without a pattern; for descriptions only.
enum class SolidKind { None, Stripes, Marble, Wood, Noise, Checker };

const std::vector<std::string>& solid_kind_names();   ///< in the order of SolidKind
const std::vector<std::string>& smooth_kind_names();  ///< all except Checker, which comes last

/// The pattern's value in [0,1]; continuous except Checker.
double solid_field(SolidKind kind, const glm::dvec3& p);

/// Its gradient by central differences over 1/64; not for Checker, which lacks one.
glm::dvec3 solid_gradient(SolidKind kind, const glm::dvec3& p);

/// Gradient noise (Perlin 1985, quintic fade): in [-1,1], 0 at integer points, period 2^32. The directions come from
/// an integer hash of the lattice point, so it is the same everywhere.
double gradient_noise(const glm::dvec3& p);

}  // namespace fastsplat::scene
