// SPDX-License-Identifier: Apache-2.0
#include "testbench/stimulus/left_out.hpp"

#include "cmodel/model.hpp"

namespace fastsplat::testbench {

std::vector<cmodel::Beat> without_hidden_sets(const cmodel::Config& config, const std::vector<cmodel::Beat>& beats) {
  cmodel::NullPixels nowhere;
  cmodel::Model model(config, cmodel::StreamScope::Subset, nowhere);
  std::vector<cmodel::Beat> out;
  for (const cmodel::Beat& beat : beats) {
    const std::uint64_t before = model.culls().dropped;
    model.consume({&beat, 1});
    if (model.culls().dropped == before) out.push_back(beat);
  }
  return out;
}

}  // namespace fastsplat::testbench
