// SPDX-License-Identifier: Apache-2.0
// Adding one footprint to several sheets with vector instructions, chosen for the processor at run time (Highway).
#pragma once

#include <cstddef>
#include <span>

#include "golden/splat/footprint.hpp"
#include "golden/splat/projected_splat.hpp"

namespace fastsplat::golden {

/// Adds values[s] * weight to sheet s at every pixel of the footprint. sheets[s] points to pixel (0, first_row); rows
/// lie `pitch` pixels apart. Each product and each sum is rounded separately, as in Sheet::add, so the bits are the
/// same. Vectors hold the four sums of one pixel; no sum is reordered.
void add_footprint(const Footprint& footprint, int first_row, std::size_t pitch, std::span<const Sums> values,
                   std::span<Sums* const> sheets);

/// Name of the instruction set that add_footprint uses, for example "AVX2".
const char* add_footprint_target();

}  // namespace fastsplat::golden
