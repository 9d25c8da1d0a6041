// SPDX-License-Identifier: Apache-2.0
// The program's version, defined by project(... VERSION) in the top CMakeLists.txt.
#pragma once

#include <string>

namespace fastsplat {

std::string program_version();  ///< "0.2.0"

}  // namespace fastsplat
