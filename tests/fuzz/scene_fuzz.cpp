// SPDX-License-Identifier: Apache-2.0
// scene.toml and its [sequence]: accepted or refused.
#include "scene/scene.hpp"
#include "scene/sequence.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  const auto path = fuzz::file_of({data, size}, ".toml");
  fuzz::answered([&] { scene::load_scene_file(path); });
  fuzz::answered([&] { scene::load_sequence(path); });
  return 0;
}
