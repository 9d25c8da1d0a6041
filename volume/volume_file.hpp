// Volumes from files and by name: NRRD (teem), NIfTI (nifti2), synthetics.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "volume/volume.hpp"

namespace fastsplat::volume {

/// Finds what the user named: an existing path; a synthetic "name[:size]"; or a scan of the Debian package
/// mricron-data by its bare name (`ch2`, `ch2bet`, `inia19-t1-brain`, searched in $FASTSPLAT_DATA and
/// /usr/share/mricron/templates). Every failure is a UserError (ExitCode::Input) with the fix.
/// Where a file's header says how its axes lie in a body (NIfTI sform/qform, NRRD space), whole axes are turned so that
/// +x is right, +y anterior, +z superior; oblique angles are not resampled.
Volume load_volume(const std::string& name_or_path);

/// Reads only the header: dims, spacing, type; voxels stay empty.
Volume read_volume_header(const std::string& name_or_path);

/// The files that load_volume would read, none for a built-in volume: a header's own and its data file. Tells nothing
/// wrong; what is, load_volume tells.
std::vector<std::filesystem::path> files_of(const std::string& name_or_path);

/// Writes by extension: .nrrd (gzip), .nhdr, .nii, .nii.gz; in the volume's stored type unless `type` says otherwise
/// (values that do not fit the type are an error, not a clamp). Atomic.
void save_volume(const Volume& volume, const std::filesystem::path& path, VoxelType type);

/// The data file that save_volume writes beside a .nhdr.
std::filesystem::path data_file_of(const std::filesystem::path& nhdr);

/// Names that `load_volume` knows without a path.
std::vector<std::string> known_volume_names();

const char* to_string(VoxelType type);

}  // namespace fastsplat::volume
