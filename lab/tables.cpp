// SPDX-License-Identifier: Apache-2.0
#include "lab/tables.hpp"

#include <nlohmann/json.hpp>
#include <variant>

#include "base/each.hpp"
#include "base/version.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/gaussian_frame.hpp"
#include "lab/gaussians.hpp"
#include "lab/limits.hpp"
#include "lab/request.hpp"
#include "scene/embedded.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "scene/settings.hpp"
#include "scene/volume/synthetic.hpp"

namespace fastsplat::lab {
namespace {

using Json = nlohmann::ordered_json;

Json kind_of(const scene::Setting& setting) {
  return std::visit(Each{[](const scene::Real& kind) {
                           return Json{{"kind", "real"}, {"low", kind.low}, {"high", kind.high}};
                         },
                         [](const scene::Integer& kind) {
                           return Json{{"kind", "integer"}, {"low", kind.low}, {"high", kind.high}};
                         },
                         [](const scene::Triple& kind) {
                           return Json{{"kind", "triple"}, {"low", kind.low}, {"high", kind.high}};
                         },
                         [](const scene::Box&) {
                           return Json{{"kind", "box"}};
                         },
                         [](const scene::Switch&) {
                           return Json{{"kind", "choice"}, {"choices", {"off", "on"}}};
                         },
                         [](const scene::Choice& kind) {
                           return Json{{"kind", "choice"}, {"choices", kind.names()}};
                         }},
                    setting.value);
}

Json settings_json() {
  Json out = Json::array();
  for (const scene::Setting& setting : scene::settings()) {
    Json one{{"name", scene::dotted(setting)}, {"flag", setting.flag}, {"group", setting.group},
             {"unit", setting.unit},           {"help", setting.help}, {"default", flag_text(setting, {})}};
    one.update(kind_of(setting));
    out.push_back(one);
  }
  return out;
}

Json keys_json() {
  Json out = Json::array();
  for (const cmodel::ConfigKey& key : cmodel::config_keys()) {
    Json one{{"name", key.name},
             {"low", key.min},
             {"high", key.max},
             {"power_of_two", key.power_of_two},
             {"meaning", key.meaning},
             {"names", Json::array()},
             {"neutral", key.neutral ? Json(*key.neutral) : Json(nullptr)}};
    for (const char* name : key.names) one["names"].push_back(name);
    out.push_back(one);
  }
  return out;
}

}  // namespace

Json tables() {
  Json out{{"version", program_version()}, {"settings", settings_json()}, {"keys", keys_json()}};
  out["configs"] = Json::array();
  for (const auto& name : driver::config_names()) {
    const cmodel::Config config = driver::load_config(name);
    out["configs"].push_back({{"name", name}, {"description", config.description}});
  }
  out["volumes"] = Json::array();
  for (const auto& name : volume::synthetic_names())
    out["volumes"].push_back({{"name", name}, {"size", volume::default_synthetic_size(name)}});
  out["gaussians"] = Json::array();
  for (const auto& name : scene::synthetic_gaussian_names()) out["gaussians"].push_back(name);
  out["gaussian_settings"] = gaussian_settings();
  out["gaussian_config"] = driver::kGaussianConfig;
  out["gaussian_changes"] = Json::object();
  for (const std::string change : driver::kGaussianChanges) {
    const auto equals = change.find('=');
    out["gaussian_changes"][change.substr(0, equals)] = change.substr(equals + 1);
  }
  out["limits"] = {{"least_side", kLeastSide}, {"most_side", kMostSide}, {"most_bytes", kMostFileBytes}};
  out["presets"] = scene::transfer_function_presets();
  out["kernels"] = scene::kernel_names();
  return out;
}

}  // namespace fastsplat::lab
