// SPDX-License-Identifier: Apache-2.0
// The operators of docs/floats.md in RTL against IEEE 754 in integers: every pair of operands, up to their order and the
// sign of both. usage: compare EXPONENT FRACTION
#include <cstdio>
#include <cstdlib>

#include "Voperators.h"
#include "tests/pipeline/oracle/soft_float.hpp"

namespace {

template <class Soft>
int compare() {
  Voperators unit;
  const std::uint32_t numbers = Soft::kSign;
  unsigned long long operations = 0, different = 0;
  const auto same = [](std::uint32_t a, std::uint32_t b) { return a == b || (Soft::is_nan(a) && Soft::is_nan(b)); };
  for (std::uint32_t a = 0; a < numbers; ++a) {
    for (std::uint32_t b = a; b < numbers; ++b) {
      for (const std::uint32_t other : {b, b | Soft::kSign}) {
        // Also in the other order, in turns.
        const bool turned = ((a + b) & 1) != 0;
        unit.a_i = turned ? other : a, unit.b_i = turned ? a : other;
        unit.eval();
        operations += 2;
        if (same(unit.sum_o, Soft::plus(a, other)) && same(unit.product_o, Soft::times(a, other))) continue;
        if (different++ < 5)
          std::printf("%04x, %04x: sum %04x, product %04x; expected %04x, %04x\n", a, other, unit.sum_o, unit.product_o,
                      Soft::plus(a, other), Soft::times(a, other));
      }
    }
  }
  std::printf("[figure] operations %llu, different %llu (limit 0)\n", operations, different);
  return different == 0 && operations == 2ULL * numbers * (numbers + 1ULL) ? 0 : 1;
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) return 2;
  const int exponent = std::atoi(words[1]), fraction = std::atoi(words[2]);
  if (exponent == 5 && fraction == 10) return compare<fastsplat::stages::oracle::SoftFloat<5, 10>>();
  if (exponent == 8 && fraction == 7) return compare<fastsplat::stages::oracle::SoftFloat<8, 7>>();
  return 2;
}
