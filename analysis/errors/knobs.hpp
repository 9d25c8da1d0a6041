// SPDX-License-Identifier: Apache-2.0
// The keys that a search changes, in steps from its start: a bit, or a factor of two.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

struct Knob {
  const char* key;
  int cmodel::Config::*member;
};
/// snap.phases also changes position.frac_bits, and composite.frac_bits also composite.freeze_below (whose level
/// stays). The last knob, composite.freeze_below itself, only gets finer than at the start: it costs no bits.
std::span<const Knob> knobs();
std::size_t freeze_knob();

/// Per knob: above 0 finer, below 0 coarser.
using Steps = std::vector<int>;

/// nullopt if the result is not a valid configuration, or cannot be built in RTL although `from` can.
std::optional<cmodel::Config> turned(const cmodel::Config& from, const Steps& steps);

}  // namespace fastsplat::analysis
