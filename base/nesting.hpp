// SPDX-License-Identifier: Apache-2.0
// Limits how deeply a text file may nest. Parsers, writers and destructors recurse, so unbounded nesting would end the
// process. These functions neither recurse nor check the grammar; the parser does that afterwards.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace fastsplat {

/// The deepest file that this program writes nests six levels.
inline constexpr std::size_t kDeepestNesting = 64;

/// The byte offset at which JSON first nests deeper than kDeepestNesting.
std::optional<std::size_t> json_too_deep(std::string_view json);

/// The same for TOML. Each array, inline table, part of a [header] and part of a dotted key is a level.
std::optional<std::size_t> toml_too_deep(std::string_view toml);

}  // namespace fastsplat
