// The reference in Markdown (docs/guide/reference.md): every subcommand and flag, the keys of scene.toml, what goes
// with what, configurations and exit codes. All of it comes from what the program itself reads.
#pragma once

#include <string>
#include <vector>

#include "cli/description.hpp"

namespace fastsplat::cli {

/// `all` begins with the program itself, as describe() returns it.
std::string reference_page(const std::vector<Description>& all);

}  // namespace fastsplat::cli
