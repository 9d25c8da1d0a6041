// SPDX-License-Identifier: Apache-2.0
// The table of `cycles --cull-table` as text and JSON (docs/culling.md).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "driver/tiles/culling_comparison.hpp"

namespace fastsplat::cli {

/// A line per device: cycles and speed-up, milliseconds at 100 MHz, share of splat records drawn, and how the cycles
/// were spent.
std::string to_text(const std::vector<driver::CullRow>& rows);
nlohmann::ordered_json to_json(const std::vector<driver::CullRow>& rows);

}  // namespace fastsplat::cli
