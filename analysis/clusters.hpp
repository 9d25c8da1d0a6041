// SPDX-License-Identifier: Apache-2.0
// Finds clusters of large errors.
#pragma once

#include <vector>

#include "analysis/compare.hpp"

namespace fastsplat::analysis {

/// 8-connected groups of pixels with |error| >= threshold: the `most` worst, by max, then sum, then position.
/// `pixel_errors` is worst_channel(); Cluster::worst has position and error only (the caller adds channel and values).
std::vector<Cluster> find_clusters(const std::vector<double>& pixel_errors, int width, int height, double threshold,
                                   int most);

}  // namespace fastsplat::analysis
