// SPDX-License-Identifier: Apache-2.0
// A suggestion that makes a step's error smaller: the nearest finer configuration.
#pragma once

#include <optional>
#include <string>

#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

struct Suggestion {
  cmodel::Config config;
  std::string changes;  ///< "snap.phases 64 -> 256, position.frac_bits 6 -> 8"
};

/// Two more bits for the step's words (a quarter of its step size), or one more integer bit. nullopt if the limits of
/// the configuration do not allow it. `gaussians`: for a frame of 3-D Gaussians.
std::optional<Suggestion> suggestion(stages::Step step, const cmodel::Config& config, bool gaussians);

/// Keys that differ, in the order of the table: "snap.phases 64 -> 256".
std::string changes(const cmodel::Config& from, const cmodel::Config& to);

}  // namespace fastsplat::analysis
