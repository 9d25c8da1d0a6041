// SPDX-License-Identifier: Apache-2.0
// CMakeLists.txt selects the netlist of a program: FASTSPLAT_NETLIST, and _CUT if there is one.
#include "tests/netlist/netlist_helper.hpp"

#include "testbench/device/verilated_device.hpp"
#include "testbench/module/verilated_top.hpp"

#define HEADER_OF(name) <Vfs_##name.h>
#define HEADER(name) HEADER_OF(name)
#define CLASS_OF(name) Vfs_##name
#define CLASS(name) CLASS_OF(name)
#include HEADER(FASTSPLAT_NETLIST)
#ifdef FASTSPLAT_NETLIST_CUT
#include HEADER(FASTSPLAT_NETLIST_CUT)
#endif

namespace fastsplat::test {
namespace {

template <class Top>
std::unique_ptr<testbench::RtlDevice> make(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                           const testbench::RtlOptions& options) {
  auto top = std::make_unique<testbench::VerilatedTop<Top>>(testbench::simulator_options(options));
  return testbench::make_verilated_device(std::move(top), config, pixels, options);
}

}  // namespace

std::unique_ptr<testbench::RtlDevice> make_netlist(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                   const testbench::RtlOptions& options) {
  return make<CLASS(FASTSPLAT_NETLIST)>(config, pixels, options);
}

std::unique_ptr<testbench::RtlDevice> make_cut_netlist([[maybe_unused]] const cmodel::Config& config,
                                                       [[maybe_unused]] cmodel::PixelSink& pixels,
                                                       [[maybe_unused]] const testbench::RtlOptions& options) {
#ifdef FASTSPLAT_NETLIST_CUT
  return make<CLASS(FASTSPLAT_NETLIST_CUT)>(config, pixels, options);
#else
  return nullptr;
#endif
}

}  // namespace fastsplat::test
