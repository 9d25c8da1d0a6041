// SPDX-License-Identifier: Apache-2.0
// Data files named by detached headers, and which names are accepted.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/volume/text_header.hpp"

namespace fastsplat::volume {

/// Whether a field that names data files lists them on the lines after it ("LIST", "LIST 2").
bool says_list(const std::string& value);

/// The files that `field` of `header` names, at least one: a name, `PATTERN MIN MAX STEP` with one %d or %03d in the
/// pattern, or LIST for header.listed_files. Each lies in the header's own folder or below, links followed. Absolute
/// names, ".." and links to elsewhere are UserErrors (Input). The existence of the files is not checked.
/// `sizes`: along all axes. Several files hold whole pieces: of all axes but the last, or of as many axes as the field
/// says; another number of files is a UserError (Input).
std::vector<std::filesystem::path> detached_files(const TextHeader& header, const TextHeader::Field& field,
                                                  const std::vector<std::uint64_t>& sizes);

}  // namespace fastsplat::volume
