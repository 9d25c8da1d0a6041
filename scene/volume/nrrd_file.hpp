// SPDX-License-Identifier: Apache-2.0
// NRRD headers, attached and detached; voxel_data reads the voxels.
#pragma once

#include <filesystem>

#include "scene/volume/voxel_data.hpp"

namespace fastsplat::volume {

/// Whether the file starts with NRRD's magic.
bool is_nrrd(const std::filesystem::path& path);

/// Three axes (further ones must be 1 long), raw, gzip, bzip2, hex or ascii. A detached header's data file must lie in
/// the header's folder or below, links followed. Everything else is a UserError (Input).
VoxelSource read_nrrd_header(const std::filesystem::path& path);

}  // namespace fastsplat::volume
