// "did you mean": the nearest known name to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fastsplat {

/// Edits from one to the other: a character more, less or another, or two neighbours exchanged.
int edit_distance(std::string_view a, std::string_view b);

/// Whether who wrote `got` may have meant `name`: a third of its letters wrong at most, and never more than three.
/// Dashes before a word are none of it.
bool may_mean(std::string_view got, std::string_view name);

/// "did you mean 'x'?" for the nearest of `known` that may have been meant, else empty.
std::string did_you_mean(std::string_view got, std::span<const std::string> known);

/// The same, else "known: a, b, c".
std::string suggestion(std::string_view got, std::span<const std::string> known);

}  // namespace fastsplat
