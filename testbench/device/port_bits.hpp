// SPDX-License-Identifier: Apache-2.0
// Word widths of the RTL's vector ports, by configuration.
#pragma once

#include <algorithm>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::testbench {

struct PortBits {
  int weight = 0;  ///< tap_weights_o: P*P of them
  int sheet = 0;   ///< tap_sums_o: P*P*4
  int state = 0;   ///< tap_state_o: P*P*4
};

inline PortBits port_bits(const cmodel::Config& config) {
  const int sheet = config.sheet_int_bits + config.sheet_frac_bits;
  return {.weight = config.radial_int_bits + config.radial_frac_bits,
          .sheet = sheet,
          .state = std::max(sheet, config.composite_frac_bits + 1 + config.colour_int_bits)};
}

}  // namespace fastsplat::testbench
