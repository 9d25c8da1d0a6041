// What Yosys and nextpnr said of a design (tests/rtl/synthesis/synth.sh), as data: cells by module, levels, a
// placement.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace fastsplat::evidence {

/// Files FAMILY-CONFIG.* of `work`. Throws std::runtime_error where one is missing or says something else.
///   {design, family, configuration: HASH, tools: {NAME: VERSION}, total: CELLS,
///    modules: {NAME: {instances, levels, CELLS}}, seconds,
///    placement: {fmax_mhz, used: {RESOURCE: [USED, OF]}, worst_paths: [...], from_pins: [...]}}
/// worst_paths: the ten latest arrivals between registers; from_pins: the latest from a pin.
/// CELLS: lut, carry, mux, ff, lutram, bram, dsp, as the family's primitives. A module's are its own and its memories',
/// of one instance; levels, its longest path in cells, 0 where it has none. Seconds are the processor's: not for
/// comparing.
nlohmann::ordered_json read_synthesis(const std::filesystem::path& work, const std::string& family,
                                      const std::string& config);

/// Figures of `now` that are more than `share` away from those of `then`, either way, one line each; also what is new
/// or gone. Seconds and paths are not compared. `compared`: how many figures were.
std::vector<std::string> changes(const nlohmann::ordered_json& then, const nlohmann::ordered_json& now, double share,
                                 int& compared);

}  // namespace fastsplat::evidence
