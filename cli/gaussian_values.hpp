// SPDX-License-Identifier: Apache-2.0
// What a file of 3-D Gaussians holds: counts, ranges, declarations, dropped rows; as text and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::cli {

std::string gaussian_text(const scene::GaussianCloud& cloud);
nlohmann::ordered_json gaussian_json(const scene::GaussianCloud& cloud);

}  // namespace fastsplat::cli
