// SPDX-License-Identifier: Apache-2.0
#include "cli/typed_names.hpp"

#include <algorithm>

#include "scene/settings.hpp"

namespace fastsplat::cli {

ErrorParts as_typed(ErrorParts parts, const std::vector<std::string>& words) {
  const auto colon = parts.where.rfind(": ");
  const std::size_t at = colon == std::string::npos ? 0 : colon + 2;
  const std::string key = parts.where.substr(at);
  std::string flag = key == "index.kind" ? "--index" : "";
  for (const scene::Setting& setting : scene::settings()) {
    if (key == scene::dotted(setting)) flag = setting.flag;
  }
  const bool typed =
      std::ranges::any_of(words, [&](const std::string& word) { return word == flag || word.starts_with(flag + "="); });
  if (!flag.empty() && typed) parts.where.replace(at, std::string::npos, flag);
  return parts;
}

}  // namespace fastsplat::cli
