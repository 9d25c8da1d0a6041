// SPDX-License-Identifier: Apache-2.0
#include "testbench/faults/planted_fault.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/suggest.hpp"
#include "testbench/faults/breakable_device.hpp"
#include "testbench/faults/port_faults.hpp"

namespace fastsplat::testbench {
namespace {

using Where = PlantedFault::Where;

constexpr std::array kFaults{
#define FAULT(name, detector, stimulus, assertion, meaning) PlantedFault{#name, Where::Rtl, meaning},
#include "testbench/faults/faults.def"
#undef FAULT
#define PORT_FAULT(name, meaning) PlantedFault{#name, Where::Ports, meaning},
    FASTSPLAT_PORT_FAULTS(PORT_FAULT)
#undef PORT_FAULT
};
constexpr std::size_t kInRtl = static_cast<std::size_t>(
    std::ranges::count_if(kFaults, [](const auto& fault) { return fault.where == Where::Rtl; }));

}  // namespace

const char* breakable_config(const PlantedFault& fault) {
  const std::string_view name = fault.name;
  return name.starts_with("SAMPLE_") ? kBreakableSamples
         : name.starts_with("CULL_") ? kBreakableCull
         : name.starts_with("POST_") ? kBreakablePost
                                     : kBreakableConfig;
}

std::span<const PlantedFault> planted_faults() { return kFaults; }

std::vector<std::string> planted_fault_names() {
  std::vector<std::string> names;
  for (const auto& fault : kFaults) names.emplace_back(fault.name);
  return names;
}

const PlantedFault& planted_fault_from(const std::string& name) {
  const auto found = std::ranges::find(kFaults, name, &PlantedFault::name);
  if (found != kFaults.end()) return *found;
  throw_usage({.where = "--fault",
               .what = "unknown fault '" + name + "'",
               .expected = {},
               .got = {},
               .fix = suggestion(name, planted_fault_names()) + "; `--fault list` describes each fault"});
}

MakeDevice with_fault(const PlantedFault& fault, const cmodel::Config& config) {
  const auto number = static_cast<std::size_t>(&fault - kFaults.data());
  if (fault.where == Where::Rtl) {
    return [=](cmodel::PixelSink& pixels, const RtlOptions& options) {
      return make_breakable_device(config, pixels, options, static_cast<RtlFault>(number + 1), Assertions::Off);
    };
  }
  return [=](cmodel::PixelSink& pixels, const RtlOptions& options) {
    return with_port_fault(static_cast<PortFault>(number - kInRtl), make_rtl_device, config, pixels, options);
  };
}

}  // namespace fastsplat::testbench
