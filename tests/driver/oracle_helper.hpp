// SPDX-License-Identifier: Apache-2.0
// The driver beside its oracle: random scenes, every beat of a frame compared, and counts of the comparisons.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"
#include "tests/cmodel/random_helper.hpp"
#include "tests/driver/oracle/frame.hpp"

namespace fastsplat::driver {

/// A volume of given voxels; 0 and 1 are the ends of the transfer functions' range.
std::shared_ptr<const volume::Volume> volume_of(glm::ivec3 dims, glm::dvec3 spacing, std::vector<float> voxels);

struct OracleFigures {
  std::uint64_t frames = 0, refused = 0, beats = 0, words = 0;
  scene_oracle::Met met;
  std::uint64_t hash = 0xcbf29ce484222325U;  ///< FNV-1a of all words: must not depend on the processor
  std::uint64_t mismatches = 0;              ///< frames with one
  std::string first;                         ///< the first of them, in words
};
/// Compiles the scene in both ways and compares every beat, the counts of the report and refusals.
void compare_with_oracle(const std::string& name, const scene::Scene& scene, const cmodel::Config& config,
                         OracleFigures& figures);
/// `rounds` over all configurations, methods and both projections, then random configurations.
void compare_random_frames(test::Random& random, int rounds, int random_configs, OracleFigures& figures);
/// The same with another index.kind, blit2d with and without symmetry; its configurations have few phases and columns.
void compare_random_frames_of(cmodel::IndexKind kind, test::Random& random, int rounds, int random_configs,
                              OracleFigures& figures);
/// One figure per line; expects no mismatch.
void print_and_expect_equal(const OracleFigures& figures);
/// Expects that every case of the page occurred, except the rims of the first and last slab and ellipses, which need
/// special scenes.
void expect_all_met(const OracleFigures& figures);

}  // namespace fastsplat::driver
