// SPDX-License-Identifier: Apache-2.0
// "did you mean": the nearest known name to a mistyped one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace fastsplat {

/// Number of edits between two words: insert, remove or replace a character, or exchange two neighbours.
int edit_distance(std::string_view a, std::string_view b);

/// Whether `got` may be a typing error of `name`: at most a third of its letters wrong, and at most three. Leading
/// dashes are ignored.
bool may_mean(std::string_view got, std::string_view name);

/// "did you mean 'x'?" for the nearest of `known` that may have been meant, else empty.
std::string did_you_mean(std::string_view got, std::span<const std::string> known);

/// The same, else "known: a, b, c".
std::string suggestion(std::string_view got, std::span<const std::string> known);

}  // namespace fastsplat
