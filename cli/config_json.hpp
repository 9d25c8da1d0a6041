// A configuration in the JSON of the verbs.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "cmodel/config.hpp"

namespace fastsplat::cli {

/// {"name", "hash"}
nlohmann::ordered_json config_identity_json(const cmodel::Config& config);
/// Identity, description and every key.
nlohmann::ordered_json config_json(const cmodel::Config& config);

}  // namespace fastsplat::cli
