// SPDX-License-Identifier: Apache-2.0
// Estimates the hardware cost of a configuration from the configuration alone (docs/errors.md, section 5).
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

/// Arithmetic in cells that the RTL is made of.
struct Arithmetic {
  double adder_bits = 0.0;       ///< full adders
  double multiplier_bits = 0.0;  ///< cells of array multipliers: the product of both widths
  Arithmetic operator*(double count) const { return {count * adder_bits, count * multiplier_bits}; }
  Arithmetic operator+(const Arithmetic& other) const {
    return {adder_bits + other.adder_bits, multiplier_bits + other.multiplier_bits};
  }
};

/// What one event uses.
struct EventArithmetic {
  Arithmetic splat;       ///< a record
  Arithmetic window;      ///< of P x P pixels, without its lanes
  Arithmetic weight;      ///< of one lane of a window
  Arithmetic product;     ///< the lane's four products
  Arithmetic sum;         ///< the lane's four sums in a sheet
  Arithmetic composited;  ///< a pixel of a sheet, or a sample
  Arithmetic output;      ///< a pixel that leaves the device
};
EventArithmetic event_arithmetic(const cmodel::Config& config);

/// The device's memories. A table that all lanes read in the same cycle exists once a lane.
struct Memories {
  double rlut_bits = 0.0;     ///< of one axis; there are two
  double radial_bits = 0.0;   ///< of one lane
  double factor_bits = 0.0;   ///< of one pixel composited at once
  double sheet_bits = 0.0;    ///< of both buffers
  double picture_bits = 0.0;  ///< or an X-ray's sums
};
Memories memories(const cmodel::Config& config);

struct Cost {
  double storage_bits = 0.0;  ///< of all memories
  double adder_bits = 0.0, multiplier_bits = 0.0;
  /// The cost as one number, in full adders: a multiplier's cell counts as one, a bit of memory as a sixth.
  double total() const { return storage_bits / 6.0 + adder_bits + multiplier_bits; }
};

/// For the device of rtl/: index.kind rlut. With interpolation, includes what that would add.
Cost cost(const cmodel::Config& config);

nlohmann::ordered_json to_json(const Cost& cost);

}  // namespace fastsplat::analysis
