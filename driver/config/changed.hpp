// SPDX-License-Identifier: Apache-2.0
// A configuration with some of its keys changed: what --set does.
#pragma once

#include <span>
#include <string>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::driver {

/// A change as it is typed: "--set KEY=VALUE", or "--index KIND", which is short for index.kind=KIND.
std::string as_flag(const std::string& change);

/// `config` with `changes`, each "KEY=VALUE" or "--index KIND". Each key is set once; limits between keys hold after the last. The name
/// lists the differences, in the order of the keys: "base+radial.entries=256". Throws UserError (Usage) that names the
/// invalid flag.
cmodel::Config changed(const cmodel::Config& config, std::span<const std::string> changes);

}  // namespace fastsplat::driver
