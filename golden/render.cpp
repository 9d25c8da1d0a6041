#include "golden/render.hpp"

#include <cassert>

#include "base/error.hpp"

namespace fastsplat::golden {

namespace {

void refuse_footprints(const scene::SceneDescription& description) {
  const std::string key = scene::technique_in_use(description.footprint, description.motion, description.lens);
  if (key.empty()) return;
  throw_usage({.where = key,
               .what = "the ray caster has no footprints to shape",
               .expected = {},
               .got = {},
               .fix = "choose a splatting --method, or turn this off"});
}

}  // namespace

Image render(const scene::Scene& scene, const RenderOptions& options) {
  switch (scene.description.method) {
    case scene::Method::RayCast:
      refuse_footprints(scene.description);
      return ray_cast(scene, options);
    case scene::Method::XRay:
      return xray(scene, scene::collect_splats(scene), options);
    case scene::Method::Westover:
      return westover(scene, scene::collect_splats(scene), options);
    case scene::Method::AxisAligned:
      return axis_aligned(scene, scene::collect_splats(scene), options);
    case scene::Method::ImageAligned:
      if (scene.description.classify == scene::ClassifyOrder::Post) return post_classified(scene, options);
      return image_aligned(scene, scene::collect_splats(scene), options);
  }
  assert(false && "unknown method");
  return {};
}

}  // namespace fastsplat::golden
