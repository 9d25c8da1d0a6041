// SPDX-License-Identifier: Apache-2.0
#include "cli/config_flags.hpp"

#include "cli/names.hpp"
#include "driver/config/changed.hpp"
#include "driver/config/config_file.hpp"

namespace fastsplat::cli {
namespace {

const char* const kBase = "base";

/// "radial.entries=" for every key; keys whose values are words give one entry per word, "index.kind=rlut".
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
  options.words("--set", to, "KEY=VALUE",
                "change a key of the configuration, for example radial.entries=256; repeatable");
  options.values(key_words);
  options.value(
      "--index", Options::one_of(index_kinds()), [&to](const std::string& kind) { to.push_back("--index " + kind); },
      "KIND", "index method that finds weights: short for --set index.kind=KIND");
  options.values(index_kinds);
}

cmodel::Config load(const std::string& name_or_path, const std::vector<std::string>& changes) {
  cmodel::Config loaded;
  as_word(name_or_path, [&] { loaded = driver::load_config(name_or_path); });
  return driver::changed(loaded, changes);
}

cmodel::Config load(const ConfigFlags& flags) { return load(flags.config.value_or(kBase), flags.changes); }

}  // namespace fastsplat::cli
