// SPDX-License-Identifier: Apache-2.0
#include "tests/capi/recorded_helper.hpp"

#include <memory>

namespace fastsplat::test {

namespace {

std::unique_ptr<const Recorded> record(const std::string& config, const std::string& size, const std::string& opacity) {
  auto made = std::make_unique<Recorded>();
  made->stream = made->folder / "scene.fss";
  made->vectors = made->folder / "vectors";
  cli_test::expect_success(cli_test::fastsplat({"stream", "record", "--volume", "shells:20", "--opacity-scale", opacity,
                                                "--size", size, "--config", config, "-o", made->stream}));
  cli_test::expect_success(
      cli_test::fastsplat({"stream", "vectors", made->stream, "--config", config, "-o", made->vectors}));
  return made;
}

}  // namespace

const Recorded& recorded() {
  static const std::unique_ptr<const Recorded> once = record("tiny", "44x40", "1");
  return *once;
}

const Recorded& recorded_that_culls() {
  static const std::unique_ptr<const Recorded> once = record(kCulling, "45x40", "40");
  return *once;
}

std::string python_with(const std::string& module) {
  for (const char* python : {"/usr/bin/python3", "python3"})
    if (cli_test::run_words({python, "-c", "import " + module}).code == 0) return python;
  return {};
}

}  // namespace fastsplat::test
