// SPDX-License-Identifier: Apache-2.0
// The driver's tables, from docs/numerics.md, sections 4, 6 and 8, alone.
#pragma once

#include <cstdint>
#include <vector>

#include "tests/driver/oracle/given.hpp"

namespace fastsplat::scene_oracle {

struct RadiusSet {
  double r = 0.0;  ///< pixels
  std::int64_t rho = 0, base = 0;
  std::int64_t E = 0, Ea = 0;
};
/// Without its base.
RadiusSet radius_set(const oracle::Symbols& symbols, double r);

std::vector<std::uint32_t> rlut(const oracle::Symbols& symbols, const RadiusSet& set);
/// The tables that the set loads, in every kind of index.
std::vector<std::uint32_t> set_words(const Given& given, const RadiusSet& set);
std::vector<std::uint32_t> radial(const Given& given);
std::vector<std::uint32_t> factor(const oracle::Symbols& symbols);

/// PHI[0..M]; M is even.
std::vector<std::int64_t> phi(const Given& given);

/// floor(real + 1/2).
std::int64_t nearest(double real);

}  // namespace fastsplat::scene_oracle
