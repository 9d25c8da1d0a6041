// SPDX-License-Identifier: Apache-2.0
// docs/guide/reference.md is what `fastsplat help --markdown` prints, and that has every subcommand and flag.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "base/read_file.hpp"
#include "cli/command_line.hpp"
#include "cli/help/reference_page.hpp"
#include "tests/paths.hpp"

namespace fastsplat::cli {
namespace {

TEST(Reference, PageIsWhatTheProgramPrints) {
  const std::string wanted = reference_page(describe());
  std::printf("[figure] reference_lines = %td (limit >= 300)\n", std::count(wanted.begin(), wanted.end(), '\n'));
  EXPECT_GE(std::count(wanted.begin(), wanted.end(), '\n'), 300);
  EXPECT_TRUE(read_text_file(FASTSPLAT_SOURCE_DIR "/docs/guide/reference.md") == wanted)
      << "run: build/bin/fastsplat help --markdown > docs/guide/reference.md";
}

TEST(Reference, HasEverySubcommandAndFlag) {
  const auto all = describe();
  const std::string page = reference_page(all);
  int subcommands = 0, flags = 0;
  for (const Description& subcommand : all) {
    if (subcommand.name.empty() || subcommand.group) continue;
    const auto from = page.find("\n## " + subcommand.name + "\n");
    ASSERT_NE(from, page.npos) << subcommand.name;
    const std::string own = page.substr(from, page.find("\n## ", from + 1) - from);
    ++subcommands;
    for (const Flag& flag : subcommand.flags) {
      // In its own table, or in a shared one that its section links to.
      const auto& name = flag.names.back();
      const auto in = [&](const std::string& text) {
        return text.find("`" + name + "`") != text.npos || text.find("`" + name + " ") != text.npos ||
               text.find(", " + name + "`") != text.npos || text.find(", " + name + " ") != text.npos;
      };
      const std::string title = flag.group + " flags";
      const auto shared = page.find("\n## " + title + "\n");
      const bool linked = shared != page.npos && own.find("[" + title + "]") != own.npos &&
                          in(page.substr(shared, page.find("\n## ", shared + 1) - shared));
      EXPECT_TRUE(in(own) || linked) << subcommand.name << " " << name;
      ++flags;
    }
  }
  std::printf("[figure] reference: subcommands = %d, flags = %d (limit > 300)\n", subcommands, flags);
  EXPECT_GT(subcommands, 20);
  EXPECT_GT(flags, 300) << "nothing was checked";
}

}  // namespace
}  // namespace fastsplat::cli
