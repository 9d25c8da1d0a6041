// SPDX-License-Identifier: Apache-2.0
// Volumes from files and by name: NRRD (teem), NIfTI (nifti2), MetaImage, synthetics.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/volume/volume.hpp"

namespace fastsplat::volume {

struct ReadOptions {
  /// Replaces NaN and infinity, which are refused without it.
  std::optional<float> nan_as{};
};

/// Loads what the user named: an existing path; a synthetic "name[:size]"; or a scan of the Debian package mricron-data
/// by its bare name (`ch2`, `ch2bet`, `inia19-t1-brain`, searched in $FASTSPLAT_DATA and /usr/share/mricron/templates).
/// Every failure is a UserError (ExitCode::Input) with the fix.
/// If a header declares the axes in a body (NIfTI sform/qform, NRRD space, MetaImage matrix), whole axes are turned so
/// that +x is right, +y anterior, +z superior as nearly as possible. Volume::axes holds the remaining rotation; the
/// voxels are not resampled.
Volume load_volume(const std::string& name_or_path, const ReadOptions& options = {});

/// Reads only the header: dims, spacing, type; voxels stay empty.
Volume read_volume_header(const std::string& name_or_path);

/// The files that load_volume would read: a header and its data files; empty for a built-in volume. Does not report
/// errors; load_volume does.
std::vector<std::filesystem::path> files_of(const std::string& name_or_path);

/// Writes by extension, atomically: .nrrd (gzip), .nhdr, .nii, .nii.gz, .mha (zlib), .mhd. Stores voxels as `type`;
/// values that do not fit are an error, not clamped. The volume's place in the body is written, too.
void save_volume(const Volume& volume, const std::filesystem::path& path, VoxelType type);

/// The data file that save_volume writes beside a detached header, .nhdr or .mhd; empty for other endings.
std::filesystem::path data_file_of(const std::filesystem::path& header);

/// Names that `load_volume` accepts without a path.
std::vector<std::string> known_volume_names();

const char* to_string(VoxelType type);

}  // namespace fastsplat::volume
