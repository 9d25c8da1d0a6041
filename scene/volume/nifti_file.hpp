// NIfTI-1 and NIfTI-2 headers, single files and pairs, plain or gzip.
#pragma once

#include <filesystem>

#include "scene/volume/voxel_data.hpp"

namespace fastsplat::volume {

/// Does the file, unpacked, start with a NIfTI header of either byte order?
bool is_nifti(const std::filesystem::path& path);

/// Three dimensions (further ones must be 1 long). Placed where the header's sform, else its qform, says how the
/// axes lie. Everything else is a UserError (Input).
VoxelSource read_nifti_header(const std::filesystem::path& path);

}  // namespace fastsplat::volume
