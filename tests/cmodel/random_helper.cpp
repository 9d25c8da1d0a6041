// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/random_helper.hpp"

#include <cstdio>
#include <cstdlib>

namespace fastsplat::test {

std::uint64_t seed_or(std::uint64_t usual) {
  const char* given = std::getenv("FASTSPLAT_SEED");
  const std::uint64_t seed = given != nullptr ? std::strtoull(given, nullptr, 0) : usual;
  std::printf("[seed] %llu (replay with FASTSPLAT_SEED=%llu)\n", static_cast<unsigned long long>(seed),
              static_cast<unsigned long long>(seed));
  return seed;
}

}  // namespace fastsplat::test
