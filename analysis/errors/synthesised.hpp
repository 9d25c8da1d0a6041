// What synthesis made of a configuration's device, where somebody ran it: the figures kept in
// docs/evidence/synthesis.json, which are text in the program. Cost (cost.hpp) is an estimate for any configuration;
// this is measured, for few.
#pragma once

#include <nlohmann/json.hpp>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

/// {FAMILY: {lut, carry, mux, ff, lutram, bram, dsp, levels, tool}}, whole device, by the configuration's hash; null
/// where none was synthesised. Cells are the family's primitives; levels: the longest path of any module, in cells.
nlohmann::ordered_json synthesised(const cmodel::Config& config);

}  // namespace fastsplat::analysis
