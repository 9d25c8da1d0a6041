#include "cli/volume_json.hpp"

#include <nlohmann/json.hpp>

#include "volume/volume_file.hpp"

namespace fastsplat::cli {

nlohmann::ordered_json volume_json(const volume::Volume& volume) {
  return {{"name", volume.name},
          {"source", volume.source},
          {"dims", {volume.dims.x, volume.dims.y, volume.dims.z}},
          {"spacing_mm", {volume.spacing.x, volume.spacing.y, volume.spacing.z}},
          {"type", volume::to_string(volume.stored)},
          {"voxels", volume.voxels.size()},
          {"min", volume.min},
          {"max", volume.max},
          {"kernel_unit_mm", volume.kernel_unit()}};
}

}  // namespace fastsplat::cli
