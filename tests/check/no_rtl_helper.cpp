// A build without simulators: what is tested here has to work in it.
#include "testbench/device/rtl_registry.hpp"

namespace fastsplat::testbench {
std::span<const RtlEntry> rtl_registry() { return {}; }
}  // namespace fastsplat::testbench
