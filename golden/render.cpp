#include "golden/render.hpp"

#include <cassert>

namespace fastsplat::golden {

Image render(const scene::Scene& scene, const RenderOptions& options) {
  switch (scene.description.method) {
    case scene::Method::RayCast:
      return ray_cast(scene, options);
    case scene::Method::XRay:
      return xray(scene, scene::collect_splats(scene), options);
    case scene::Method::Westover:
      return westover(scene, scene::collect_splats(scene), options);
    case scene::Method::AxisAligned:
      return axis_aligned(scene, scene::collect_splats(scene), options);
    case scene::Method::ImageAligned:
      return image_aligned(scene, scene::collect_splats(scene), options);
  }
  assert(false && "unknown method");
  return {};
}

}  // namespace fastsplat::golden
