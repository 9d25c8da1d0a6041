// SPDX-License-Identifier: Apache-2.0
// Inputs of coverage closure: books, tests' results, the plan, exclusions.
#include "testbench/closure/closure.hpp"
#include "testbench/closure/verification_plan.hpp"
#include "testbench/coverage/coverage_book.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  fuzz::Bytes bytes{data, size};
  switch (fuzz::take_byte(bytes) % 4) {
    case 0:
      fuzz::answered([&] { testbench::read_book(fuzz::file_of(bytes, ".json")); });
      break;
    case 1:
      fuzz::answered([&] { testbench::read_test_results(fuzz::file_of(bytes, ".xml")); });
      break;
    case 2:
      fuzz::answered([&] { testbench::read_plan(fuzz::file_of(bytes, ".toml")); });
      break;
    default:
      fuzz::answered([&] { testbench::read_exclusions(fuzz::file_of(bytes, ".toml")); });
  }
  return 0;
}
