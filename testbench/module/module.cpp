// SPDX-License-Identifier: Apache-2.0
// The only source of our own in a module of RTL: makes its simulator. Names are those of rtl_module.cpp.
#include "Vfs.h"
#include "testbench/module/verilated_top.hpp"
#ifdef FASTSPLAT_FAULTS
#include "Vfs___024root.h"
#include "Vfs_fastsplat_fault_pkg.h"
#endif

namespace {

#ifdef FASTSPLAT_FAULTS
void select_fault(Vfs& top, std::uint32_t fault) { top.rootp->__PVT__fastsplat_fault_pkg->selected = fault; }
#else
constexpr fastsplat::testbench::SelectFault<Vfs> select_fault = nullptr;
#endif

}  // namespace

extern "C" [[gnu::visibility("default")]] fastsplat::testbench::SimulatedTop* fastsplat_rtl_top(
    const fastsplat::testbench::SimulatorOptions& options) {
  return new fastsplat::testbench::VerilatedTop<Vfs>(options, select_fault);
}
