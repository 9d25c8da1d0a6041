// SPDX-License-Identifier: Apache-2.0
#include "scene/capability.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/capability_table.hpp"
#include "scene/settings.hpp"

namespace fastsplat::scene {
namespace {

ErrorParts parts(std::string where, std::string what, std::string fix) {
  return {.where = std::move(where), .what = std::move(what), .expected = {}, .got = {}, .fix = std::move(fix)};
}

std::string filled(const char* text, const char* with) { return fmt::format(fmt::runtime(text), with); }

/// Why the active technique conflicts with the method, lacks a requirement or meets an exclusion.
std::optional<ErrorParts> contradiction(const TechniqueRow& row, const SceneDescription& description) {
  if (!(row.methods & only(description.method)))
    return parts(row.key, filled(row.no_method, to_string(description.method)), row.method_fix);
  for (const bool wanted : {true, false}) {
    for (const Link& link : wanted ? row.needs : row.excludes) {
      const TechniqueRow& other = row_of(link.other);
      if (other.on(description) == wanted) continue;
      return parts(row.key, filled(link.why, other.name), link.fix ? link.fix : other.turn_on);
    }
  }
  return std::nullopt;
}

/// "image_aligned, axis_aligned or xray": the best first.
std::string listed(Methods methods) {
  std::vector<std::string> names;
  for (int i = static_cast<int>(method_names().size()) - 1; i >= 0; --i) {
    if (methods & only(static_cast<Method>(i))) names.push_back(method_names()[static_cast<std::size_t>(i)]);
  }
  if (names.size() < 2) return names.empty() ? "" : names.front();
  return fmt::format("{} or {}", fmt::join(names.begin(), names.end() - 1, ", "), names.back());
}

}  // namespace

std::optional<ErrorParts> refusal(const SceneDescription& description, const Offers& offers) {
  for (const TechniqueRow& row : technique_rows()) {
    if (!row.on(description)) continue;
    if (auto wrong = contradiction(row, description)) return wrong;
    if (static_cast<unsigned>(row.feature) & ~offers.features) {
      const char* elsewhere = row.feature == Feature::Footprints  ? offers.footprints_fix
                              : row.feature == Feature::Densities ? offers.densities_fix
                              : row.feature == Feature::Details   ? offers.details_fix
                              : row.feature == Feature::Patterns  ? offers.patterns_fix
                                                                  : nullptr;
      return parts(row.key, fmt::format("the {} does not support this technique", offers.engine),
                   fmt::format("{}use --engine golden, or turn it off", elsewhere != nullptr ? elsewhere : ""));
    }
  }
  if (offers.methods & only(description.method)) return std::nullopt;
  const char* method = to_string(description.method);
  return ErrorParts{.where = "method",
                    .what = fmt::format("the {} does not support method '{}'", offers.engine, method),
                    .expected = listed(offers.methods),
                    .got = method,
                    .fix = fmt::format("{}choose one of these, or --engine golden",
                                       offers.methods_elsewhere & only(description.method) ? offers.methods_fix : "")};
}

std::optional<ErrorParts> refusal(const Given& given, const SceneDescription& description) {
  const Setting& setting = *given.setting;
  const Capability& capability = setting.capability;
  const std::string name = given.place.empty() ? setting.flag : dotted(setting);
  const std::string or_else = given.place.empty() ? "" : ", or remove this line";
  if (capability.turns && !row_of(*capability.turns).on(description)) return std::nullopt;
  if (!(capability.methods & only(description.method))) {
    return parts(given.place,
                 fmt::format("{} does not apply to {}, which {}", name, to_string(description.method), capability.why),
                 capability.fix + or_else);
  }
  for (const auto& need : capability.needs) {
    if (!need || row_of(*need).on(description)) continue;
    return parts(given.place, fmt::format("{} has no effect without {}", name, row_of(*need).name),
                 row_of(*need).turn_on + or_else);
  }
  return std::nullopt;
}

void check_capability(const SceneDescription& description, const Offers& offers) {
  if (auto wrong = refusal(description, offers)) throw_usage(std::move(*wrong));
}

void check_capability(const Scene& scene, const Offers& offers) {
  SceneDescription resolved = scene.description;
  resolved.shading = scene.shading.on ? 1 : 0;
  resolved.camera.projection = scene.camera.projection();
  check_capability(resolved, offers);
}

std::vector<Given> idle_of(const std::vector<Given>& given, const SceneDescription& description) {
  std::vector<Given> idle;
  std::copy_if(given.begin(), given.end(), std::back_inserter(idle),
               [&](const Given& one) { return refusal(one, description).has_value(); });
  return idle;
}

void refuse_idle(const std::vector<Given>& idle, const SceneDescription& description) {
  for (const Given& one : idle) {
    auto wrong = refusal(one, description);
    if (!wrong) continue;
    if (one.place.empty()) throw_usage(std::move(*wrong));
    throw_input(std::move(*wrong));
  }
}

}  // namespace fastsplat::scene
