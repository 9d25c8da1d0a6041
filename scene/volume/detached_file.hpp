// Headers that name another file for their voxels: which names are followed.
#pragma once

#include <filesystem>
#include <string>

namespace fastsplat::volume {

/// The file that `header` names at `place` ("v.nhdr:7"): in the header's own folder or below, links followed. Absolute
/// names, "..", links to elsewhere and names of several files (a list, a pattern) are UserErrors (Input). That the file
/// is there is not checked.
std::filesystem::path detached_file(const std::filesystem::path& header, const std::string& place,
                                    const std::string& name);

}  // namespace fastsplat::volume
