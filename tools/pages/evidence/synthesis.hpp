// SPDX-License-Identifier: Apache-2.0
// Reads the results of Yosys and nextpnr for a design (tests/rtl/synthesis/synth.sh): cells by module, levels, a
// placement.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fastsplat::evidence {

/// Reads the files FAMILY-CONFIG.* of `work`. Throws std::runtime_error if one is missing or invalid. Returns
///   {design, family, configuration: HASH, tools: {NAME: VERSION}, total: CELLS,
///    modules: {NAME: {instances, levels, CELLS}}, seconds,
///    placement: {fmax_mhz, used: {RESOURCE: [USED, OF]}, worst_paths: [...], from_pins: [...]}}
/// worst_paths: the ten latest arrivals between registers; from_pins: the latest from a pin.
/// CELLS: of family gates ge, ff, memory_bits (gate equivalents of four transistors, without memories); else lut,
/// carry, mux, ff, lutram, bram, dsp, the family's primitives. A module's are those of one instance and its memories;
/// levels is its longest path in cells, 0 if it has none. seconds is processor time, not to be compared.
nlohmann::ordered_json read_synthesis(const std::filesystem::path& work, const std::string& family,
                                      const std::string& config);

/// Figures of `now` that differ from `then` by more than `share`, one line each; also new and missing ones. Seconds and
/// paths are not compared. `compared`: number of figures compared.
std::vector<std::string> changes(const nlohmann::ordered_json& then, const nlohmann::ordered_json& now, double share,
                                 int& compared);

}  // namespace fastsplat::evidence
