// The keys that a search turns, in steps from where it began: a bit, or a factor of two.
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
/// snap.phases takes position.frac_bits along, composite.frac_bits takes composite.freeze_below (its level stays).
/// The last one, composite.freeze_below itself, is turned only finer than it was: it costs no bits.
std::span<const Knob> knobs();
std::size_t freeze_knob();

/// Per knob: above 0 finer, below 0 coarser.
using Steps = std::vector<int>;

/// Nothing where no configuration is that, or where `from` can be built in RTL and that cannot.
std::optional<cmodel::Config> turned(const cmodel::Config& from, const Steps& steps);

}  // namespace fastsplat::analysis
