// SPDX-License-Identifier: Apache-2.0
// MetaImage headers, ITK's own format: .mha with the voxels behind them, .mhd with the voxels in another file.
#pragma once

#include <filesystem>

#include "scene/volume/voxel_data.hpp"

namespace fastsplat::volume {

/// Whether the file starts with a line of a MetaImage header.
bool is_metaimage(const std::filesystem::path& path);

/// Three dimensions (further ones must be 1 long), one scalar per voxel; plain, compressed or text. Placed by
/// TransformMatrix and Offset, which ITK reads as +x left, +y posterior, +z superior. A separate data file must lie in
/// the header's folder or below, links followed. Everything else is a UserError (Input).
VoxelSource read_metaimage_header(const std::filesystem::path& path);

}  // namespace fastsplat::volume
