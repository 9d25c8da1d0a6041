// SPDX-License-Identifier: Apache-2.0
#include "testbench/device/rtl_device.hpp"

#include "base/error.hpp"
#include "testbench/device/rtl_module.hpp"
#include "testbench/device/verilated_device.hpp"

namespace fastsplat::testbench {

void require_rtl(const cmodel::Config& config, const std::vector<RtlAbilities>& abilities,
                 const std::string& otherwise) {
  try {
    for (const RtlAbilities& with : abilities) rtl_module(config, with);
  } catch (const UserError& error) {
    if (otherwise.empty() || error.code() != ExitCode::Usage) throw;
    ErrorParts parts = error.parts();
    parts.fix = otherwise;
    throw_usage(parts);
  }
}

std::unique_ptr<RtlDevice> make_rtl_device(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                           const RtlOptions& options) {
  auto top = open_rtl(config, {.wave = !options.wave.empty()}, simulator_options(options));
  return make_verilated_device(std::move(top), config, pixels, options);
}

}  // namespace fastsplat::testbench
