// SPDX-License-Identifier: Apache-2.0
// Names in error messages as the user typed them.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"

namespace fastsplat::cli {

/// `parts` with the flag in place of the key that it sets (of a scene, or index.kind), if `words` hold that flag:
/// "frame 3: --classify" for "frame 3: classify.order". Keys that came from a file stay.
ErrorParts as_typed(ErrorParts parts, const std::vector<std::string>& words);

}  // namespace fastsplat::cli
