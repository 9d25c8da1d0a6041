// SPDX-License-Identifier: Apache-2.0
// Parses all TOML, and reports its errors, in one place.
#pragma once

#include <toml++/toml.h>

#include <string>

#include "base/toml/toml_kind.hpp"

namespace fastsplat {

/// "file:line:column"
std::string place_in(const std::string& file, const toml::source_position& at);

/// The table of `text`. Throws UserError (Input) with the place in `file` if it is invalid TOML or nests too deeply, or
/// if it is a file of another kind, as its keys show.
toml::table parse_toml(const std::string& text, const std::string& file, TomlKind kind);

}  // namespace fastsplat
