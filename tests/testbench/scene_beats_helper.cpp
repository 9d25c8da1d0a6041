// SPDX-License-Identifier: Apache-2.0
#include "tests/testbench/scene_beats_helper.hpp"

#include "driver/tiles/compile.hpp"

namespace fastsplat::test {

std::vector<cmodel::Beat> scene_beats(const scene::SceneDescription& description, const cmodel::Config& config) {
  const scene::Scene scene = scene::build_scene(description);
  const driver::CompiledFrame compiled(scene, config);
  std::vector<cmodel::Beat> beats;
  compiled.emit([&](std::span<const cmodel::Beat> more) { beats.insert(beats.end(), more.begin(), more.end()); });
  return beats;
}

}  // namespace fastsplat::test
