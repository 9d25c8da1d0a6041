// Other programs that this one may call.
#pragma once

#include <string>

namespace fastsplat {

/// The path at which the shell would find it; empty if it would not.
std::string path_of(const std::string& program);

/// Whether the shell would find it.
bool in_path(const std::string& program);

}  // namespace fastsplat
