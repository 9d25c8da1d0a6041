// SPDX-License-Identifier: Apache-2.0
#include "driver/config/changed.hpp"

#include <fmt/format.h>

#include <set>

#include "base/error.hpp"

namespace fastsplat::driver {
namespace {

constexpr std::string_view kIndex = "--index ";

[[noreturn]] void misused(const std::string& flags, ErrorParts parts) {
  parts.where = flags + (parts.where.empty() ? "" : ": " + parts.where);
  throw_usage(std::move(parts));
}

/// Applies `change`; returns its key.
std::string set(cmodel::Config& config, const std::string& typed) {
  const std::string change = typed.starts_with(kIndex) ? "index.kind=" + typed.substr(kIndex.size()) : typed;
  const auto equals = change.find('=');
  if (equals == std::string::npos || equals == 0) {
    misused(as_flag(typed),
            {.where = {},
             .what = "not a setting",
             .expected = "KEY=VALUE",
             .got = {},
             .fix = "for example --set radial.entries=256; `fastsplat config show base` lists the keys"});
  }
  const std::string key = change.substr(0, equals);
  if (auto wrong = cmodel::set(config, key, change.substr(equals + 1))) {
    wrong->where.clear();  // the flag already names the key
    misused(as_flag(typed), *wrong);
  }
  return key;
}

/// The keys whose values differ between `was` and `config`, each preceded by `before`: " radial.entries=256".
std::string differences(const cmodel::Config& was, const cmodel::Config& config, char before) {
  std::string text;
  for (const auto& key : cmodel::config_keys()) {
    if (was.*key.member != config.*key.member)
      text += before + std::string(key.name) + "=" + cmodel::text_of(config, key);
  }
  return text;
}

}  // namespace

std::string as_flag(const std::string& change) { return change.starts_with(kIndex) ? change : "--set " + change; }

cmodel::Config changed(const cmodel::Config& config, std::span<const std::string> changes) {
  cmodel::Config out = config;
  std::set<std::string> keys;
  for (const auto& change : changes) {
    if (!keys.insert(set(out, change)).second)
      misused(as_flag(change),
              {.where = {}, .what = "the key is set twice", .expected = {}, .got = {}, .fix = "set it once"});
  }
  if (auto violation = cmodel::first_violation(out)) {
    std::string flags;
    for (const auto& change : changes) flags += (flags.empty() ? "" : " ") + as_flag(change);
    misused(flags, *violation);
  }
  if (out == config) return out;
  out.name += differences(config, out, '+');
  out.description = config.name + " with" + differences(config, out, ' ');
  out.verified = "nothing";
  return out;
}

}  // namespace fastsplat::driver
