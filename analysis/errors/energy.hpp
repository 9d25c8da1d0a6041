// SPDX-License-Identifier: Apache-2.0
// The energy of a frame as a range: what the device did, times picojoules of an operation (docs/errors.md, section 5).
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::analysis {

/// Joules, least and most.
struct Joules {
  double low = 0.0, high = 0.0;
  Joules& operator+=(const Joules& other) {
    low += other.low;
    high += other.high;
    return *this;
  }
};

// Picojoules by M. Horowitz, "Computing's energy problem", ISSCC 2014 (45 nm, 0.9 V), and N. P. Jouppi et al., "Ten
// lessons from three generations shaped Google's TPUv4i", ISCA 2021 (7 nm).
/// Of a full adder or a multiplier's cell: the least and the greatest by cell of 8 and 32 bits in 7 and 45 nm. Sums take
/// 0.007 to 0.1 pJ. Products take 0.07 to 3.1 pJ and have 64 or 1024 cells.
inline constexpr Joules kCellEnergy{0.007e-12 / 8, 0.03e-12 / 8};
/// Of a bit of DRAM, from accesses of 64 bits: HBM2 250 pJ, DDR3 2600.
inline constexpr Joules kDramEnergy{250e-12 / 64, 2600e-12 / 64};
/// Of a bit of a memory of up to `bytes`, from accesses of 64 bits; the last row also holds for larger ones.
struct MemoryEnergy {
  double bytes;
  Joules bit;
};
inline constexpr std::array kMemoryEnergy{MemoryEnergy{8192, {7.5e-12 / 64, 10e-12 / 64}},
                                          MemoryEnergy{32768, {8.5e-12 / 64, 20e-12 / 64}},
                                          MemoryEnergy{1048576, {14e-12 / 64, 100e-12 / 64}}};

/// What a frame made the device do.
struct Activity {
  cmodel::Mode mode{};                        ///< of its tiles
  bool ellipses = false;                      ///< its records are ellipses
  cmodel::Counters counters;                  ///< with those of pixels: the model's
  std::uint64_t bytes_in = 0, bytes_out = 0;  ///< of the stream, of pixels
};

struct EnergyPart {
  const char* name;
  Joules joules;
};

/// Parts in the order of the data's way. Low: the newest process and memory of the table, and only lanes and pixels
/// that change something switch. High: the oldest ones, and all lanes of every window and all pixels of every block
/// switch. Clock, registers, control and leakage are left out. For configurations and modes without energy_violation().
std::vector<EnergyPart> energy(const cmodel::Config& config, const Activity& activity);
Joules total(const std::vector<EnergyPart>& parts);

/// Why the model does not cover a frame; empty if it does.
std::string energy_violation(const cmodel::Config& config, cmodel::Mode mode);

/// {low_uj, high_uj, parts: {NAME: {low_uj, high_uj}}}, microjoules.
nlohmann::ordered_json to_json(const std::vector<EnergyPart>& parts);

}  // namespace fastsplat::analysis
