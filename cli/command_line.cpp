// SPDX-License-Identifier: Apache-2.0
#include "cli/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <map>
#include <new>
#include <span>
#include <sstream>

#include "base/error.hpp"
#include "base/machine_error.hpp"
#include "base/suggest.hpp"
#include "base/version.hpp"
#include "cli/command_text.hpp"
#include "cli/help/exit_codes.hpp"
#include "cli/output.hpp"
#include "cli/typed_names.hpp"

namespace fastsplat::cli {
namespace {

const char* const kSummary =
    "volume splatting hardware, as an integer device model and a floating-point golden renderer";
/// "Exit codes: 0 pass, 1 failed, ...".
std::string footer() {
  std::string codes;
  for (const auto& [code, word, meaning] : kExitMeanings)
    codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", static_cast<int>(code), word);
  return "Exit codes: " + codes +
         ".\nRun `fastsplat help SUBCOMMAND` (or SUBCOMMAND --help) for details; docs/guide.md is the user's guide.";
}

/// The help begins with examples to copy.
std::string with_examples(const Description& subcommand) {
  std::string text = subcommand.summary + "\n";
  if (!subcommand.examples.empty()) text += "\nExamples:\n";
  for (const Example& example : subcommand.examples)
    text += fmt::format("  # {}\n  {}\n", example.does, example.command);
  return text;
}

/// The tree of subcommands, by name and summary; only the flags of the one that is used are declared.
class CommandLine {
 public:
  explicit CommandLine(const std::vector<Subcommand>& subcommands) {
    app.footer(footer());
    app.set_help_flag("-h,--help", "print this help");
    app.set_version_flag("--version", program_version(), "print the version");
    for (const Subcommand& subcommand : subcommands) {
      const std::string name = subcommand.name;
      const auto space = name.find(' ');
      CLI::App* parent = space == std::string::npos ? &app : app.get_subcommand(name.substr(0, space));
      CLI::App* sub =
          parent->add_subcommand(space == std::string::npos ? name : name.substr(space + 1), subcommand.summary);
      if (subcommand.declare != nullptr) declare_[sub] = subcommand.declare;
      subs_.push_back(sub);
    }
  }

  struct Declared {
    Action action;  ///< null for a group
    Description description;
  };

  /// Declares the flags of `subcommand` and adds its examples to its help.
  Declared declare(CLI::App& subcommand) const {
    Options options(subcommand);
    Declared out;
    const auto found = declare_.find(&subcommand);
    if (found != declare_.end()) out.action = found->second(options);
    out.description = options.description();
    out.description.group = found == declare_.end();
    if (!out.description.examples.empty()) subcommand.description(with_examples(out.description));
    return out;
  }

  const std::vector<CLI::App*>& subs() const { return subs_; }

  CLI::App app{std::string("fastsplat: ") + kSummary, "fastsplat"};

 private:
  std::map<const CLI::App*, Action (*)(Options&)> declare_;
  std::vector<CLI::App*> subs_;  ///< in the order of `subcommands`
};

std::string called(const CLI::App& subcommand) {
  std::string name = subcommand.get_name();
  for (const CLI::App* app = subcommand.get_parent(); app != nullptr; app = app->get_parent())
    name = app->get_name() + " " + name;
  return name;
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> flag_names(const CLI::App& subcommand) {
  std::vector<std::string> names;
  for (const CLI::Option* option : subcommand.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// `subcommand`: full name, as typed.
[[noreturn]] void misused(const std::string& subcommand, const std::string& what, std::string fix = {}) {
  if (fix.empty()) fix = "`" + subcommand + " --help` lists flags and subcommands";
  throw_usage({.where = {}, .what = what, .expected = {}, .got = {}, .fix = std::move(fix)});
}

[[noreturn]] void misused(const CLI::App& subcommand, const std::string& what, const std::string& fix = {}) {
  misused(called(subcommand), what, fix);
}

/// "give it with --scene or --config": the flags of `subcommand` that take files with the ending of `word`; else empty.
std::string flags_for(const CLI::App& subcommand, const std::string& word) {
  static constexpr std::pair<std::string_view, const char*> kTakes[] = {
      {".toml", "--scene"}, {".toml", "--config"},   {".toml", "--tf"},     {".nii", "--volume"},
      {".gz", "--volume"},  {".nrrd", "--volume"},   {".nhdr", "--volume"}, {".mha", "--volume"},
      {".mhd", "--volume"}, {".ply", "--gaussians"}, {".fss", "--stream"}};
  std::vector<std::string> flags;
  for (const auto& [ending, flag] : kTakes) {
    if (word.ends_with(ending) && subcommand.get_option_no_throw(flag) != nullptr) flags.emplace_back(flag);
  }
  return flags.empty() ? "" : fmt::format("give it with {}", fmt::join(flags, " or "));
}

// Finds the subcommand that `words` name, starting at `app`; `at` becomes the index of the first remaining word.
CLI::App* find_subcommand(CLI::App& app, const std::vector<std::string>& words, std::size_t& at) {
  CLI::App* subcommand = &app;
  while (at < words.size()) {
    const auto names = subcommand_names(*subcommand);
    if (names.empty() || words[at].starts_with('-')) break;
    if (std::find(names.begin(), names.end(), words[at]) == names.end()) {
      misused(*subcommand,
              fmt::format("unknown {} '{}'", subcommand == &app ? "subcommand" : subcommand->get_name() + " subcommand",
                          words[at]),
              suggestion(words[at], names));
    }
    subcommand = subcommand->get_subcommand(words[at++]);
  }
  return subcommand;
}

// The flag that was probably meant; empty rather than a list of thirty.
std::string near_flag(const CLI::App& subcommand, const std::string& flag) {
  constexpr std::size_t kMostListed = 16;
  const auto names = flag_names(subcommand);
  const auto hint = flag.starts_with("--") ? suggestion(flag, names) : std::string{};
  return hint.starts_with("known:") && names.size() > kMostListed ? std::string{} : hint;
}

// Reports unknown flags, missing values and repeated flags, in the user's order.
void check_words(const CLI::App& subcommand, std::span<const std::string> words) {
  std::map<const CLI::Option*, int> seen;
  for (std::size_t at = 0; at < words.size(); ++at) {
    const std::string& word = words[at];
    if (word == "--") return;
    const bool is_long = word.starts_with("--");
    const bool is_short =
        !is_long && word.size() >= 2 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
    if (!is_long && !is_short) continue;
    const auto equals = word.find('=');
    const std::string flag = is_long ? word.substr(0, equals) : word.substr(0, 2);
    const CLI::Option* option = subcommand.get_option_no_throw(flag);
    if (option == nullptr)
      misused(subcommand, fmt::format("unknown flag {} of `{}`", flag, called(subcommand)),
              near_flag(subcommand, flag));
    const bool repeatable = option->get_items_expected_max() > 1;
    if (++seen[option] > 1 && !repeatable) misused(subcommand, flag + " is given twice", "give it once");
    if (option->get_items_expected_max() == 0) {
      if (is_long && equals != std::string::npos)
        misused(subcommand, flag + " does not take a value", "write only " + flag);
      continue;
    }
    if (is_long ? equals != std::string::npos : word.size() > 2) {
      if (is_long && equals + 1 == word.size())
        misused(subcommand, flag + " needs a value", "write " + flag + "=" + option->get_type_name());
      continue;
    }
    ++at;
    const bool missing = at >= words.size() || words[at].empty() || words[at].starts_with("--");
    if (missing) misused(subcommand, flag + " needs a value", "write " + flag + " " + option->get_type_name());
  }
}

Action print(std::string text) {
  return [text = std::move(text)] {
    write_stdout(text);
    return ExitCode::Pass;
  };
}

std::string help_text(CLI::App& app, CLI::App& subcommand) {
  return subcommand.help(&subcommand == &app ? "" : called(*subcommand.get_parent()));
}

}  // namespace

std::vector<std::string> flags_of(const std::string& subcommand, const std::vector<Subcommand>& subcommands) {
  CommandLine line(subcommands);
  std::vector<std::string> words;
  std::istringstream all(subcommand);
  for (std::string word; all >> word;) words.push_back(word);
  std::size_t at = 0;
  CLI::App* found = find_subcommand(line.app, words, at);
  const Action action = line.declare(*found).action;
  if (at < words.size() || !action)
    misused(line.app, "unknown subcommand '" + subcommand + "'", "run `fastsplat help` for the list of subcommands");
  return flag_names(*found);
}

int run_program(int argc, const char* const* argv) {
  try {
    const Action action = parse(argc, argv);
    remember_command(std::vector<std::string>(argv + std::min(argc, 1), argv + argc));
    return static_cast<int>(action());
  } catch (const UserError& error) {
    print_error(error.what());
    return static_cast<int>(exit_code_of(error));
  } catch (const std::bad_alloc&) {
    print_error("not enough memory; use a smaller volume or --size");
    return static_cast<int>(machine_exit_code(ExitCode::Input));
  } catch (const std::exception& error) {
    print_error(std::string("internal: ") + error.what() + "; please report it with the command line");
    return static_cast<int>(ExitCode::Internal);
  } catch (...) {
    print_error("internal: unknown exception; please report it with the command line");
    return static_cast<int>(ExitCode::Internal);
  }
}

Action parse(int argc, const char* const* argv, const std::vector<Subcommand>& subcommands) {
  CommandLine line(subcommands);
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  std::size_t at = 0;
  CLI::App* subcommand = find_subcommand(line.app, words, at);
  const Action action = line.declare(*subcommand).action;
  const std::span rest(words.begin() + static_cast<std::ptrdiff_t>(at), words.end());
  for (const auto& word : rest) {
    if (word == "--help" || word == "-h") return print(help_text(line.app, *subcommand));
    if (word == "--version" && subcommand == &line.app) return print("fastsplat " + program_version() + "\n");
  }
  check_words(*subcommand, rest);
  if (!action) {
    misused(*subcommand, fmt::format("{} requires a subcommand", called(*subcommand)),
            fmt::format("add one of {}; `{} --help` describes them", fmt::join(subcommand_names(*subcommand), ", "),
                        called(*subcommand)));
  }
  // Parses with the subcommand alone, so that names of other subcommands are ordinary words. Parsing clears its parent,
  // hence the name first.
  const std::string name = called(*subcommand);
  std::vector<std::string> reversed(rest.rbegin(), rest.rend());
  try {
    subcommand->parse(reversed);
  } catch (const CLI::ExtrasError&) {
    const auto extra = subcommand->remaining(true);
    const std::string first = extra.empty() ? "?" : extra.front();
    misused(name, fmt::format("unexpected '{}' after `{}`", first, name), flags_for(*subcommand, first));
  } catch (const CLI::RequiredError& error) {
    misused(name, fmt::format("{}: {}", name, error.what()));
  } catch (const CLI::ParseError& error) {
    misused(name, error.what());
  }
  return [action, words] {
    try {
      return action();
    } catch (const UserError& error) {
      throw_again(error, as_typed(error.parts(), words), error.code());
    }
  };
}

std::string help_on(const std::vector<std::string>& words, const std::vector<Subcommand>& subcommands) {
  CommandLine line(subcommands);
  std::size_t at = 0;
  CLI::App* subcommand = find_subcommand(line.app, words, at);
  if (at < words.size())
    misused(line.app, "unexpected '" + words[at] + "' after help", "run `fastsplat help` for the list of subcommands");
  line.declare(*subcommand);
  return help_text(line.app, *subcommand);
}

std::vector<Description> describe(const std::vector<Subcommand>& subcommands) {
  CommandLine line(subcommands);
  Flag version{.names = {"--version"}, .unit = {}, .help = "print the version", .group = {}, .values = {}};
  std::vector<Description> all{
      {.name = {}, .summary = kSummary, .flags = {std::move(version)}, .examples = {}, .group = true}};
  for (CLI::App* subcommand : line.subs()) all.push_back(line.declare(*subcommand).description);
  return all;
}

const Description& described(const std::vector<std::string>& words, const std::vector<Description>& all) {
  const std::string name = fmt::format("{}", fmt::join(words, " "));
  std::vector<std::string> names;
  for (const Description& subcommand : all) {
    if (subcommand.name == name) return subcommand;
    if (!subcommand.name.empty()) names.push_back(subcommand.name);
  }
  throw_usage({.where = {},
               .what = "unknown subcommand '" + name + "'",
               .expected = {},
               .got = {},
               .fix = suggestion(name, names)});
}

}  // namespace fastsplat::cli
