// SPDX-License-Identifier: Apache-2.0
// Help, man pages and completion cover all subcommands, without a list in this test.
#include <gtest/gtest.h>

#include <sstream>

#include "cli/command_line.hpp"
#include "cli/help/completion.hpp"
#include "cli/help/man_page.hpp"

namespace fastsplat::cli {
namespace {

using Words = std::vector<std::string>;

bool holds(const std::string& text, const std::string& part) { return text.find(part) != text.npos; }

/// The text between `from` and the next `to`, or an empty text.
std::string part_of(const std::string& text, const std::string& from, const std::string& to) {
  const auto begin = text.find(from);
  if (begin == text.npos) return {};
  const auto end = text.find(to, begin + from.size());
  return text.substr(begin, end == text.npos ? end : end - begin);
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size()) text.replace(at, from.size(), to);
  return text;
}

/// Counts the flags of all subcommands for which `is_there` holds.
template <class IsThere>
void every_flag(const char* where, const IsThere& is_there) {
  int subcommands = 0, flags = 0, missing = 0;
  for (const Description& subcommand : describe()) {
    ++subcommands;
    for (const Flag& flag : subcommand.flags) {
      for (const auto& name : flag.names) {
        ++flags;
        if (is_there(subcommand, flag, name)) continue;
        ++missing;
        ADD_FAILURE() << where << ": " << name << " of '" << subcommand.name << "' is not there";
      }
    }
  }
  std::printf("[figure] %s: verbs = %d, flags = %d, missing = %d (limit 0)\n", where, subcommands, flags, missing);
  EXPECT_GT(subcommands, 20);
  EXPECT_GT(flags, 300) << "nothing was checked";
}

TEST(Help, DescriptionsAreWhatTheVerbsDeclare) {
  const auto all = describe();
  ASSERT_EQ(all.size(), all_subcommands().size() + 1);
  EXPECT_EQ(all.front().name, "");
  for (std::size_t at = 0; at < all_subcommands().size(); ++at) {
    EXPECT_EQ(all[at + 1].name, all_subcommands()[at].name);
    EXPECT_EQ(all[at + 1].summary, all_subcommands()[at].summary);
    EXPECT_EQ(all[at + 1].group, all_subcommands()[at].declare == nullptr);
  }
  // CLI11's own list of flags shows flags declared without a description.
  for (const Description& subcommand : all) {
    std::istringstream names(subcommand.name);
    const Words words{std::istream_iterator<std::string>(names), {}};
    std::istringstream lines(help_on(words));
    for (std::string line; std::getline(lines, line);) {
      const auto flag = line.substr(0, line.find_first_of(" ,", 3));
      if (!line.starts_with("  -") || holds(line, "--help")) continue;
      bool described = false;
      for (const Flag& one : subcommand.flags) {
        for (const auto& name : one.names) described = described || "  " + name == flag;
      }
      EXPECT_TRUE(described) << subcommand.name << ": " << line;
    }
  }
}

TEST(Help, ManPagesHaveEveryVerbAndFlag) {
  const auto all = describe();
  every_flag("man", [&](const Description& subcommand, const Flag&, const std::string& name) {
    const std::string page = man_page(subcommand, all);
    return holds(page, "\\f" + std::string(name.starts_with('-') ? "B" : "I") + replaced(name, "-", "\\-") + "\\fR");
  });
  for (const Description& subcommand : all) {
    const std::string page = man_page(subcommand, all);
    EXPECT_TRUE(holds(page, ".SH \"EXIT STATUS\"")) << subcommand.name;
    EXPECT_TRUE(holds(man_page(all.front(), all), replaced(man_page_name(subcommand), "-", "\\-"))) << subcommand.name;
    for (const unsigned char c : page) EXPECT_LT(c, 128) << subcommand.name << " holds what not every terminal shows";
  }
}

TEST(Help, CompletionHasEveryVerbAndFlag) {
  const auto all = describe();
  const std::string bash = completion_script("bash", all), zsh = completion_script("zsh", all),
                    fish = completion_script("fish", all);
  every_flag("bash", [&](const Description& subcommand, const Flag& flag, const std::string& name) {
    const std::string label = subcommand.name.empty()       ? "''"
                              : holds(subcommand.name, " ") ? "'" + subcommand.name + "'"
                                                            : subcommand.name;
    const std::string part = part_of(bash, "    " + label + ")\n", ";;");
    return flag.positional() ? !part.empty() : holds(replaced(part, "'", " "), " " + name + " ");
  });
  every_flag("zsh", [&](const Description& subcommand, const Flag& flag, const std::string& name) {
    const std::string function =
        "_fastsplat" + (subcommand.name.empty() ? "" : "_" + replaced(subcommand.name, " ", "_"));
    const std::string part = part_of(zsh, "\n" + function + "() {\n", "\n}\n");
    if (flag.positional()) return holds(part, ":" + name + ":");
    return holds(part, name + (!flag.takes_value() ? "[" : name.starts_with("--") ? "=[" : "+["));
  });
  every_flag("fish", [&](const Description& subcommand, const Flag& flag, const std::string& name) {
    const std::string at = "'__fastsplat_at" + (subcommand.name.empty() ? "" : " " + subcommand.name) + "' ";
    if (flag.positional()) return holds(fish, at);
    std::istringstream lines(fish);
    for (std::string line; std::getline(lines, line);) {
      if (holds(line, at) &&
          holds(line, name.starts_with("--") ? " -l " + name.substr(2) + " " : " -s " + name.substr(1)))
        return true;
    }
    return false;
  });
  for (const auto& subcommand : all_subcommands()) {
    const std::string last = std::string(subcommand.name).substr(std::string(subcommand.name).rfind(' ') + 1);
    EXPECT_TRUE(holds(fish, " -a " + last + " -d ")) << subcommand.name;
    EXPECT_TRUE(holds(zsh, "'" + last + ":")) << subcommand.name;
  }
}

TEST(Help, ShellsAndVerbsThatThereAreNotAreRefused) {
  for (const auto& call : std::vector<std::function<void()>>{[] { completion_script("tcsh", {}); },
                                                             [] { described({"redner"}, describe()); },
                                                             [] {
                                                               help_on({"render", "twice"});
                                                             }}) {
    try {
      call();
      FAIL() << "was accepted";
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      EXPECT_FALSE(error.parts().fix.empty()) << error.what();
    }
  }
}

/// The words of an example up to its pipe or redirection, as a shell splits them.
Words words_of(const std::string& command) {
  Words words;
  std::string word;
  bool quoted = false, any = false;
  for (const char c : command + " ") {
    if (c == '\'') {
      quoted = !quoted;
      any = true;
    } else if (quoted || c != ' ') {
      word += c;
      any = true;
    } else if (any) {
      if (word == "|" || word == ">") break;
      words.push_back(word);
      word.clear();
      any = false;
    }
  }
  return words;
}

TEST(Help, BeginsWithExamplesThatParse) {
  int examples = 0, fewest = 1 << 20;
  for (const Description& subcommand : describe()) {
    if (subcommand.group) continue;
    SCOPED_TRACE(subcommand.name);
    const int count = static_cast<int>(subcommand.examples.size());
    fewest = std::min(fewest, count);
    EXPECT_GE(count, 2);
    EXPECT_LE(count, 3);
    std::istringstream names(subcommand.name);
    const std::string help = help_on({std::istream_iterator<std::string>(names), {}});
    EXPECT_TRUE(help.starts_with(subcommand.summary + "\n\nExamples:\n")) << help;
    for (const Example& example : subcommand.examples) {
      ++examples;
      EXPECT_TRUE(holds(help, "  # " + example.does + "\n  " + example.command + "\n"));
      EXPECT_TRUE(example.command.starts_with("fastsplat " + subcommand.name));
      const Words words = words_of(example.command);
      std::vector<const char*> all;
      for (const auto& word : words) all.push_back(word.c_str());
      EXPECT_NO_THROW(parse(static_cast<int>(all.size()), all.data())) << example.command;
    }
  }
  std::printf("[figure] examples = %d, fewest of a verb = %d (limit >= 2)\n", examples, fewest);
}

TEST(Help, AnExampleThatHasRottedDoesNotParse) {
  const auto refused = [](const std::string& command) {
    const Words words = words_of(command);
    std::vector<const char*> all;
    for (const auto& word : words) all.push_back(word.c_str());
    EXPECT_THROW(parse(static_cast<int>(all.size()), all.data()), UserError) << command;
  };
  refused("fastsplat render --sise 9 -o a.png");
  refused("fastsplat compare a.exr > b");
}

}  // namespace
}  // namespace fastsplat::cli
