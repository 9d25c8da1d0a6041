// SPDX-License-Identifier: Apache-2.0
// Transfer functions: accepted or refused.
#include "scene/transfer_function.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  const auto path = fuzz::file_of({data, size}, ".toml");
  fuzz::answered([&] { scene::load_transfer_function(path); });
  return 0;
}
