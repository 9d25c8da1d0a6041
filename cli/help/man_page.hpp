// Manual pages, in the man macros that man, groff and mandoc read: one of the program, one of each verb.
#pragma once

#include <string>
#include <vector>

#include "cli/description.hpp"

namespace fastsplat::cli {

/// "fastsplat-stream-record" of "stream record", "fastsplat" of the program.
std::string man_page_name(const Description& verb);

/// The page of `verb`, which is one of `all`; the program's own where its name is empty.
std::string man_page(const Description& verb, const std::vector<Description>& all);

}  // namespace fastsplat::cli
