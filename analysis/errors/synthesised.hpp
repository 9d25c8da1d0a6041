// SPDX-License-Identifier: Apache-2.0
// Synthesis results of configurations: the figures of docs/evidence/synthesis.json, built into the program. Cost
// (cost.hpp) is an estimate for any configuration; these are measured, for few.
#pragma once

#include <nlohmann/json.hpp>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

/// {FAMILY: {lut, carry, mux, ff, lutram, bram, dsp, levels, tool}}, whole device, by the configuration's hash; null if
/// it was not synthesised. Cells are the family's primitives; levels: the longest path of any module, in cells.
nlohmann::ordered_json synthesised(const cmodel::Config& config);

}  // namespace fastsplat::analysis
