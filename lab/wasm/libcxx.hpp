// SPDX-License-Identifier: Apache-2.0
// What the C++ libraries of Emscripten lack of C++20, as far as it is used here: reading floating-point numbers (Debian
// 12 and 13) and the algorithms of ranges (Debian 12).
#pragma once

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <iterator>
#include <memory>
#include <string>

namespace std {

/// As the standard's, for text without blanks in front; the C library's locale is always "C" here.
template <typename T>
requires is_floating_point_v<T> from_chars_result from_chars(const char* from, const char* to, T& value) {
  const string text(from, to);
  const bool hexadecimal = text.find_first_of("xX") != string::npos;
  if (text.empty() || text[0] == '+' || isspace(static_cast<unsigned char>(text[0])) || hexadecimal)
    return {from, errc::invalid_argument};
  char* end = nullptr;
  const long double wide = strtold(text.c_str(), &end);
  if (end == text.c_str()) return {from, errc::invalid_argument};
  const char* const stop = from + (end - text.c_str());
  const T narrow = is_same_v<T, float>    ? static_cast<T>(strtof(text.c_str(), nullptr))
                   : is_same_v<T, double> ? static_cast<T>(strtod(text.c_str(), nullptr))
                                          : static_cast<T>(wide);
  if ((isinf(narrow) && text.find_first_of("iI") == string::npos) || (narrow == 0 && wide != 0))
    return {stop, errc::result_out_of_range};
  value = narrow;
  return {stop, errc{}};
}

#if _LIBCPP_VERSION < 15000
template <typename To, typename From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

template <typename T>
auto make_unique_for_overwrite(size_t count) {
  return unique_ptr<T>(new remove_extent_t<T>[count]);
}

namespace ranges {

#define FASTSPLAT_OF_RANGE(name)                                             \
  template <typename R, typename... More>                                    \
  constexpr auto name(R&& range, More&&... more) {                           \
    return std::name(begin(range), end(range), std::forward<More>(more)...); \
  }
FASTSPLAT_OF_RANGE(find_if)
FASTSPLAT_OF_RANGE(count)
FASTSPLAT_OF_RANGE(count_if)
FASTSPLAT_OF_RANGE(fill)
FASTSPLAT_OF_RANGE(copy)
FASTSPLAT_OF_RANGE(copy_if)
FASTSPLAT_OF_RANGE(transform)
FASTSPLAT_OF_RANGE(for_each)
FASTSPLAT_OF_RANGE(reverse)
FASTSPLAT_OF_RANGE(replace)
FASTSPLAT_OF_RANGE(move)
#undef FASTSPLAT_OF_RANGE

// Used with a projection.
#define FASTSPLAT_BY_TEST(name)                                                                                    \
  template <typename R, typename Test, typename Projection = identity>                                             \
  constexpr bool name(R&& range, Test test, Projection projection = {}) {                                          \
    return std::name(begin(range), end(range), [&](auto&& one) { return invoke(test, invoke(projection, one)); }); \
  }
FASTSPLAT_BY_TEST(any_of)
FASTSPLAT_BY_TEST(all_of)
#undef FASTSPLAT_BY_TEST

#define FASTSPLAT_BY_ORDER(name)                                                             \
  template <typename R, typename Order = less, typename Projection = identity>               \
  constexpr auto name(R&& range, Order order = {}, Projection projection = {}) {             \
    return std::name(begin(range), end(range), [&](auto&& a, auto&& b) {                     \
      return static_cast<bool>(invoke(order, invoke(projection, a), invoke(projection, b))); \
    });                                                                                      \
  }
FASTSPLAT_BY_ORDER(max_element)
FASTSPLAT_BY_ORDER(min_element)
FASTSPLAT_BY_ORDER(sort)
FASTSPLAT_BY_ORDER(stable_sort)
#undef FASTSPLAT_BY_ORDER

template <typename R, typename Order = less, typename Projection = identity>
constexpr auto max(R&& range, Order order = {}, Projection projection = {}) {
  return *ranges::max_element(range, order, projection);
}
template <typename R, typename Order = less, typename Projection = identity>
constexpr auto min(R&& range, Order order = {}, Projection projection = {}) {
  return *ranges::min_element(range, order, projection);
}
template <typename R, typename T, typename Projection = identity>
constexpr auto find(R&& range, const T& value, Projection projection = {}) {
  return std::find_if(begin(range), end(range), [&](auto&& one) { return invoke(projection, one) == value; });
}

}  // namespace ranges
#endif

}  // namespace std
