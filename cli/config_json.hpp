// SPDX-License-Identifier: Apache-2.0
// Configurations in the subcommands' JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::cli {

/// {"name", "hash"}
nlohmann::ordered_json config_identity_json(const cmodel::Config& config);
/// Identity with `cost` (docs/errors.md, section 5; null unless the index kind is the RTL's), `synthesis` (null if none
/// is kept) and `index_cost` (docs/family.md). The latter is table bits and cycles per splat for a radius of 2 pixels.
nlohmann::ordered_json priced_config_json(const cmodel::Config& config);
/// A number, or a word for keys whose values are words.
nlohmann::ordered_json value_json(const cmodel::Config& config, const cmodel::ConfigKey& key);
/// Identity, description, the costs above and all keys.
nlohmann::ordered_json config_json(const cmodel::Config& config);

}  // namespace fastsplat::cli
