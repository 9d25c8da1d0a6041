// SPDX-License-Identifier: Apache-2.0
// What `cycles` says of a frame's bytes and energy (docs/errors.md, section 5).
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/errors/energy.hpp"
#include "cmodel/cycles/stream_beats.hpp"

namespace fastsplat::cli {

struct FrameTraffic {
  cmodel::StreamBeats in;              ///< of one device
  std::uint64_t bytes_out = 0;         ///< pixels
  std::optional<std::uint64_t> drawn;  ///< voxels or Gaussians whose records these are, if known
  std::vector<analysis::EnergyPart> energy;
  std::string energy_violation;  ///< if not empty, `energy` is

  std::uint64_t bytes_in() const;
};

/// Two lines.
std::string to_text(const FrameTraffic& traffic);
/// {bytes_in, bytes_out, in: {KIND: bytes}, records_each}
nlohmann::ordered_json traffic_json(const FrameTraffic& traffic);

}  // namespace fastsplat::cli
