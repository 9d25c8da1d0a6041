// SPDX-License-Identifier: Apache-2.0
// Compressed PLY, as SuperSplat and splat-transform write it: 256 Gaussians share a chunk of bounds, and each is packed
// into four words relative to them.
#pragma once

#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/ply_rows.hpp"

namespace fastsplat::scene {

/// Whether the vertices are packed words.
bool is_packed(const PlyHeader& header);

/// Reads the elements chunk, vertex and, if present, sh. Sets the degree of `to`; `rows` must be at the first element.
/// UserError (Input) for elements in another order, of other sizes or without a property.
void read_packed(const PlyHeader& header, PlyRows& rows, const std::string& where, GaussianCloud& to);

}  // namespace fastsplat::scene
