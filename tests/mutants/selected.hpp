// Which mutant a program of mutated C++ sources runs with: FASTSPLAT_MUTANT in its environment, none without it.
#pragma once

#include <cstdlib>
#include <type_traits>

namespace fastsplat_mutants {

inline int selected() {
  static const int number = [] {
    const char* text = std::getenv("FASTSPLAT_MUTANT");
    return text == nullptr ? 0 : std::atoi(text);
  }();
  return number;
}

/// What the compiler works out is never mutated.
constexpr bool is(int number) { return !std::is_constant_evaluated() && number == selected(); }

}  // namespace fastsplat_mutants
