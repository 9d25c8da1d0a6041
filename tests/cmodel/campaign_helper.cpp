#include "tests/cmodel/campaign_helper.hpp"

#include "tests/cmodel/random_stream_helper.hpp"

namespace fastsplat::test {

Campaign compare_streams(const cmodel::Config& config, Random& random, std::uint64_t splats, std::uint64_t per_stream) {
  Campaign result;
  const oracle::Symbols symbols = symbols_of(config);
  while (result.splats < splats && result.comparison.mismatches == 0) {
    const RandomStream stream = random_stream(symbols, random, per_stream);
    result.comparison += compare(run_model(config, stream.bytes), oracle::render(symbols, stream.bytes));
    result.splats += stream.splats;
  }
  return result;
}

}  // namespace fastsplat::test
