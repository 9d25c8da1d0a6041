// SPDX-License-Identifier: Apache-2.0
#include "targets_helper.hpp"

#include <hwy/highway.h>
#include <hwy/targets.h>

namespace fastsplat::golden::testing {

Targets::Targets() {
  // The processor's bits for the instruction sets that code was compiled for.
  for (auto left = static_cast<std::uint64_t>(hwy::SupportedTargets()) & static_cast<std::uint64_t>(HWY_TARGETS);
       left != 0; left &= left - 1) {
    all_.push_back(left & -left);
  }
}

void Targets::choose(std::uint64_t target) {
  hwy::SetSupportedTargetsForTest(static_cast<std::int64_t>(target));
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

}  // namespace fastsplat::golden::testing
