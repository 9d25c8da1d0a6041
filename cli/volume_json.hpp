// SPDX-License-Identifier: Apache-2.0
// A volume's properties as JSON, without voxels, and its warnings.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "cli/output.hpp"
#include "scene/scene.hpp"
#include "scene/volume/volume.hpp"

namespace fastsplat::cli {

nlohmann::ordered_json volume_json(const volume::Volume& volume);
/// Volume::remarks and Scene::remarks as warnings that name the volume.
std::vector<Remark> remarks(const volume::Volume& volume);
std::vector<Remark> remarks(const scene::Scene& scene);

}  // namespace fastsplat::cli
