// SPDX-License-Identifier: Apache-2.0
// A file that another file names: only in that file's own folder or below, links followed.
#pragma once

#include <filesystem>
#include <string>

namespace fastsplat {

/// The path of the file that `header` calls `name`. Absolute names, ".." and links to elsewhere are UserErrors (Input)
/// at `where`. The existence of the file is not checked.
std::filesystem::path file_beside(const std::filesystem::path& header, const std::string& name,
                                  const std::string& where);

}  // namespace fastsplat
