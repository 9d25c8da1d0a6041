// A configuration in the JSON of the verbs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::cli {

/// {"name", "hash"}
nlohmann::ordered_json config_identity_json(const cmodel::Config& config);
/// The same with what it costs: the device's `cost` (docs/errors.md, section 5; null where the index is not the RTL's),
/// and `index_cost`, the tables and cycles of its kind of index for a footprint of 2 pixels' radius (docs/family.md).
nlohmann::ordered_json priced_config_json(const cmodel::Config& config);
/// A number, or the word of a key of words.
nlohmann::ordered_json value_json(const cmodel::Config& config, const cmodel::ConfigKey& key);
/// Identity, description and every key.
nlohmann::ordered_json config_json(const cmodel::Config& config);

}  // namespace fastsplat::cli
