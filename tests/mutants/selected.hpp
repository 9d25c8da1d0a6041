// SPDX-License-Identifier: Apache-2.0
// Which mutant a program of mutated C++ sources runs with: FASTSPLAT_MUTANT in its environment, none without it.
#pragma once

#include <cstdlib>
#include <type_traits>

namespace fastsplat_mutants {

inline const int selected = [] {
  const char* text = std::getenv("FASTSPLAT_MUTANT");
  return text == nullptr ? 0 : std::atoi(text);
}();

/// What the compiler works out is never mutated.
constexpr bool is(int number) { return !std::is_constant_evaluated() && number == selected; }

}  // namespace fastsplat_mutants
