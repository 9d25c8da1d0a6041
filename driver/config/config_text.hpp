// SPDX-License-Identifier: Apache-2.0
// Parses a configuration from TOML text.
#pragma once

#include <string>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::driver {

/// Every key without a neutral value must be present, unknown keys are refused, limits are checked; each failure is a
/// UserError (Input) that begins with `file`, line and column.
cmodel::Config parse_config(const std::string& file, const std::string& text);

}  // namespace fastsplat::driver
