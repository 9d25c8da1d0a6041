// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "scene/capability_table.hpp"
#include "scene/settings.hpp"

namespace fastsplat::scene {
namespace {

/// Content of one line of the table.
struct Line {
  Methods methods = kAllMethods;
  unsigned features = 0;
  std::vector<std::string> needs, excludes;
};

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

/// Adds everything that `technique` requires.
void add(Line& line, Technique technique) {
  const TechniqueRow& row = row_of(technique);
  line.methods &= row.methods;
  line.features |= static_cast<unsigned>(row.feature);
  for (const Link& link : row.needs) add_once(line.needs, row_of(link.other).name);
  for (const Link& link : row.excludes) add_once(line.excludes, row_of(link.other).name);
}

Line line_of(const Capability& capability) {
  Line line;
  line.methods = capability.methods;
  for (const auto& need : capability.needs) {
    if (!need) continue;
    add(line, *need);
    add_once(line.needs, row_of(*need).name);
  }
  if (capability.turns) add(line, *capability.turns);
  return line;
}

std::string methods_of(Methods methods) {
  if (methods == kAllMethods) return "all";
  std::vector<std::string> names;
  for (int i = static_cast<int>(method_names().size()) - 1; i >= 0; --i) {
    if (methods & only(static_cast<Method>(i))) names.push_back(method_names()[static_cast<std::size_t>(i)]);
  }
  return fmt::format("`{}`", fmt::join(names, "`, `"));
}

/// Engines that have the features and at least one of the methods.
std::string engines_of(const Line& line, std::span<const Offers> engines) {
  std::vector<std::string> names;
  for (const Offers& offers : engines) {
    if (!(line.features & ~offers.features) && (line.methods & offers.methods)) names.emplace_back(offers.engine);
  }
  return names.size() == engines.size() ? "all" : fmt::format("{}", fmt::join(names, ", "));
}

bool says_nothing(const Line& line) {
  return line.methods == kAllMethods && line.features == 0 && line.needs.empty() && line.excludes.empty();
}

std::string cells(const std::string& name, const Line& line, std::span<const Offers> engines) {
  return fmt::format("| {} | {} | {} | {} | {} |\n", name, methods_of(line.methods), engines_of(line, engines),
                     fmt::join(line.needs, "; "), fmt::join(line.excludes, "; "));
}

}  // namespace

std::string capability_guide(std::span<const Offers> engines) {
  std::string text = "| | methods | engines | only with | not with |\n|---|---|---|---|---|\n";
  for (std::size_t i = method_names().size(); i-- > 0;) {
    Line line;
    line.methods = only(static_cast<Method>(i));
    text += cells(fmt::format("`--method {}`", method_names()[i]), line, engines);
  }
  for (const Setting& setting : settings()) {
    const Line line = line_of(setting.capability);
    if (says_nothing(line)) continue;
    text +=
        cells(*setting.flag ? fmt::format("`{}`", setting.flag) : fmt::format("`{}`", dotted(setting)), line, engines);
  }
  // Requirements of single values of a setting, beyond those of the setting itself.
  for (const TechniqueRow& row : technique_rows()) {
    const bool whole = std::any_of(settings().begin(), settings().end(),
                                   [&](const Setting& s) { return s.capability.turns == row.technique; });
    Line line;
    add(line, row.technique);
    if (!whole && !says_nothing(line)) text += cells(row.name, line, engines);
  }
  return text;
}

}  // namespace fastsplat::scene
