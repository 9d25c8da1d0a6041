// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/campaign_helper.hpp"

#include <cstdio>

#include "tests/cmodel/random_stream_helper.hpp"

namespace fastsplat::test {

Campaign& Campaign::operator+=(const Campaign& other) {
  comparison += other.comparison;
  splats += other.splats;
  ellipses.records += other.ellipses.records;
  ellipses.windows += other.ellipses.windows;
  ellipses.weighted += other.ellipses.weighted;
  ellipses.wrapped += other.ellipses.wrapped;
  return *this;
}

Campaign compare_streams(const cmodel::Config& config, Random& random, std::uint64_t splats, std::uint64_t per_stream) {
  Campaign result;
  const oracle::Symbols symbols = symbols_of(config);
  while (result.splats < splats && result.comparison.mismatches == 0) {
    const RandomStream stream = random_stream(symbols, random, per_stream);
    const oracle::Rendering expected = oracle::render(symbols, stream.bytes);
    result += Campaign{compare(run_model(config, stream.bytes), expected), stream.splats, expected.ellipses};
  }
  return result;
}

void print_ellipses(const char* name, const Campaign& campaign) {
  std::printf(
      "[figure] %s: ellipses = %llu, their windows = %llu, their weighted pixels = %llu, with a coefficient "
      "modulo its word = %llu\n",
      name, static_cast<unsigned long long>(campaign.ellipses.records),
      static_cast<unsigned long long>(campaign.ellipses.windows),
      static_cast<unsigned long long>(campaign.ellipses.weighted),
      static_cast<unsigned long long>(campaign.ellipses.wrapped));
}

}  // namespace fastsplat::test
