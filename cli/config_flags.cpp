#include "cli/config_flags.hpp"

#include <fmt/format.h>

#include <set>

#include "base/error.hpp"
#include "cli/names.hpp"
#include "driver/config/config_file.hpp"

namespace fastsplat::cli {
namespace {

const char* const kBase = "base";

[[noreturn]] void misused(const std::string& change, ErrorParts parts) {
  parts.where = "--set " + change + (parts.where.empty() ? "" : ": " + parts.where);
  throw_usage(std::move(parts));
}

/// The key that was set.
std::string set(cmodel::Config& config, const std::string& change) {
  const auto equals = change.find('=');
  if (equals == std::string::npos || equals == 0) {
    misused(change, {.where = {},
                     .what = "sets nothing",
                     .expected = "KEY=VALUE",
                     .got = {},
                     .fix = "for example --set radial.entries=256; `fastsplat config show base` lists the keys"});
  }
  const std::string key = change.substr(0, equals);
  if (auto wrong = cmodel::set(config, key, change.substr(equals + 1))) {
    wrong->where.clear();  // the key stands in the change
    misused(change, *wrong);
  }
  return key;
}

/// The keys in which `config` differs from what it was, each with `before`: " radial.entries=256".
std::string differences(const cmodel::Config& was, const cmodel::Config& config, char before) {
  std::string text;
  for (const auto& key : cmodel::config_keys()) {
    if (was.*key.member != config.*key.member)
      text += before + std::string(key.name) + "=" + cmodel::text_of(config, key);
  }
  return text;
}

/// "radial.entries=" of every key; where the values are words, each: "index.kind=rlut".
std::vector<std::string> key_words() {
  std::vector<std::string> words;
  for (const auto& key : cmodel::config_keys()) {
    const std::string begin = std::string(key.name) + "=";
    if (key.names.empty()) words.push_back(begin);
    for (const char* name : key.names) words.push_back(begin + name);
  }
  return words;
}

}  // namespace

void declare(Options& options, ConfigFlags& to, const char* help) {
  options.word("--config", to.config, "NAME|FILE", help);
  options.values(driver::config_names);
  declare_changes(options, to.changes);
}

void declare_changes(Options& options, std::vector<std::string>& to) {
  options.words("--set", to, "KEY=VALUE", "changes a key of the configuration, radial.entries=256; repeatable");
  options.values(key_words);
  options.value(
      "--index", {}, [&to](const std::string& kind) { to.push_back("index.kind=" + kind); }, "KIND",
      "how weights are found: short for --set index.kind=KIND");
  options.values(index_kinds);
}

cmodel::Config load(const std::string& name_or_path, const std::vector<std::string>& changes) {
  cmodel::Config loaded;
  as_word(name_or_path, [&] { loaded = driver::load_config(name_or_path); });
  cmodel::Config config = loaded;
  std::set<std::string> keys;
  for (const auto& change : changes) {
    if (!keys.insert(set(config, change)).second)
      misused(change, {.where = {}, .what = "the key is set twice", .expected = {}, .got = {}, .fix = "set it once"});
  }
  if (auto violation = cmodel::first_violation(config))
    misused(fmt::format("{}", fmt::join(changes, " --set ")), *violation);
  if (config == loaded) return config;
  config.name += differences(loaded, config, '+');
  config.description = loaded.name + " with" + differences(loaded, config, ' ');
  config.verified = "nothing";
  return config;
}

cmodel::Config load(const ConfigFlags& flags) { return load(flags.config.value_or(kBase), flags.changes); }

}  // namespace fastsplat::cli
