// SPDX-License-Identifier: Apache-2.0
// The energy of a frame as a range: what the device did, times picojoules of an operation (docs/errors.md, section 5).
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::analysis {

/// What a frame made the device do.
struct Activity {
  cmodel::Mode mode{};                        ///< of its tiles
  bool ellipses = false;                      ///< its records are ellipses
  cmodel::Counters counters;                  ///< with those of pixels: the model's
  std::uint64_t bytes_in = 0, bytes_out = 0;  ///< of the stream, of pixels
};

/// Joules, least and most.
struct Joules {
  double low = 0.0, high = 0.0;
  Joules& operator+=(const Joules& other) {
    low += other.low;
    high += other.high;
    return *this;
  }
};

struct EnergyPart {
  const char* name;
  const char* meaning;
  Joules joules;
};

/// Parts in the order of the data's way. Low: the newest process and memory of the table, and only lanes and pixels
/// that change something switch. High: the oldest ones, and all lanes of every window and all pixels of every block
/// switch. Clock, registers, control and leakage are left out.
std::vector<EnergyPart> energy(const cmodel::Config& config, const Activity& activity);
Joules total(const std::vector<EnergyPart>& parts);

/// Why energy() has no figure; empty if it has.
std::string no_energy(const cmodel::Config& config, cmodel::Mode mode);

/// {low_uj, high_uj, parts: {NAME: {low_uj, high_uj}}}, microjoules.
nlohmann::ordered_json to_json(const std::vector<EnergyPart>& parts);

}  // namespace fastsplat::analysis
