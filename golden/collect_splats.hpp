// SPDX-License-Identifier: Apache-2.0
// Collects the splats of a scene on several threads.
#pragma once

#include <vector>

#include "scene/splats.hpp"

namespace fastsplat::golden {

/// Returns scene::collect_splats' splats in the same order, on `threads` threads (0: all cores). Counts them first, so
/// that each splat is stored once and never moved.
std::vector<scene::Splat> collect_splats(const scene::Scene& scene, int threads);

}  // namespace fastsplat::golden
