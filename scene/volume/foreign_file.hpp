// Files that are not volumes of a format read here: what they are, and how to make one of them.
#pragma once

#include <filesystem>
#include <string>

namespace fastsplat::volume {

/// The name of a format that other programs read, by its first bytes; "" for others.
std::string foreign_format(const std::filesystem::path& path);

/// What to do with it: a program that converts it, or the header to write for raw voxels, whose size and type the
/// file's name may say ("engine_256x256x128_uint8.raw").
std::string way_to_read(const std::filesystem::path& path);

}  // namespace fastsplat::volume
