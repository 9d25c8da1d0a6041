// Other programs that this one may call.
#pragma once

#include <string>

namespace fastsplat::cli {

/// Whether the shell would find it.
bool in_path(const std::string& program);

}  // namespace fastsplat::cli
