// SPDX-License-Identifier: Apache-2.0
#include "cli/volume_json.hpp"

#include <nlohmann/json.hpp>

#include "scene/volume/placement.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::cli {

nlohmann::ordered_json volume_json(const volume::Volume& volume) {
  nlohmann::ordered_json json{{"name", volume.name},
                              {"source", volume.source},
                              {"dims", {volume.dims.x, volume.dims.y, volume.dims.z}},
                              {"spacing_mm", {volume.spacing.x, volume.spacing.y, volume.spacing.z}},
                              {"type", volume::to_string(volume.stored)},
                              {"voxels", volume.voxels.size()},
                              {"min", volume.min},
                              {"max", volume.max},
                              {"kernel_unit_mm", volume.kernel_unit()}};
  if (volume.placed) {
    const auto vector = [](const glm::dvec3& v) { return nlohmann::ordered_json{v.x, v.y, v.z}; };
    const auto turn = volume::turn_of(volume);
    json["centre_mm"] = vector(volume.centre);
    json["axes"] = {vector(volume.axes[0]), vector(volume.axes[1]), vector(volume.axes[2])};
    json["turned_degrees"] = turn.degrees;
    json["sheared_degrees"] = turn.shear;
  }
  if (!volume.remarks.empty()) json["remarks"] = volume.remarks;
  return json;
}

namespace {

std::vector<Remark> warnings(const std::string& name, const std::vector<std::string>& texts) {
  std::vector<Remark> remarks;
  for (const auto& text : texts) remarks.push_back({Remark::Warning, name + ": " + text});
  return remarks;
}

}  // namespace

std::vector<Remark> remarks(const volume::Volume& volume) { return warnings(volume.name, volume.remarks); }
std::vector<Remark> remarks(const scene::Scene& scene) { return warnings(scene.volume->name, scene.remarks); }

}  // namespace fastsplat::cli
