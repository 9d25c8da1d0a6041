// SPDX-License-Identifier: Apache-2.0
// Random streams by the thousand: model against oracle until enough splats were compared.
#pragma once

#include <cstdint>

#include "tests/cmodel/compare_helper.hpp"
#include "tests/cmodel/configs_helper.hpp"

namespace fastsplat::test {

struct Campaign {
  Comparison comparison;
  std::uint64_t splats = 0;
  oracle::EllipseWork ellipses;

  Campaign& operator+=(const Campaign& other);
};

/// Streams of about `per_stream` splats until `splats` were compared; stops at the first stream that differs.
Campaign compare_streams(const cmodel::Config& config, Random& random, std::uint64_t splats, std::uint64_t per_stream);

/// Prints how many of them were ellipses.
void print_ellipses(const char* name, const Campaign& campaign);

}  // namespace fastsplat::test
