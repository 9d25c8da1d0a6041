// SPDX-License-Identifier: Apache-2.0
// Files of 3-D Gaussians that are not read, recognised by their first bytes and by their endings.
#pragma once

#include <filesystem>
#include <string_view>

namespace fastsplat::scene {

/// Number of leading bytes that recognition needs.
inline constexpr std::size_t kHeadBytes = 8192;

/// The formats that are read, for messages.
inline constexpr const char* kReadFormats = ".ply, .splat, .spz, .sog, .ksplat or glTF";

/// Throws UserError (Input) for a file of another format, with its format and a program that makes a .ply of it.
/// `head`: the file's first kHeadBytes, or all of it; empty for a missing file.
void refuse_other_formats(const std::filesystem::path& path, std::string_view head);

/// Whether every record of the head is a valid .splat record, which is unlikely in other formats.
bool looks_like_splat(std::string_view head);

}  // namespace fastsplat::scene
