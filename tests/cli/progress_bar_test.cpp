// SPDX-License-Identifier: Apache-2.0
// Steps of a progress bar.
#include "cli/progress_bar.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace fastsplat::cli {
namespace {

TEST(ProgressBar, StepsFillTheirShareOfTheWhole) {
  std::vector<std::pair<std::size_t, std::size_t>> seen;
  const Progress whole = [&](std::size_t done, std::size_t total) { seen.emplace_back(done, total); };
  step_of(whole, 0, 2)(3, 3);
  step_of(whole, 1, 2)(0, 5);
  step_of(whole, 1, 2)(5, 5);
  EXPECT_EQ(seen, (std::vector<std::pair<std::size_t, std::size_t>>{{3, 6}, {5, 10}, {10, 10}}));
  EXPECT_FALSE(step_of({}, 0, 2)) << "no bar, no progress";
}

}  // namespace
}  // namespace fastsplat::cli
