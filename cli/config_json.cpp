// SPDX-License-Identifier: Apache-2.0
#include "cli/config_json.hpp"

#include <nlohmann/json.hpp>

#include "analysis/errors/area.hpp"
#include "analysis/errors/cost.hpp"
#include "analysis/errors/synthesised.hpp"
#include "analysis/index_kinds/family_cost.hpp"
#include "base/hash_text.hpp"

namespace fastsplat::cli {
namespace {

constexpr int kPricedRadius = 2;  ///< pixels: the footprint of a voxel one pixel wide

}  // namespace

nlohmann::ordered_json config_identity_json(const cmodel::Config& config) {
  return {{"name", config.name}, {"hash", hash_text(cmodel::config_hash(config))}};
}

nlohmann::ordered_json priced_config_json(const cmodel::Config& config) {
  auto json = config_identity_json(config);
  // The cost model covers the device of rtl/ only.
  const bool counted = config.index() == cmodel::IndexKind::Rlut;
  json["cost"] = counted ? analysis::to_json(analysis::cost(config)) : nlohmann::ordered_json(nullptr);
  json["synthesis"] = analysis::synthesised(config);
  json["area"] = analysis::area_json(config);
  json["index_cost"] = {{"radius", kPricedRadius},
                        {"table_bits", analysis::storage_bits(config, kPricedRadius)},
                        {"cycles_per_splat", analysis::cycles_per_splat(config, kPricedRadius)}};
  return json;
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
  const auto priced = priced_config_json(config);
  for (const char* name : {"cost", "synthesis", "area", "index_cost"}) json[name] = priced.at(name);
  for (const auto& key : cmodel::config_keys()) {
    const std::string name = key.name;
    const auto dot = name.find('.');
    json[name.substr(0, dot)][name.substr(dot + 1)] = value_json(config, key);
  }
  return json;
}

}  // namespace fastsplat::cli
