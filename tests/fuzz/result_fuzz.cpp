// SPDX-License-Identifier: Apache-2.0
// JSON results, as a report reads them.
#include "report/results.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  const auto path = fuzz::file_of({data, size}, ".json");
  fuzz::answered([&] { report::read_result(path); });
  return 0;
}
