// Where the large errors sit together.
#pragma once

#include <vector>

#include "analysis/compare.hpp"

namespace fastsplat::analysis {

/// 8-connected groups of pixels with |error| >= threshold, the `most` worst: by max, then sum, then place.
/// `pixel_errors` is worst_channel(); Cluster::worst has place and error only (channel and values are the caller's).
std::vector<Cluster> find_clusters(const std::vector<double>& pixel_errors, int width, int height, double threshold,
                                   int most);

}  // namespace fastsplat::analysis
