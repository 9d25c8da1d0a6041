#include "driver/projection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "driver/quantise.hpp"
#include "scene/splats.hpp"

namespace fastsplat::driver {
namespace {

struct RadiusRange {
  double smallest = std::numeric_limits<double>::infinity();
  double largest = 0.0;
};

/// Footprint radii over the corners of the volume's box: scale is monotone in depth, so the corners bound it.
RadiusRange radius_range(const scene::Scene& scene) {
  const volume::Volume& volume = *scene.volume;
  const double support = scene.kernel.radius() * volume.kernel_unit();
  RadiusRange range;
  for (int corner = 0; corner < 8; ++corner) {
    const auto at =
        volume.position((corner & 1) != 0 ? volume.dims.x - 1 : 0, (corner & 2) != 0 ? volume.dims.y - 1 : 0,
                        (corner & 4) != 0 ? volume.dims.z - 1 : 0);
    const double radius = support * scene.camera.project(at).scale;
    range.smallest = std::min(range.smallest, radius);
    range.largest = std::max(range.largest, radius);
  }
  return range;
}

struct WholeSplat {
  SplatWords words{};
  bool saturated = false;
};

WholeSplat whole_splat(const scene::Splat& splat, double amplitude, const Target& target) {
  const double values[4] = {splat.emission.x, splat.emission.y, splat.emission.z, splat.extinction};
  WholeSplat out;
  for (std::size_t c = 0; c < 4; ++c) {
    const Quantised channel = quantise(values[c] * amplitude, target);
    out.saturated = out.saturated || channel.saturated;
    out.words[c] = static_cast<std::uint32_t>(channel.word);
  }
  return out;
}

}  // namespace

Projected project(const scene::Scene& scene, const cmodel::Config& config, const Slices& slices,
                  const scene::SheetPlan& plan) {
  const double unit = scene.volume->kernel_unit();
  const double support = scene.kernel.radius() * unit;
  const double exposure = scene.description.method == scene::Method::XRay ? scene.xray_scale : 1.0;
  const Target position = target(Site::Position, config), whole = target(Site::Whole, config);
  const RadiusRange range = radius_range(scene);
  Projected out{.splats = {}, .sets = RadiusSets(config, range.smallest, range.largest)};

  scene::for_each_splat(scene, [&](const scene::Splat& splat) {
    ++out.voxels;
    const scene::ScreenPoint at = scene.camera.project(splat.position);
    const double radius = support * at.scale;
    const std::uint32_t set = out.sets.nearest(radius);
    const double width_ratio = radius / out.sets.radius(set);
    const WholeSplat quantised = whole_splat(splat, scene.amplitude * exposure * width_ratio * width_ratio, whole);
    if (quantised.words == SplatWords{}) {
      ++out.vanished;
      return;
    }
    out.saturated += quantised.saturated ? 1 : 0;
    std::int32_t depth = 0;
    if (plan.use == scene::SheetUse::Sliced) depth = slices.quantise_depth(at.depth / unit - plan.slabs.first);
    if (plan.use == scene::SheetUse::GridSheet) depth = splat.sheet;
    out.splats.push_back({.x = quantise_to<std::int32_t>(at.x, position),
                          .y = quantise_to<std::int32_t>(at.y, position),
                          .depth = depth,
                          .set = set,
                          .words = quantised.words});
  });
  return out;
}

}  // namespace fastsplat::driver
