// SPDX-License-Identifier: Apache-2.0
// Named hardware configurations: configs/*.toml, built into the program, or a user's file.
#pragma once

#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::driver {

/// A built-in name (`base`) or a path to a .toml file. Every key without a neutral value must be present, unknown keys
/// are refused, limits are checked. Each failure is a UserError (Input) with file, line, key and the numbers.
cmodel::Config load_config(const std::string& name_or_path);
std::vector<std::string> config_names();  ///< names of the listed built-in configurations

/// TOML that load_config() reads back to the same configuration: each key with its limits and meaning. Keys at their
/// neutral value are commented out.
std::string to_toml(const cmodel::Config& config);

}  // namespace fastsplat::driver
