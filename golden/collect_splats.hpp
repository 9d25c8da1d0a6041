// The splats of a scene, by several threads.
#pragma once

#include <vector>

#include "scene/splats.hpp"

namespace fastsplat::golden {

/// What scene::collect_splats gives, in its order, on `threads` threads (0: all cores). They are counted first, so that
/// memory holds each splat once and none is ever moved.
std::vector<scene::Splat> collect_splats(const scene::Scene& scene, int threads);

}  // namespace fastsplat::golden
