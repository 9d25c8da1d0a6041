// SPDX-License-Identifier: Apache-2.0
// NIfTI-1 and NIfTI-2 headers, single files and pairs, plain or gzip.
#pragma once

#include <filesystem>

#include "scene/volume/voxel_data.hpp"

namespace fastsplat::volume {

/// Whether the unpacked file starts with a NIfTI header of either byte order.
bool is_nifti(const std::filesystem::path& path);

/// Three dimensions (further ones must be 1 long). Placed by the header's sform, else by its qform. Everything else is
/// a UserError (Input).
VoxelSource read_nifti_header(const std::filesystem::path& path);

}  // namespace fastsplat::volume
