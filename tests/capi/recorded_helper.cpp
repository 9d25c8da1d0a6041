#include "tests/capi/recorded_helper.hpp"

#include <memory>

namespace fastsplat::test {

const Recorded& recorded() {
  static const std::unique_ptr<const Recorded> once = [] {
    auto made = std::make_unique<Recorded>();
    made->stream = made->folder / "scene.fss";
    made->vectors = made->folder / "vectors";
    cli_test::expect_success(cli_test::fastsplat(
        {"stream", "record", "--volume", "shells:20", "--size", "44x40", "--config", "tiny", "-o", made->stream}));
    cli_test::expect_success(
        cli_test::fastsplat({"stream", "vectors", made->stream, "--config", "tiny", "-o", made->vectors}));
    return made;
  }();
  return *once;
}

std::string python_with(const std::string& module) {
  for (const char* python : {"/usr/bin/python3", "python3"})
    if (cli_test::run_words({python, "-c", "import " + module}).code == 0) return python;
  return {};
}

}  // namespace fastsplat::test
