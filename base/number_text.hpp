// SPDX-License-Identifier: Apache-2.0
// Parses numbers that a user typed, independent of locale and as a whole word: "0x10", "1e", "nan", "inf" and "3 "
// are invalid.
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace fastsplat {

/// A finite number; a leading + is allowed.
inline std::optional<double> number_from(std::string_view text) {
  if (text.size() > 1 && text[0] == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
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
