// SPDX-License-Identifier: Apache-2.0
// Converts the bytes of a volume file to voxels: bounds, byte order, scaling, placement. Shared by all formats.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scene/volume/placement.hpp"
#include "scene/volume/stored_values.hpp"
#include "scene/volume/volume.hpp"

namespace fastsplat::volume {

struct DataFile {
  std::filesystem::path path;
  std::uint64_t file_offset = 0;    ///< start of the voxels (or of the gzip member) on disk
  std::uint64_t stream_offset = 0;  ///< bytes to skip after unpacking
};

/// The declarations of a header, not yet checked.
struct VoxelSource {
  std::filesystem::path header;  ///< for messages
  std::vector<DataFile> files;   ///< the header itself unless detached; each has the same number of voxels, x fastest
  Packing packing = Packing::Plain;
  Component component = Component::U8;
  std::endian order = std::endian::little;
  std::array<std::uint64_t, 3> extents{};  ///< in the file's axes, x fastest
  std::array<double, 3> spacing{1, 1, 1};  ///< mm, in the file's axes
  double slope = 1.0, intercept = 0.0;     ///< value = slope * stored + intercept
  std::optional<Placement> placement;      ///< absent: not declared
  std::vector<std::string> remarks;        ///< for Volume::remarks

  std::uint64_t voxels() const { return extents[0] * extents[1] * extents[2]; }
  std::uint64_t voxels_per_file() const { return voxels() / files.size(); }
};

/// Throws UserError (Input) unless extents and spacing are valid and the data files can hold that many voxels (gzip
/// cannot shrink below 1/1032, bzip2 below a two-millionth). Allocates nothing.
void check_source(const VoxelSource& source);

/// dims, spacing, stored type; no voxels. Wider integers and doubles are reported as F32.
Volume describe_source(const VoxelSource& source);

/// Reads the voxels. Stored types: 8/16-bit unchanged; float, double and scaled values as F32; 32- and 64-bit integers
/// as the smallest other type that holds them all. Values that do not fit a float are rounded, with a remark. NaN and
/// Inf become `nan_as`, or are refused with count and place. Oddities are listed in Volume::remarks.
Volume read_source(const VoxelSource& source, std::optional<float> nan_as = {});

}  // namespace fastsplat::volume
