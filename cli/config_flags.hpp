// SPDX-License-Identifier: Apache-2.0
// From --config and --set to a hardware configuration.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::cli {

struct ConfigFlags {
  std::optional<std::string> config;  ///< a name or a file; absent: base
  std::vector<std::string> changes;   ///< "radial.entries=256", "--index rlut"
};

/// `help`: help text of --config.
void declare(Options& options, ConfigFlags& to, const char* help);
void declare_changes(Options& options, std::vector<std::string>& to);

/// The configuration with its changes (driver::changed).
cmodel::Config load(const std::string& name_or_path, const std::vector<std::string>& changes);
cmodel::Config load(const ConfigFlags& flags);

}  // namespace fastsplat::cli
