// SPDX-License-Identifier: Apache-2.0
#include "scene/sheet_plan.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/error.hpp"
#include "scene/kernel_growth.hpp"
#include "scene/splats.hpp"

namespace fastsplat::scene {
namespace {

SlabGrid slabs_for_grown_kernels(const Scene& scene) {
  SlabGrid grid = slab_grid(scene);
  const auto slabs_more = [&](double depth) {
    return std::ceil((depth_growth(scene, depth) - 1.0) * scene.kernel.radius() / grid.width);
  };
  const double before = slabs_more(-scene.volume->bounding_radius());
  const double behind = slabs_more(scene.volume->bounding_radius());
  if (!(before + behind <= kMostSlabsMore)) {
    throw_usage({.where = {},
                 .what = "anti-aliasing: pixels hold so many voxels that kernels reach too many slabs",
                 .expected = fmt::format("at most {} additional slabs", kMostSlabsMore),
                 .got = fmt::format("{:.6g}", before + behind),
                 .fix = "raise --zoom, --size or --slab-width"});
  }
  grid.first -= before * grid.width;
  grid.count += static_cast<int>(before + behind);
  return grid;
}

SlabGrid xray_slabs(const Scene& scene) {
  const SlabGrid all = slab_grid(scene);
  const int sheets = scene.description.xray_sheets;
  return {.first = all.first, .width = all.count * all.width / sheets, .count = sheets};
}

}  // namespace

SlabGrid slab_grid(const Scene& scene) {
  const double reach = scene.volume->bounding_radius() / scene.volume->kernel_unit() + scene.kernel.radius();
  const double width = scene.description.slab_width;
  const double half = std::ceil(reach / width);
  return {.first = -half * width, .width = width, .count = 2 * static_cast<int>(half)};
}

SheetPlan sheet_plan(const Scene& scene, Method method) {
  switch (method) {
    case Method::ImageAligned:
      return {SheetUse::Sliced, slabs_for_grown_kernels(scene)};
    case Method::AxisAligned:
      return {SheetUse::GridSheet, {.count = axis_sheet_count(scene)}};
    case Method::XRay:
      return {scene.description.xray_sheets == 1 ? SheetUse::OneSheet : SheetUse::Sliced, xray_slabs(scene)};
    case Method::Westover:
    case Method::RayCast:
      break;
  }
  return {};
}

}  // namespace fastsplat::scene
