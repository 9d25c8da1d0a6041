// SPDX-License-Identifier: Apache-2.0
// fastsplat help: help on the program or a subcommand, as text, man pages or Markdown.
#include <filesystem>

#include "base/atomic_file.hpp"
#include "cli/command_line.hpp"
#include "cli/help/man_page.hpp"
#include "cli/help/reference_page.hpp"
#include "cli/output.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct HelpArguments {
  std::vector<std::string> subcommand;
  bool man = false, markdown = false;
  std::string pages;  ///< a folder; empty for none
};

void write_pages(const std::string& folder) {
  const auto all = describe();
  for (const Description& subcommand : all)
    write_text_file((std::filesystem::path(folder) / (man_page_name(subcommand) + ".1")).string(),
                    man_page(subcommand, all));
}

ExitCode run(const HelpArguments& arguments) {
  if (!arguments.pages.empty()) {
    if (arguments.man || arguments.markdown || !arguments.subcommand.empty()) {
      throw_usage({.where = "--man-pages",
                   .what = "writes all pages and cannot be combined with --man or a subcommand",
                   .expected = {},
                   .got = {},
                   .fix = "leave out --man, --markdown and the subcommand, or --man-pages"});
    }
    write_pages(arguments.pages);
    return ExitCode::Pass;
  }
  if (arguments.markdown) {
    if (arguments.man || !arguments.subcommand.empty()) {
      throw_usage({.where = "--markdown",
                   .what = "prints all subcommands on one page",
                   .expected = {},
                   .got = {},
                   .fix = "leave out --man and the subcommand, or --markdown"});
    }
    write_stdout(reference_page(describe()));
    return ExitCode::Pass;
  }
  if (arguments.man) {
    const auto all = describe();
    write_stdout(man_page(described(arguments.subcommand, all), all));
  } else {
    write_stdout(help_on(arguments.subcommand));
  }
  return ExitCode::Pass;
}

/// All words of subcommand names.
std::vector<std::string> subcommand_words() {
  std::vector<std::string> words;
  for (const Subcommand& subcommand : all_subcommands()) {
    const std::string name = subcommand.name;
    if (name.find(' ') == name.npos) words.push_back(name);
  }
  return words;
}

void declare(Options& options, HelpArguments& to) {
  options.positionals("VERB", to.subcommand, 0, "a subcommand");
  options.only_values(subcommand_words);
  options.flag("--man", to.man, "print the manual page in roff: `fastsplat help --man render | man -l -`");
  options.flag("--markdown", to.markdown, "print the reference of all subcommands in Markdown");
  options.word("--man-pages", to.pages, "FOLDER", "write all manual pages into an existing folder");
  options.example("fastsplat help errors bound", "a subcommand with examples and every flag");
  options.example("fastsplat help --man compare", "the manual page of a subcommand, for man, groff or mandoc");
}

}  // namespace

const Subcommand subcommands::help{"help", "print help on a subcommand, and manual pages",
                                   subcommand<HelpArguments, declare, run>};

}  // namespace fastsplat::cli
