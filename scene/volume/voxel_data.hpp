// From the bytes of a volume file to voxels: bounds, byte order, scaling, placement. Shared by all formats.
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

/// What a header says, checked against nothing yet.
struct VoxelSource {
  std::filesystem::path header;  ///< for messages
  std::filesystem::path data;    ///< the same file, unless the header is detached
  Packing packing = Packing::Plain;
  std::uint64_t file_offset = 0;    ///< where on disk the data (or the gzip member) starts
  std::uint64_t stream_offset = 0;  ///< bytes to skip after unpacking
  Component component = Component::U8;
  std::endian order = std::endian::little;
  std::array<std::uint64_t, 3> extents{};  ///< in the file's axes, x fastest
  std::array<double, 3> spacing{1, 1, 1};  ///< mm, in the file's axes
  double slope = 1.0, intercept = 0.0;     ///< value = slope * stored + intercept
  std::optional<Placement> placement;      ///< absent: the header does not say
  std::vector<std::string> remarks;        ///< for Volume::remarks
};

/// Throws UserError (Input) unless extents and spacing make sense and the data file can hold that many voxels (gzip
/// cannot shrink below 1/1032, bzip2 below a two-millionth). Allocates nothing.
void check_source(const VoxelSource& source);

/// dims, spacing, stored type; no voxels. 32-bit integers and doubles are announced as F32.
Volume describe_source(const VoxelSource& source);

/// Reads the voxels. Stored types: 8/16-bit as they are; float, double and whatever is scaled as F32; 32-bit integers
/// as the smallest of the others that holds them exactly, else refused. NaN and Inf become `nan_as`, or are refused
/// with count and place. What is odd is in Volume::remarks.
Volume read_source(const VoxelSource& source, std::optional<float> nan_as = {});

}  // namespace fastsplat::volume
