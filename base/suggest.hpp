// "did you mean": the nearest known name to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fastsplat {

/// Levenshtein distance in characters.
int edit_distance(std::string_view a, std::string_view b);

/// "did you mean 'x'?" for the nearest of `known` within 3 edits, else "known: a, b, c".
std::string suggestion(std::string_view got, std::span<const std::string> known);

}  // namespace fastsplat
