#include "scene/culling.hpp"

#include "base/error.hpp"
#include "scene/scene.hpp"

namespace fastsplat::scene {

std::string culling_in_use(const Culling& culling) {
  if (culling.mode != CullingMode::Off) return "culling.mode";
  return culling.freeze > 0.0 ? "culling.freeze" : "";
}

void check_culling(const SceneDescription& description) {
  const Culling& culling = description.culling;
  const Method method = description.method;
  const std::string key = culling_in_use(culling);
  if (key.empty()) return;
  if (method != Method::ImageAligned && method != Method::AxisAligned) {
    throw_usage({.where = key,
                 .what = std::string(to_string(method)) + " has no sheets in front of which a pixel could be opaque",
                 .expected = {},
                 .got = {},
                 .fix = "use --method image_aligned or axis_aligned, or turn it off"});
  }
  if (culling.mode != CullingMode::Off && !(culling.freeze > 0.0)) {
    throw_usage({.where = key,
                 .what = "no pixel ever becomes opaque while culling.freeze is 0",
                 .expected = {},
                 .got = {},
                 .fix = "add --freeze 0.001: pixels of less transmittance no longer change"});
  }
  const std::string shaped = technique_in_use(description.footprint, description.motion, description.lens);
  if (culling.mode == CullingMode::Blocks && !shaped.empty()) {
    throw_usage({.where = key,
                 .what = "blocks do not know how far footprints reach that " + shaped + " shapes",
                 .expected = {},
                 .got = {},
                 .fix = "use --culling splats"});
  }
}

const std::vector<std::string>& culling_mode_names() {
  static const std::vector<std::string> names = {"off", "splats", "blocks"};
  return names;
}

const std::vector<std::string>& visibility_test_names() {
  static const std::vector<std::string> names = {"count", "average"};
  return names;
}

}  // namespace fastsplat::scene
