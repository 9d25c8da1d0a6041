// The splats of a scene as the device's numbers: projected, quantised, not yet cut into slabs or tiles.
#pragma once

#include <cstdint>
#include <vector>

#include "base/progress.hpp"
#include "cmodel/config.hpp"
#include "driver/radius_sets.hpp"
#include "driver/slices.hpp"
#include "scene/scene.hpp"
#include "scene/sheet_plan.hpp"

namespace fastsplat::driver {

/// 32 bytes a voxel: what a frame keeps in memory.
struct ProjectedSplat {
  std::int32_t x = 0, y = 0;  ///< image pixels, pf fraction bits
  std::int32_t depth = 0;     ///< Slices::quantise_depth, or the sheet number where splats are not sliced
  std::uint32_t set = 0;      ///< radius set
  SplatWords words{};         ///< whole splat, U 4.cf
};

struct Projected {
  std::vector<ProjectedSplat> splats;  ///< in traversal order
  RadiusSets sets;
  std::uint64_t voxels = 0;     ///< non-empty voxels
  std::uint64_t saturated = 0;  ///< voxels whose colour or optical depth left U 4.cf
  std::uint64_t vanished = 0;   ///< voxels whose words all rounded to 0
};

Projected project(const scene::Scene& scene, const cmodel::Config& config, const Slices& slices,
                  const scene::SheetPlan& plan);

}  // namespace fastsplat::driver
