// SPDX-License-Identifier: Apache-2.0
// Files in formats that are not read here: their format, and how to convert them.
#pragma once

#include <filesystem>
#include <string>

namespace fastsplat::volume {

/// The name of a format that other programs read, by its first bytes; "" if unknown.
std::string foreign_format(const std::filesystem::path& path);

/// A suggestion: a program that converts it, or the header to write for raw voxels. The file's name may give their size
/// and type ("engine_256x256x128_uint8.raw").
std::string way_to_read(const std::filesystem::path& path);

}  // namespace fastsplat::volume
