// Volumes from files and by name: NRRD (teem), NIfTI (nifti2), MetaImage, synthetics.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/volume/volume.hpp"

namespace fastsplat::volume {

struct ReadOptions {
  /// Put in the place of NaN and infinity, which are refused without it.
  std::optional<float> nan_as{};
};

/// Finds what the user named: an existing path; a synthetic "name[:size]"; or a scan of the Debian package
/// mricron-data by its bare name (`ch2`, `ch2bet`, `inia19-t1-brain`, searched in $FASTSPLAT_DATA and
/// /usr/share/mricron/templates). Every failure is a UserError (ExitCode::Input) with the fix.
/// Where a file's header says how its axes lie in a body (NIfTI sform/qform, NRRD space, MetaImage matrix), whole axes
/// are turned so that +x is right, +y anterior, +z superior as nearly as can be; the rest is Volume::axes. Nothing is
/// resampled.
Volume load_volume(const std::string& name_or_path, const ReadOptions& options = {});

/// Reads only the header: dims, spacing, type; voxels stay empty.
Volume read_volume_header(const std::string& name_or_path);

/// The files that load_volume would read, none for a built-in volume: a header's own and its data file. Tells nothing
/// wrong; what is, load_volume tells.
std::vector<std::filesystem::path> files_of(const std::string& name_or_path);

/// Writes by extension: .nrrd (gzip), .nhdr, .nii, .nii.gz, .mha (zlib), .mhd; in the volume's stored type unless
/// `type` says otherwise (values that do not fit the type are an error, not a clamp), with the volume's place in the
/// body. Atomic.
void save_volume(const Volume& volume, const std::filesystem::path& path, VoxelType type);

/// The data file that save_volume writes beside a header of its own, .nhdr or .mhd; empty for other endings.
std::filesystem::path data_file_of(const std::filesystem::path& header);

/// Names that `load_volume` knows without a path.
std::vector<std::string> known_volume_names();

const char* to_string(VoxelType type);

}  // namespace fastsplat::volume
