// SPDX-License-Identifier: Apache-2.0
// What can be chosen: settings, configurations, keys, volumes, presets, with their limits and meanings.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace fastsplat::lab {

nlohmann::ordered_json tables();

}  // namespace fastsplat::lab
