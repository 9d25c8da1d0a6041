// SPDX-License-Identifier: Apache-2.0
#include "scene/culling.hpp"

namespace fastsplat::scene {

const std::vector<std::string>& culling_mode_names() {
  static const std::vector<std::string> names = {"off", "splats", "blocks"};
  return names;
}

const std::vector<std::string>& visibility_test_names() {
  static const std::vector<std::string> names = {"count", "average"};
  return names;
}

}  // namespace fastsplat::scene
