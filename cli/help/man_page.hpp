// SPDX-License-Identifier: Apache-2.0
// Man pages in the man macros of man, groff and mandoc: one for the program, one per subcommand.
#pragma once

#include <string>
#include <vector>

#include "cli/description.hpp"

namespace fastsplat::cli {

/// "fastsplat-stream-record" for "stream record", "fastsplat" for the program.
std::string man_page_name(const Description& subcommand);

/// The page of `subcommand`, an entry of `all`; the program's own if its name is empty.
std::string man_page(const Description& subcommand, const std::vector<Description>& all);

}  // namespace fastsplat::cli
