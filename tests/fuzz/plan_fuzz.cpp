// SPDX-License-Identifier: Apache-2.0
// Plans: a specification is accepted or refused; a plan that was read is written so that it reads back unchanged.
#include <nlohmann/json.hpp>

#include "analysis/sweep/plan.hpp"
#include "analysis/sweep/spec.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  fuzz::Bytes bytes{data, size};
  if (fuzz::take_byte(bytes) % 2 == 0) {
    fuzz::answered([&] { plan::read_spec(fuzz::file_of(bytes, ".toml")); });
    return 0;
  }
  plan::Plan read;
  if (!fuzz::answered([&] { read = plan::read_plan(fuzz::file_of(bytes, ".json")); })) return 0;
  const std::string text = plan::to_json(read).dump();
  plan::Plan again;
  const auto* written = reinterpret_cast<const std::uint8_t*>(text.data());
  if (!fuzz::answered([&] { again = plan::read_plan(fuzz::file_of({written, text.size()}, ".json")); }))
    fuzz::finding("a written plan is refused:\n" + text);
  if (again.hash != read.hash) fuzz::finding("a written plan is another one:\n" + text);
  return 0;
}
