#include "Vfs_rtl_faulty.h"
#include "Vfs_rtl_faulty___024root.h"
#include "Vfs_rtl_faulty_fastsplat_fault_pkg.h"
#include "testbench/device/verilated_device.hpp"
#include "tests/mustfail/campaign_helper.hpp"

namespace fastsplat::test {
namespace {

// Of the device made next; VerilatedDevice makes its own top.
Fault next_fault = Fault::None;
Assertions next_assertions = Assertions::Off;

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
  Fault fault_;
};

}  // namespace

MakeDevice faulty(Fault fault, Assertions assertions) {
  return [=](const cmodel::Config& config, cmodel::PixelSink& pixels, const testbench::RtlOptions& options) {
    next_fault = fault;
    next_assertions = assertions;
    return std::make_unique<testbench::VerilatedDevice<FaultyTop>>(config, pixels, options);
  };
}

}  // namespace fastsplat::test
