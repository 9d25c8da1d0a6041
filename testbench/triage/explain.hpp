// SPDX-License-Identifier: Apache-2.0
// The operands behind one word of the model, recomputed unit by unit, for divergence reports.
#pragma once

#include <string>

#include "testbench/check/scoreboard.hpp"
#include "testbench/check/verify.hpp"

namespace fastsplat::testbench {

/// One line with the operands of a word. For a footprint: the two RLUT words, q and the radial index. For a sheet word:
/// the sum before and the product. For a composited word: T, the sheet's sums and the slab; and so on. Empty if the
/// model lacks such an event.
std::string explain(const BeatSource& source, const cmodel::Config& config, const Divergence& divergence);

}  // namespace fastsplat::testbench
