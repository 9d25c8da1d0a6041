// SPDX-License-Identifier: Apache-2.0
// Parses numbers in text, independent of locale and as a whole word: "0x10", "1e" and "3 " are invalid.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace fastsplat {

/// Any number that a double has, also nan and inf; a leading + is allowed. Values too small are 0, values too large
/// infinite.
inline std::optional<double> double_from(std::string_view text) {
  if (text.size() > 1 && text[0] == '+') text.remove_prefix(1);
  double value = 0.0;
  auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::invalid_argument || stop != text.data() + text.size()) return std::nullopt;
  if (error == std::errc{}) return value;
  // from_chars does not distinguish the two: a wider type does, and beyond that the exponent's sign.
  long double wide = 0.0L;
  error = std::from_chars(text.data(), text.data() + text.size(), wide).ec;
  const bool small = error == std::errc{} ? std::abs(wide) < 1.0L : text.find('-', 1) != text.npos;
  return small ? 0.0 : std::copysign(HUGE_VAL, text.starts_with('-') ? -1.0 : 1.0);
}

/// A finite number; a leading + is allowed.
inline std::optional<double> number_from(std::string_view text) {
  const auto value = double_from(text);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

/// An integer that fits T.
template <class T>
std::optional<T> integer_from(std::string_view text) {
  T value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace fastsplat
