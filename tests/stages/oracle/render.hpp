// A second way to the pictures of docs/errors.md, section 1, written from that page: every splat, sheet and pixel.
#pragma once

#include <array>
#include <vector>

#include "cmodel/config.hpp"
#include "scene/scene.hpp"
#include "stages/step.hpp"

namespace fastsplat::stages::oracle {

/// A weight may be below 0: where weight is the device's and index is not, an entry's error can be more than is left at
/// its far end. What becomes of such products and sums the page leaves open in part, and the chain does otherwise:
///                                                  as the page has it         as the chain does
///   product, device                                saturated: 0               rounded, may be below 0
///   real factor, optical depth below 0             (1 - exp(-tau)) / tau      1, and a real slab's opacity is 0
/// On both ways the device's sums end at 0, at the end of the sheet.
enum class BelowZero { AsPage, AsChain };

/// R, G, B, A of each pixel, row by row. With `close`, also which pixels hang on a decision that lies within the last
/// bits of a double (rounding.hpp).
std::vector<std::array<double, 4>> render(const scene::Scene& scene, const cmodel::Config& config,
                                          const Mixture& mixture, BelowZero below, std::vector<bool>* close = nullptr);

}  // namespace fastsplat::stages::oracle
