// SPDX-License-Identifier: Apache-2.0
// Estimates the hardware cost of a configuration from the configuration alone (docs/errors.md, section 5).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

struct Cost {
  double storage_bits = 0.0;     ///< of tables, sheets and picture, as often as the RTL has each
  double adder_bits = 0.0;       ///< full adders
  double multiplier_bits = 0.0;  ///< cells of array multipliers: the product of both widths
  /// The cost as one number, in full adders: a multiplier's cell counts as one, a bit of memory as a sixth.
  double total() const { return storage_bits / 6.0 + adder_bits + multiplier_bits; }
};

/// For the device of rtl/: index.kind rlut. With interpolation, includes what that would add.
Cost cost(const cmodel::Config& config);

nlohmann::ordered_json to_json(const Cost& cost);

}  // namespace fastsplat::analysis
