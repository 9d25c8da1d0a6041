// SPDX-License-Identifier: Apache-2.0
#include "base/version.hpp"

namespace fastsplat {

std::string program_version() { return FASTSPLAT_VERSION; }

}  // namespace fastsplat
