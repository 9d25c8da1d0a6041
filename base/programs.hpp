// Other programs that this one may call.
#pragma once

#include <string>

namespace fastsplat {

/// Where the shell would find it; empty: nowhere.
std::string path_of(const std::string& program);

/// Whether the shell would find it.
bool in_path(const std::string& program);

}  // namespace fastsplat
