// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/make.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/sweep/kinds.hpp"
#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/hash_text.hpp"
#include "base/suggest.hpp"

namespace fastsplat::plan {
namespace {

constexpr std::size_t kMostCases = 1'000'000;
/// Settings whose value may be a file, named relative to the specification's folder.
constexpr const char* kFiles[] = {"config", "scene", "volume", "tf", "stream"};

/// A combination of values: all settings, and the axes that identify the row.
struct Point {
  Settings settings, axes;
};

std::string described(const Settings& axes) {
  std::string text;
  for (const auto& [name, value] : axes) text += (text.empty() ? "" : " ") + name + "=" + to_text(value);
  return text;
}

class Maker {
 public:
  Maker(const Spec& spec, const Vocabulary& vocabulary) : spec_(spec), vocabulary_(vocabulary) {
    for (const auto& kind : spec.kinds) {
      for (auto& step : steps_of(kind)) {
        subcommands_.push_back(step.subcommand);
        steps_.push_back(std::move(step));
      }
    }
    for (const auto& subcommand : subcommands_) {
      try {
        if (!flags_.contains(subcommand)) flags_[subcommand] = vocabulary.flags_of(subcommand);
      } catch (const UserError& error) {
        throw_input({.where = spec.file.string(),
                     .what = fmt::format("unknown kind '{}'", subcommand),
                     .expected = "a subcommand with a JSON result, see docs/plan.md",
                     .got = {},
                     .fix = error.parts().fix});
      }
    }
    check_names();
  }

  /// Makes the case again from its settings.
  Case again(const Case& one) const { return case_of({.settings = one.settings, .axes = one.axes}); }

  Made make(const Progress& progress) const {
    Made made;
    made.plan.name = spec_.name;
    made.plan.title = spec_.title;
    made.plan.metrics = spec_.metrics;
    for (const Zip& zip : spec_.axes) made.plan.axes.insert(made.plan.axes.end(), zip.begin(), zip.end());
    std::map<std::string, std::string> seen;
    const std::size_t cases = count();
    for (std::size_t at = 0; at < cases; ++at) {
      if (progress) progress(at, cases);
      const Point point = this->point(at);
      Case one;
      try {
        one = case_of(point);
      } catch (const UserError& error) {
        if (error.code() != ExitCode::Usage || !spec_.leave_out_refused) refuse(point, error);
        made.left_out.push_back(described(point.axes) + ": " + error.what());
        continue;
      }
      const auto [other, is_new] = seen.emplace(one.id, described(point.axes));
      if (!is_new) {
        throw_input({.where = spec_.file.string(),
                     .what = fmt::format("two cases are identical: {} and {}", other->second, described(point.axes)),
                     .expected = "a different command or content for each",
                     .got = {},
                     .fix = "remove one of the values"});
      }
      made.plan.cases.push_back(std::move(one));
    }
    if (made.plan.cases.empty()) {
      throw_input({.where = spec_.file.string(),
                   .what = "the specification makes no cases",
                   .expected = {},
                   .got = made.left_out.front(),
                   .fix = "change its axes: every combination was left out"});
    }
    made.plan.hash = to_json(made.plan)["hash"];
    return made;
  }

 private:
  [[noreturn]] void refuse(const Point& point, const UserError& error) const {
    const std::string place = fmt::format("{}: {}", spec_.file.string(), described(point.axes));
    ErrorParts parts = error.parts();
    parts.where = parts.where.empty() ? place : place + ": " + parts.where;
    if (error.code() == ExitCode::Usage && parts.fix.empty())
      parts.fix = "add refused = \"leave out\" to skip such combinations";
    throw UserError(ExitCode::Input, std::move(parts));
  }

  std::size_t count() const {
    std::size_t cases = 1;
    for (const Zip& zip : spec_.axes) {
      cases *= zip.front().values.size();
      if (cases > kMostCases) {
        throw_input({.where = spec_.file.string(),
                     .what = "too many cases",
                     .expected = fmt::format("at most {}", kMostCases),
                     .got = {},
                     .fix = "split the specification"});
      }
    }
    return cases;
  }

  Point point(std::size_t at) const {
    Point point{.settings = spec_.constants, .axes = {}};
    std::vector<std::size_t> places(spec_.axes.size());
    for (std::size_t axis = spec_.axes.size(); axis-- > 0;) {
      const std::size_t size = spec_.axes[axis].front().values.size();
      places[axis] = at % size;
      at /= size;
    }
    for (std::size_t axis = 0; axis < places.size(); ++axis) {
      for (const Axis& one : spec_.axes[axis]) {
        point.axes.push_back({one.name, one.values[places[axis]]});
        if (!one.is_label) point.settings.push_back(point.axes.back());
      }
    }
    std::ranges::sort(point.settings, {}, &Setting::name);
    for (Setting& setting : point.settings) find_file(setting);
    return point;
  }

  void find_file(Setting& setting) const {
    auto* text = std::get_if<std::string>(&setting.value);
    if (text == nullptr || std::ranges::find(kFiles, setting.name) == std::end(kFiles)) return;
    std::error_code ignored;
    const auto path = (spec_.file.parent_path() / *text).lexically_normal();
    if (std::filesystem::is_regular_file(path, ignored)) *text = path.string();
  }

  bool takes(const StepOfKind& step, const std::string& name) const {
    const bool of_device = is_key(name) || name == "config" || name == "index" || name == "counters";
    if (of_device && !step.takes_device) return false;
    const std::string flag = is_key(name) ? "--set" : "--" + name;
    const auto& flags = flags_.at(step.subcommand);
    return std::ranges::find(flags, flag) != flags.end();
  }

  void check_names() const {
    std::vector<std::string> known;
    for (const auto& [subcommand, flags] : flags_) {
      for (const auto& flag : flags) {
        if (!is_given_by_run(flag.substr(2))) known.push_back(flag.substr(2));
      }
    }
    const auto check = [&](const std::string& name) {
      const bool given = is_given_by_run(name);
      if (!given && std::ranges::any_of(steps_, [&](const auto& step) { return takes(step, name); })) return;
      throw_input({.where = spec_.file.string(),
                   .what = given ? fmt::format("{} cannot be set: the run sets it", name)
                                 : fmt::format("{} is not a flag of {}", name, fmt::join(spec_.kinds, ", ")),
                   .expected = "a flag without its dashes, or a configuration key",
                   .got = {},
                   .fix = given ? "leave it out" : suggestion(name, known)});
    };
    for (const auto& [name, value] : spec_.constants) check(name);
    for (const Zip& zip : spec_.axes) {
      for (const Axis& axis : zip) {
        if (!axis.is_label) check(axis.name);
      }
    }
  }

  static void add(const Setting& setting, Words& to) {
    const std::string text = to_text(setting.value);
    if (file_of(text)) {
      throw_usage({.where = setting.name,
                   .what = "words in braces are reserved for files of a case",
                   .expected = {},
                   .got = text,
                   .fix = "choose another name"});
    }
    if (is_key(setting.name)) {
      to.insert(to.end(), {"--set", setting.name + "=" + text});
    } else if (const auto* flag = std::get_if<bool>(&setting.value)) {
      if (*flag) to.push_back("--" + setting.name);
    } else if (text.starts_with('-')) {
      to.push_back("--" + setting.name + "=" + text);  // a negative number, not a flag
    } else {
      to.insert(to.end(), {"--" + setting.name, text});
    }
  }

  Case case_of(const Point& point) const {
    Case one{.id = {},
             .axes = point.axes,
             .kind = fmt::format("{}", fmt::join(spec_.kinds, "+")),
             .settings = point.settings,
             .content = vocabulary_.content(point.settings, subcommands_),
             .steps = {}};
    std::map<std::string, std::string> shared;  // "{golden.exr}": "{golden-HASH.exr}"
    for (const StepOfKind& step : steps_) {
      Step made{.words = {}, .result = step.has_result ? step.subcommand : "", .shared = {}, .coverage = step.coverage};
      for (std::size_t at = 0, space = 0; at <= step.subcommand.size(); at = space + 1) {
        space = std::min(step.subcommand.find(' ', at), step.subcommand.size());
        made.words.push_back(step.subcommand.substr(at, space - at));
      }
      made.words.insert(made.words.end(), step.files.begin(), step.files.end());
      for (const Setting& setting : point.settings) {
        if (takes(step, setting.name)) add(setting, made.words);
      }
      made.words.insert(made.words.end(), step.outputs.begin(), step.outputs.end());
      if (!step.shared.empty()) {
        const std::filesystem::path file(step.shared);
        const auto hash = fnv1a(fnv1a(kFnv1aStart, shell_line(made.words)), one.content.scene_hash);
        made.shared = file.stem().string() + "-" + hash_text(hash) + file.extension().string();
        shared["{" + step.shared + "}"] = "{" + made.shared + "}";
      }
      for (auto& word : made.words) {
        if (const auto other = shared.find(word); other != shared.end()) word = other->second;
      }
      vocabulary_.check(made.words);
      one.steps.push_back(std::move(made));
    }
    one.id = id_of(one);
    return one;
  }

  const Spec& spec_;
  const Vocabulary& vocabulary_;
  std::vector<StepOfKind> steps_;
  std::vector<std::string> subcommands_;
  std::map<std::string, std::vector<std::string>> flags_;
};

}  // namespace

Made make(const Spec& spec, const Vocabulary& vocabulary, const Progress& progress) {
  return Maker(spec, vocabulary).make(progress);
}

void require_made(const Plan& plan, const Vocabulary& vocabulary, const std::filesystem::path& file) {
  Vocabulary unchecked = vocabulary;
  unchecked.check = [](const Words&) {};  // the program itself refuses unknown words
  for (const Case& one : plan.cases) {
    const auto refuse = [&](const std::string& got) {
      throw_input({.where = file.string(),
                   .what = fmt::format("case {} was not written by `fastsplat plan make`", one.id),
                   .expected = "the steps of its kind and its settings",
                   .got = got,
                   .fix = "make the plan again from its specification"});
    };
    Spec spec;
    spec.file = file;
    spec.constants = one.settings;
    for (std::size_t at = 0, plus = 0; at <= one.kind.size(); at = plus + 1) {
      plus = std::min(one.kind.find('+', at), one.kind.size());
      spec.kinds.push_back(one.kind.substr(at, plus - at));
    }
    std::vector<Step> steps;
    try {
      steps = Maker(spec, unchecked).again(one).steps;
    } catch (const UserError& error) {
      refuse(error.parts().what);
    }
    if (steps != one.steps) refuse(command_of(one));
  }
}

}  // namespace fastsplat::plan
