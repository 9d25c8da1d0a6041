// SPDX-License-Identifier: Apache-2.0
#include "golden/render.hpp"

#include <cassert>
#include <chrono>

#include "golden/collect_splats.hpp"
#include "scene/capability.hpp"

namespace fastsplat::golden {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

using Technique = Image (*)(const scene::Scene&, const std::vector<scene::Splat>&, const RenderOptions&);

Image render_splats(Technique technique, const scene::Scene& scene, const RenderOptions& options) {
  const auto start = Clock::now();
  const std::vector<scene::Splat> splats = collect_splats(scene, options.threads);
  const auto collected = Clock::now();
  Image image = technique(scene, splats, options);
  if (options.report) {
    options.report->splats = splats.size();
    options.report->traversal_seconds = std::chrono::duration<double>(collected - start).count();
    options.report->splatting_seconds = seconds_since(collected);
  }
  return image;
}

/// Collects its own densities; all its time counts as splatting.
Image timed_post_classified(const scene::Scene& scene, const RenderOptions& options) {
  const auto start = Clock::now();
  Image image = post_classified(scene, options);
  if (options.report) options.report->splatting_seconds = seconds_since(start);
  return image;
}

}  // namespace

Image render(const scene::Scene& scene, const RenderOptions& options) {
  switch (scene.description.method) {
    case scene::Method::RayCast:
      scene::check_capability(scene, scene::kOffersAll);  // the scene may have been built for another method
      return ray_cast(scene, options);
    case scene::Method::XRay:
      return render_splats(xray, scene, options);
    case scene::Method::Westover:
      return render_splats(westover, scene, options);
    case scene::Method::AxisAligned:
      return render_splats(axis_aligned, scene, options);
    case scene::Method::ImageAligned:
      if (scene.description.classify == scene::ClassifyOrder::Post) return timed_post_classified(scene, options);
      return render_splats(image_aligned, scene, options);
  }
  assert(false && "unknown method");
  return {};
}

}  // namespace fastsplat::golden
