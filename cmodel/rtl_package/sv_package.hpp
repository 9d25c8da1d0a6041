// SPDX-License-Identifier: Apache-2.0
// The SystemVerilog package of a configuration: every number the RTL needs, as literals, from the same Config, stream
// layout and counters that the model uses.
#pragma once

#include <string>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::cmodel {

/// Text of rtl's `fastsplat_pkg`. The configuration must have passed first_violation() and rtl_violation().
std::string sv_package(const Config& config);

/// The first limit of the RTL (N-2-8) that a configuration breaks; empty if the RTL can be made for it.
std::optional<ErrorParts> rtl_violation(const Config& config);

}  // namespace fastsplat::cmodel
