// SPDX-License-Identifier: Apache-2.0
// The stream of a source that receives verdicts: without the splats of hidden sets (docs/microarchitecture.md,
// "Source").
#pragma once

#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"

namespace fastsplat::testbench {

/// `beats`: a legal stream. The model decides which cull groups are hidden.
std::vector<cmodel::Beat> without_hidden_sets(const cmodel::Config& config, const std::vector<cmodel::Beat>& beats);

}  // namespace fastsplat::testbench
