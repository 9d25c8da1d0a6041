// SPDX-License-Identifier: Apache-2.0
#include "driver/config/changed.hpp"

#include <fmt/format.h>

#include <set>

#include "base/error.hpp"

namespace fastsplat::driver {
namespace {

[[noreturn]] void misused(const std::string& change, ErrorParts parts) {
  parts.where = "--set " + change + (parts.where.empty() ? "" : ": " + parts.where);
  throw_usage(std::move(parts));
}

/// Applies `change`; returns its key.
std::string set(cmodel::Config& config, const std::string& change) {
  const auto equals = change.find('=');
  if (equals == std::string::npos || equals == 0) {
    misused(change, {.where = {},
                     .what = "not a setting",
                     .expected = "KEY=VALUE",
                     .got = {},
                     .fix = "for example --set radial.entries=256; `fastsplat config show base` lists the keys"});
  }
  const std::string key = change.substr(0, equals);
  if (auto wrong = cmodel::set(config, key, change.substr(equals + 1))) {
    wrong->where.clear();  // the change already names the key
    misused(change, *wrong);
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

cmodel::Config changed(const cmodel::Config& config, std::span<const std::string> changes) {
  cmodel::Config out = config;
  std::set<std::string> keys;
  for (const auto& change : changes) {
    if (!keys.insert(set(out, change)).second)
      misused(change, {.where = {}, .what = "the key is set twice", .expected = {}, .got = {}, .fix = "set it once"});
  }
  if (auto violation = cmodel::first_violation(out))
    misused(fmt::format("{}", fmt::join(changes, " --set ")), *violation);
  if (out == config) return out;
  out.name += differences(config, out, '+');
  out.description = config.name + " with" + differences(config, out, ' ');
  out.verified = "nothing";
  return out;
}

}  // namespace fastsplat::driver
