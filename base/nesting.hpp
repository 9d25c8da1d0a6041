// How deeply a text file may nest. Its parser, its writers and its destructors recurse, so a file that nests without a
// bound ends the process. These functions neither recurse nor check the grammar: the parser does that afterwards.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace fastsplat {

/// The deepest file of this program nests six levels.
inline constexpr std::size_t kDeepestNesting = 64;

/// The byte offset at which JSON first nests deeper than kDeepestNesting.
std::optional<std::size_t> json_too_deep(std::string_view json);

/// The same for TOML. Arrays, inline tables, each part of a [header] and each part of a dotted key is a level.
std::optional<std::size_t> toml_too_deep(std::string_view toml);

}  // namespace fastsplat
