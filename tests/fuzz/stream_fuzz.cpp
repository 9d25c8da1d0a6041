// SPDX-License-Identifier: Apache-2.0
// The device's stream: model and oracle refuse it at the same beat, or accept it and draw the same. The first byte
// decides whether the stream gets the right beat count and checksum; without them few would be accepted.
#include "tests/cmodel/small_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/cmodel/verdict_helper.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  static const cmodel::Config config = test::small_stream_config();
  fuzz::Bytes given{data, size};
  const bool sealed = fuzz::take_byte(given) % 2 == 1;
  std::vector<std::uint8_t> bytes(given.begin(),
                                  given.end() - static_cast<std::ptrdiff_t>(given.size() % cmodel::kBeatBytes));
  if (sealed && !bytes.empty()) test::seal(bytes);
  const std::string text = test::disagreement(config, bytes);
  if (!text.empty()) fuzz::finding(text);
  return 0;
}
