// SPDX-License-Identifier: Apache-2.0
// Recorded streams as files: dumped, replayed, or refused.
#include "driver/config/config_file.hpp"
#include "driver/files/stream_file.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  static const cmodel::Config config = driver::load_config("tiny");
  const auto path = fuzz::file_of({data, size}, ".fss");
  fuzz::answered([&] { driver::dump_stream(path, [](const std::string&) { return true; }); });
  fuzz::answered([&] { driver::replay_stream(path, config, {.threads = 1}); });
  return 0;
}
