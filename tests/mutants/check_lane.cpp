// SPDX-License-Identifier: Apache-2.0
// check_mutants_density_lane CONFIG.toml: the pixel stage's lane by itself, whose last bits whole streams are too short
// for.
#include "Vfs_mutants_density_lane.h"
#include "driver/config/config_file.hpp"
#include "tests/classify/lane_bench_helper.hpp"
#include "tests/mutants/serve_mutants.hpp"

namespace fastsplat::test {
namespace {

/// Sets of tables, each for thousands of pixels: a glance, and enough for what one pixel in a million shows.
constexpr int kGlance = 20, kLong = 2000;

Named pixels(const std::string& name, const cmodel::Config& config, std::uint64_t seed, int sets_of_tables) {
  return {name, [=] {
            const LaneResult result = LaneBench<Vfs_mutants_density_lane>(config).run(seed, sets_of_tables);
            return Said{result.different, result.pixels};
          }};
}

}  // namespace
}  // namespace fastsplat::test

int main(int argc, char** argv) {
  return fastsplat::test::mutants_main(argc, argv, [](const char* path) {
    const auto config = fastsplat::driver::load_config(path);
    return std::vector{fastsplat::test::pixels("pixels", config, 1, fastsplat::test::kGlance),
                       fastsplat::test::pixels("more pixels", config, 2, fastsplat::test::kLong)};
  });
}
