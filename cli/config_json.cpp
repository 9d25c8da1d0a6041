#include "cli/config_json.hpp"

#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"

namespace fastsplat::cli {

nlohmann::ordered_json config_identity_json(const cmodel::Config& config) {
  return {{"name", config.name}, {"hash", hash_text(cmodel::config_hash(config))}};
}

nlohmann::ordered_json value_json(const cmodel::Config& config, const cmodel::ConfigKey& key) {
  if (key.names.empty()) return config.*key.member;
  return cmodel::text_of(config, key);
}

nlohmann::ordered_json config_json(const cmodel::Config& config) {
  nlohmann::ordered_json json{{"name", config.name},
                              {"description", config.description},
                              {"verified", config.verified},
                              {"hash", hash_text(cmodel::config_hash(config))}};
  for (const auto& key : cmodel::config_keys()) {
    const std::string name = key.name;
    const auto dot = name.find('.');
    json[name.substr(0, dot)][name.substr(dot + 1)] = value_json(config, key);
  }
  return json;
}

}  // namespace fastsplat::cli
