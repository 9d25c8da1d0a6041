// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include "driver/config/builtin_configs.hpp"
#include "driver/config/config_file.hpp"
#include "driver/config/config_text.hpp"
#include "testbench/capi/config_handle.hpp"
#include "testbench/capi/guard.hpp"
#include "testbench/capi/handles.hpp"

namespace fastsplat::capi {
namespace {

constexpr std::size_t kLongestText = std::size_t{1} << 20;

fastsplat_status hand_out(cmodel::Config config, fastsplat_config** out) {
  auto handle = std::make_unique<fastsplat_config>(fastsplat_config{std::move(config)});
  born(handle.get(), Kind::Config);
  *out = handle.release();
  return FASTSPLAT_OK;
}

}  // namespace

const cmodel::Config& config_of(const char* function, const fastsplat_config* handle) {
  require_live(function, handle, Kind::Config);
  return handle->config;
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_config_named(const char* name, fastsplat_config** out) {
  return guarded(__func__, [&](const char* call) {
    require(call, "name", name);
    require(call, "out", out);
    const auto builtin = driver::builtin_configs();
    if (std::ranges::none_of(builtin, [&](const auto& one) { return std::string(one.name) == name; })) {
      std::string names;
      for (const auto& one : builtin) names += (names.empty() ? "" : ", ") + std::string(one.name);
      throw_input({.where = name,
                   .what = "no such built-in configuration",
                   .expected = names,
                   .got = {},
                   .fix = "use fastsplat_config_file for a file"});
    }
    return hand_out(driver::load_config(name), out);
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_config_text(const char* toml, std::size_t bytes, const char* where,
                                                                fastsplat_config** out) {
  return guarded(__func__, [&](const char* call) {
    require(call, "toml", toml);
    require(call, "out", out);
    if (bytes > kLongestText)
      misuse(call, "too long for a configuration", "at most 1 MiB", std::to_string(bytes) + " bytes");
    return hand_out(driver::parse_config(where == nullptr ? "configuration" : where, std::string(toml, bytes)), out);
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_config_file(const char* path, fastsplat_config** out) {
  return guarded(__func__, [&](const char* call) {
    require(call, "path", path);
    require(call, "out", out);
    // A file stays a file, even if a built-in configuration has its name.
    const std::string named = path;
    std::error_code ignored;
    if (!std::filesystem::exists(named, ignored)) {
      throw_input({.where = named,
                   .what = "no such file",
                   .expected = "a configuration's .toml file",
                   .got = {},
                   .fix = "use fastsplat_config_named for built-in ones"});
    }
    return hand_out(driver::load_config(named.find('/') == std::string::npos ? "./" + named : named), out);
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_config_destroy(fastsplat_config* config) {
  return guarded(__func__, [&](const char* call) {
    if (config == nullptr) return FASTSPLAT_OK;
    bury(call, config, Kind::Config);
    delete config;
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_config_name(std::size_t index, const char** out) {
  return guarded(__func__, [&](const char* call) {
    require(call, "out", out);
    const auto builtin = driver::builtin_configs();
    if (index >= builtin.size()) return FASTSPLAT_NONE;
    *out = builtin[index].name;
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_config_hash(const fastsplat_config* config, std::uint64_t* out) {
  return guarded(__func__, [&](const char* call) {
    require(call, "out", out);
    *out = cmodel::config_hash(config_of(call, config));
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_config_value(const fastsplat_config* config, const char* key,
                                                                 std::int64_t* out) {
  return guarded(__func__, [&](const char* call) {
    require(call, "key", key);
    require(call, "out", out);
    const auto& of = config_of(call, config);
    const cmodel::ConfigKey* found = cmodel::find_key(key);
    if (found == nullptr) misuse(call, std::string("unknown key '") + key + "'", "table.key, as in the file");
    *out = of.*found->member;
    return FASTSPLAT_OK;
  });
}

}  // namespace fastsplat::capi
