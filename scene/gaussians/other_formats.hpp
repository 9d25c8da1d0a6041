// Files of 3-D Gaussians that are not read, recognised by their first bytes and by their endings.
#pragma once

#include <filesystem>
#include <string_view>

namespace fastsplat::scene {

/// Bytes of a file's beginning that recognising it takes.
inline constexpr std::size_t kHeadBytes = 8192;

/// UserError (Input) for a file that is of another format than .ply and .splat: what it is, and what makes a .ply of
/// it. `head`: the file's first kHeadBytes, or all of it; empty for a file that is not there.
void refuse_other_formats(const std::filesystem::path& path, std::string_view head);

/// A PLY file, whatever it is called.
bool is_ply(std::string_view head);
/// Every record of the head is one that a .splat could hold: no other format is likely to be so.
bool looks_like_splat(std::string_view head);

}  // namespace fastsplat::scene
