// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/synthesised.hpp"

#include <algorithm>

#include "analysis/errors/synthesis_text.hpp"
#include "base/hash_text.hpp"

namespace fastsplat::analysis {

using Json = nlohmann::ordered_json;

Json synthesised(const cmodel::Config& config) {
  static const Json designs = Json::parse(kSynthesisText);
  const std::string hash = hash_text(cmodel::config_hash(config));
  Json out;
  for (const Json& design : designs) {
    if (design.value("configuration", "") != hash || !design.contains("modules")) continue;
    Json& family = out[design.at("family").get<std::string>()];
    family = design.at("total");
    int levels = 0;
    for (const auto& [name, module] : design.at("modules").items())
      levels = std::max(levels, module.at("levels").get<int>());
    family["levels"] = levels;
    family["tool"] = design.at("tools").at("yosys");
  }
  return out;
}

}  // namespace fastsplat::analysis
