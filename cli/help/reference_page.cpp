// SPDX-License-Identifier: Apache-2.0
#include "cli/help/reference_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "cli/help/exit_codes.hpp"
#include "cli/help/offer.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "scene/settings.hpp"

namespace fastsplat::cli {
namespace {

constexpr std::size_t kColumns = 100;
/// A flag that at least this many subcommands declare alike is listed once, in a table of its own.
constexpr int kShared = 3;
/// Longer lists of values are omitted; shell completion offers them.
constexpr std::size_t kMostValues = 24;

std::string cell(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? "\\|" : std::string(1, c);
  return out;
}

std::string coded(const std::string& text) { return "`" + cell(text) + "`"; }

std::string link(const std::string& title) {
  std::string anchor;
  for (const char c : title) {
    if (c == ' ') anchor += '-';
    if (c == '-' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z')) anchor += c;
    if (c >= 'A' && c <= 'Z') anchor += static_cast<char>(c - 'A' + 'a');
  }
  return fmt::format("[{}](#{})", title, anchor);
}

/// Makes the help's line a sentence.
std::string sentence(std::string text) {
  if (text.front() >= 'a' && text.front() <= 'z') text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text.ends_with('?') ? text : text + ".";
}

/// "Also: a, b, c.", wrapped.
std::string listed(const std::string& head, const std::vector<std::string>& words) {
  std::string text = "\n" + head;
  std::size_t length = head.size();
  for (const std::string& word : words) {
    if (length + word.size() + 2 > kColumns) {
      text += "\n" + word;
      length = word.size();
    } else {
      text += " " + word;
      length += word.size() + 1;
    }
    text += &word == &words.back() ? '.' : ',';
    ++length;
  }
  return text + "\n";
}

bool alike(const Flag& a, const Flag& b) {
  return a.names == b.names && a.unit == b.unit && a.help == b.help && a.group == b.group;
}

bool declares(const Description& subcommand, const Flag& flag) {
  return std::any_of(subcommand.flags.begin(), subcommand.flags.end(),
                     [&](const Flag& own) { return alike(own, flag); });
}

std::string title_of(const std::string& group) { return group + " flags"; }

struct Group {
  std::string name;
  std::vector<Flag> flags;
};

/// The flags that several subcommands share, under their headings, in the order declared.
std::vector<Group> shared_groups(const std::vector<Description>& all) {
  std::vector<Group> groups;
  for (const Description& subcommand : all) {
    for (const Flag& flag : subcommand.flags) {
      const auto users =
          std::count_if(all.begin(), all.end(), [&](const auto& other) { return declares(other, flag); });
      if (flag.positional() || users < kShared) continue;
      auto at = std::find_if(groups.begin(), groups.end(), [&](const auto& one) { return one.name == flag.group; });
      if (at == groups.end()) at = groups.insert(at, {flag.group, {}});
      const bool there =
          std::any_of(at->flags.begin(), at->flags.end(), [&](const auto& one) { return alike(one, flag); });
      if (!there) at->flags.push_back(flag);
    }
  }
  return groups;
}

bool has_all(const Description& subcommand, const Group& group) {
  return std::all_of(group.flags.begin(), group.flags.end(),
                     [&](const Flag& flag) { return declares(subcommand, flag); });
}

const scene::Setting* setting_of(const Flag& flag) {
  for (const scene::Setting& setting : scene::settings()) {
    if (flag.names.back() == setting.flag) return &setting;
  }
  return nullptr;
}

std::string meaning(const Flag& flag) {
  std::string text = cell(flag.help);
  const auto names = flag.values ? flag.values() : std::vector<std::string>{};
  const bool said = std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return flag.help.find(name) != flag.help.npos || flag.unit.find(name) != flag.unit.npos;
  });
  if (!said && names.size() <= kMostValues)
    text += fmt::format(". One of: {}{}", cell(fmt::format("{}", fmt::join(names, ", "))),
                        flag.takes_file() ? ", or a file" : "");
  if (flag.required) text += " (required)";
  if (flag.repeatable && flag.help.find("repeatable") == flag.help.npos) text += " (repeatable)";
  return text;
}

std::string table(const std::vector<Flag>& flags) {
  if (flags.empty()) return {};
  const bool defaults = std::any_of(flags.begin(), flags.end(), setting_of);
  std::string text = defaults ? "\n| flag | meaning | default |\n|---|---|---|\n" : "\n| flag | meaning |\n|---|---|\n";
  for (const Flag& flag : flags) {
    text +=
        fmt::format("| {} | {} |",
                    coded(fmt::format("{}{}{}", fmt::join(flag.names, ", "), flag.unit.empty() ? "" : " ", flag.unit)),
                    meaning(flag));
    if (defaults) {
      const scene::Setting* setting = setting_of(flag);
      text += setting ? fmt::format(" {} |", coded(value_as_toml(*setting, {}))) : " |";
    }
    text += "\n";
  }
  return text;
}

std::string section(const Description& subcommand, const std::vector<Group>& groups) {
  std::string text = fmt::format("\n## {}\n\n{}\n\n```sh\n", subcommand.name, sentence(subcommand.summary));
  for (const Example& example : subcommand.examples) text += fmt::format("# {}\n{}\n", example.does, example.command);
  text += "```\n";
  std::vector<Flag> own;
  std::vector<std::string> shared;
  for (const Group& group : groups) {
    if (has_all(subcommand, group)) shared.push_back(link(title_of(group.name)));
  }
  for (const Flag& flag : subcommand.flags) {
    const bool elsewhere = std::any_of(groups.begin(), groups.end(), [&](const Group& group) {
      return has_all(subcommand, group) &&
             std::any_of(group.flags.begin(), group.flags.end(), [&](const auto& one) { return alike(one, flag); });
    });
    if (!elsewhere) own.push_back(flag);
  }
  text += table(own);
  if (!shared.empty()) text += listed("Also:", shared);
  return text;
}

std::string allowed(const scene::Setting& setting) {
  struct Visitor {
    std::string operator()(const scene::Real& is) const { return fmt::format("{} to {}", is.low, is.high); }
    std::string operator()(const scene::Integer& is) const { return fmt::format("{} to {}, whole", is.low, is.high); }
    std::string operator()(const scene::Triple& is) const {
      return fmt::format("three numbers, {} to {}", is.low, is.high);
    }
    std::string operator()(const scene::Box&) const { return "\"A..B,C..D,E..F\", or \"\" for all"; }
    std::string operator()(const scene::Switch&) const { return "true, false"; }
    std::string operator()(const scene::Choice& is) const { return fmt::format("{}", fmt::join(is.names(), ", ")); }
  };
  return std::visit(Visitor{}, setting.value);
}

std::string keys() {
  std::string text = "\n## Keys of scene.toml\n\n| key | allowed | default | flag |\n|---|---|---|---|\n";
  for (const scene::Setting& setting : scene::settings()) {
    text += fmt::format("| `{}` | {} | {} | {} |\n", dotted(setting), cell(allowed(setting)),
                        coded(value_as_toml(setting, {})), *setting.flag ? coded(setting.flag) : "");
  }
  return text;
}

std::string capabilities() {
  const scene::Offers engines[] = {scene::kOffersAll, driver::offers(driver::load_config("base")),
                                   driver::offers(driver::load_config("ellipse"))};
  return "\n## What goes with what\n\nSettings that are not listed go with everything. `golden` is the floating-point "
         "engine.\n"
         "`device` stands for `cmodel` and `rtl`. [Scenes](scenes.md#settings-that-do-not-apply) explains the\n"
         "table.\n\n" +
         scene::capability_guide(engines);
}

std::string configurations() {
  std::string text = "\n## Configurations\n\n| name | lanes | tile | description |\n|---|---|---|---|\n";
  for (const std::string& name : driver::config_names()) {
    const auto config = driver::load_config(name);
    text += fmt::format("| `{}` | {} x {} | {} x {} | {} |\n", name, config.lanes, config.lanes, config.tile_width,
                        config.tile_height, cell(config.description));
  }
  return text;
}

std::string exit_codes() {
  std::string text = "\n## Exit codes\n\n| code | name | meaning |\n|---|---|---|\n";
  for (const auto& [code, word, meaning] : kExitMeanings)
    text += fmt::format("| {} | {} | {} |\n", static_cast<int>(code), word, cell(meaning));
  return text;
}

}  // namespace

std::string reference_page(const std::vector<Description>& all) {
  const auto groups = shared_groups(all);
  std::string text =
      "<!-- Made by `fastsplat help --markdown`; do not edit. -->\n# Reference\n\n"
      "Every subcommand, flag, scene key, configuration and exit code. The program writes this page.\n"
      "`fastsplat help SUBCOMMAND` prints the same for one subcommand, `fastsplat config show base` every\n"
      "configuration key. Shared flags stand once, behind the subcommands.\n\n";
  for (const Description& subcommand : all) {
    if (subcommand.name.empty() || subcommand.group) continue;
    text += fmt::format("- {}: {}\n", link(subcommand.name), subcommand.summary);
  }
  text +=
      "- [Keys of scene.toml](#keys-of-scenetoml), [what goes with what](#what-goes-with-what),\n"
      "  [configurations](#configurations), [exit codes](#exit-codes)\n";
  for (const Description& subcommand : all) {
    if (!subcommand.name.empty() && !subcommand.group) text += section(subcommand, groups);
  }
  for (const Group& group : groups) text += fmt::format("\n## {}\n", title_of(group.name)) + table(group.flags);
  return text + keys() + capabilities() + configurations() + exit_codes();
}

}  // namespace fastsplat::cli
