// What a configuration costs to build, from the configuration alone (docs/errors.md, "Cost").
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

struct Cost {
  double storage_bits = 0.0;     ///< of tables, sheets and picture, as often as the RTL has each
  double adder_bits = 0.0;       ///< full adders
  double multiplier_bits = 0.0;  ///< cells of array multipliers: the product of both widths
  /// One number to choose by: full adders, a multiplier's cell being one and a bit of memory a sixth of one.
  double total() const { return storage_bits / 6.0 + adder_bits + multiplier_bits; }
};

/// Of the device of rtl/: index.kind rlut; and with interpolation, of what that would add to it.
Cost cost(const cmodel::Config& config);

nlohmann::ordered_json to_json(const Cost& cost);

}  // namespace fastsplat::analysis
