// The program's version; its owner is project(... VERSION) in the top CMakeLists.txt.
#pragma once

#include <string>

namespace fastsplat {

std::string program_version();  ///< "0.1.0"

}  // namespace fastsplat
