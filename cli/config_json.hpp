// A configuration in the JSON of the verbs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cmodel/config.hpp"

namespace fastsplat::cli {

/// {"name", "hash"}
nlohmann::ordered_json config_identity_json(const cmodel::Config& config);
/// A number, or the word of a key of words.
nlohmann::ordered_json value_json(const cmodel::Config& config, const cmodel::ConfigKey& key);
/// Identity, description and every key.
nlohmann::ordered_json config_json(const cmodel::Config& config);

}  // namespace fastsplat::cli
