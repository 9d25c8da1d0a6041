#include "testbench/faults/breakable_device.hpp"

#include "Vfs_rtl_faulty.h"
#include "Vfs_rtl_faulty___024root.h"
#include "Vfs_rtl_faulty_fastsplat_fault_pkg.h"
#include "testbench/device/verilated_device.hpp"

namespace fastsplat::testbench {
namespace {

// Of the device made next; VerilatedDevice makes its own top.
thread_local RtlFault next_fault = RtlFault::None;
thread_local Assertions next_assertions = Assertions::Off;

class FaultyTop : public Vfs_rtl_faulty {
 public:
  explicit FaultyTop(VerilatedContext* context) : Vfs_rtl_faulty(context), fault_(next_fault) {
    context->assertOn(next_assertions == Assertions::On);
  }
  /// The selection holds from the first evaluation on.
  void eval() {
    rootp->__PVT__fastsplat_fault_pkg->selected = static_cast<std::uint32_t>(fault_);
    Vfs_rtl_faulty::eval();
  }

 private:
  RtlFault fault_;
};

}  // namespace

std::unique_ptr<RtlDevice> make_breakable_device(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                 const RtlOptions& options, RtlFault fault, Assertions assertions) {
  next_fault = fault;
  next_assertions = assertions;
  return std::make_unique<VerilatedDevice<FaultyTop>>(config, pixels, options);
}

}  // namespace fastsplat::testbench
