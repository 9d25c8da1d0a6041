// A configuration with some of its keys changed: what --set does.
#pragma once

#include <span>
#include <string>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::driver {

/// `config` with `changes`, each "KEY=VALUE". Each key is set once; limits between keys hold after the last. What
/// differs is in its name, in the order of the keys: "base+radial.entries=256". UserError (Usage) names the --set that
/// is wrong.
cmodel::Config changed(const cmodel::Config& config, std::span<const std::string> changes);

}  // namespace fastsplat::driver
