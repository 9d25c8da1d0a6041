// The reference's table of what goes with what is the capability table, word for word.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/read_file.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "tests/driver/scenes_helper.hpp"
#include "tests/paths.hpp"

namespace fastsplat::driver {
namespace {

/// Between the marks of docs/guide/reference.md.
TEST(CapabilityGuide, is_the_capability_table) {
  const scene::Offers engines[] = {scene::kOffersAll, offers(load_config("base")), offers(load_config("ellipse"))};
  const std::string table = scene::capability_guide(engines);
  const std::string guide = read_text_file(FASTSPLAT_SOURCE_DIR "/docs/guide/reference.md");
  const std::string begin = "<!-- capability table: generated -->\n", end = "<!-- end of capability table -->";
  const auto from = guide.find(begin), to = guide.find(end);
  ASSERT_TRUE(from != std::string::npos && to != std::string::npos && from < to);
  const char* const wanted = FASTSPLAT_BINARY_DIR "/capability_table.md";
  std::ofstream(wanted) << table;
  EXPECT_EQ(guide.substr(from + begin.size(), to - from - begin.size()), table)
      << "copy " << wanted << " into the reference: build/bin/fastsplat help --markdown > docs/guide/reference.md";
  figure("lines_of_the_references_table", static_cast<double>(std::count(table.begin(), table.end(), '\n')),
         "at least 30");
  EXPECT_GE(std::count(table.begin(), table.end(), '\n'), 30);
}

}  // namespace
}  // namespace fastsplat::driver
