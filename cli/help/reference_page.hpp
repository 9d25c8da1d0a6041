// SPDX-License-Identifier: Apache-2.0
// The reference in Markdown (docs/guide/reference.md): all subcommands and flags, keys of scene.toml, which keys
// combine, configurations, exit codes. Generated from the tables that the program itself uses.
#pragma once

#include <string>
#include <vector>

#include "cli/description.hpp"

namespace fastsplat::cli {

/// `all` begins with the program itself, as describe() returns it.
std::string reference_page(const std::vector<Description>& all);

}  // namespace fastsplat::cli
