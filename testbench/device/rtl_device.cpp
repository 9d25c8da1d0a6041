#include "testbench/device/rtl_device.hpp"

#include "base/error.hpp"
#include "testbench/device/rtl_registry.hpp"

namespace fastsplat::testbench {

std::vector<std::string> rtl_config_names() {
  std::vector<std::string> names;
  for (const auto& entry : rtl_registry()) names.emplace_back(entry.config);
  return names;
}

std::unique_ptr<RtlDevice> make_rtl_device(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                           const RtlOptions& options) {
  std::string known;
  for (const auto& entry : rtl_registry()) {
    if (config.name == entry.config) return entry.make(config, pixels, options);
    known += (known.empty() ? "" : ", ") + std::string(entry.config);
  }
  throw_usage({.where = "configuration " + config.name,
               .what = "has no RTL in this build",
               .expected = "one of " + known,
               .got = config.name,
               .fix = "use --engine cmodel, or add it to FASTSPLAT_RTL_CONFIGS and build again"});
}

}  // namespace fastsplat::testbench
