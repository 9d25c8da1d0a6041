// A volume in the words of the verbs: what it is, without its voxels, and what was odd about it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "cli/output.hpp"
#include "scene/scene.hpp"
#include "scene/volume/volume.hpp"

namespace fastsplat::cli {

nlohmann::ordered_json volume_json(const volume::Volume& volume);
/// Volume::remarks and Scene::remarks, each a warning that names the volume.
std::vector<Remark> remarks(const volume::Volume& volume);
std::vector<Remark> remarks(const scene::Scene& scene);

}  // namespace fastsplat::cli
