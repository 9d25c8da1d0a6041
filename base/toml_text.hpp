// SPDX-License-Identifier: Apache-2.0
// Parses all TOML, and reports its errors, in one place.
#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <string>

#include "base/error.hpp"
#include "base/nesting.hpp"

namespace fastsplat {

/// "file:line:column"
inline std::string place_in(const std::string& file, const toml::source_position& at) {
  return file + ":" + std::to_string(at.line) + ":" + std::to_string(at.column);
}

/// The table of `text`. Throws UserError (Input) with the place in `file` if it is invalid TOML or nests too deeply.
inline toml::table parse_toml(const std::string& text, const std::string& file, const std::string& fix) {
  if (const auto deep = toml_too_deep(text)) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(*deep);
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw_input({.where = file + ":" + std::to_string(line),
                 .what = "tables and arrays are nested too deeply",
                 .expected = "at most " + std::to_string(kDeepestNesting) + " levels",
                 .got = {},
                 .fix = fix});
  }
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw_input({.where = place_in(file, error.source().begin),
                 .what = "not valid TOML: " + std::string(error.description()),
                 .expected = {},
                 .got = {},
                 .fix = fix});
  }
}

}  // namespace fastsplat
