#include "testbench/device/rtl_device.hpp"

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "cmodel/sv_package.hpp"
#include "testbench/device/rtl_registry.hpp"

namespace fastsplat::testbench {
namespace {

const RtlEntry& entry_of(const cmodel::Config& config, const std::string& otherwise = {}) {
  const std::uint64_t hash = cmodel::config_hash(config);
  std::string known;
  for (const auto& entry : rtl_registry()) {
    if (entry.hash == hash) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.config) + " (" + hash_text(entry.hash) + ")";
  }
  if (auto never = cmodel::rtl_violation(config)) {
    never->where = "configuration " + config.name + ": " + never->where;
    if (!otherwise.empty()) never->fix = otherwise;
    throw_usage(*never);
  }
  throw_usage({.where = "configuration " + config.name,
               .what = "has no RTL in this build",
               .expected = "one of " + known,
               .got = hash_text(hash),
               .fix = (otherwise.empty() ? "" : otherwise + "; or ") +
                      "save it with `fastsplat config show` and build its RTL: FASTSPLAT_RTL_CONFIGS=FILE.toml ./run "
                      "build (docs/guide.md, \"RTL of your own\")"});
}

}  // namespace

std::vector<std::string> rtl_config_names() {
  std::vector<std::string> names;
  for (const auto& entry : rtl_registry()) {
    if (std::string name = entry.config; !name.ends_with(".toml")) names.push_back(std::move(name));
  }
  return names;
}

void require_rtl(const cmodel::Config& config, const std::string& otherwise) { entry_of(config, otherwise); }

std::unique_ptr<RtlDevice> make_rtl_device(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                           const RtlOptions& options) {
  return entry_of(config).make(config, pixels, options);
}

}  // namespace fastsplat::testbench
