// Adding one footprint to several sheets with vector instructions, chosen for the processor at run time (Highway).
#pragma once

#include <cstddef>
#include <span>

#include "golden/splat/footprint.hpp"
#include "golden/splat/projected_splat.hpp"

namespace fastsplat::golden {

/// Adds values[s] * weight to sheet s on every pixel of the footprint. sheets[s] is pixel (0, first_row), `pitch`
/// pixels lie from row to row. Every sum gets one product and one addition, each rounded on its own, as in Sheet::add:
/// the same bits. Vectors run over the four sums of a pixel; no sum is reordered.
void add_footprint(const Footprint& footprint, int first_row, std::size_t pitch, std::span<const Sums> values,
                   std::span<Sums* const> sheets);

/// "AVX2" and the like: what add_footprint runs on.
const char* add_footprint_target();

}  // namespace fastsplat::golden
