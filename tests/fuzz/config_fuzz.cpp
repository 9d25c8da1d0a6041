// SPDX-License-Identifier: Apache-2.0
// Configurations: refused, or parsed and written so that they read back unchanged.
#include "driver/config/config_file.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  cmodel::Config config;
  if (!fuzz::answered([&] { config = driver::load_config(fuzz::file_of({data, size}, ".toml")); })) return 0;
  const std::string text = driver::to_toml(config);
  cmodel::Config again;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());
  if (!fuzz::answered([&] { again = driver::load_config(fuzz::file_of({bytes, text.size()}, ".toml")); }))
    fuzz::finding("written configuration is refused:\n" + text);
  if (cmodel::config_hash(again) != cmodel::config_hash(config))
    fuzz::finding("written configuration is another one:\n" + text);
  return 0;
}
