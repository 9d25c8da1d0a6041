// A volume in the JSON of the verbs: what it is, without its voxels.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "volume/volume.hpp"

namespace fastsplat::cli {

nlohmann::ordered_json volume_json(const volume::Volume& volume);

}  // namespace fastsplat::cli
