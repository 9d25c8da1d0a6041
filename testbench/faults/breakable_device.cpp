#include "testbench/faults/breakable_device.hpp"

#include "Vfs_rtl_faulty.h"
#include "Vfs_rtl_faulty___024root.h"
#include "Vfs_rtl_faulty_cull.h"
#include "Vfs_rtl_faulty_cull___024root.h"
#include "Vfs_rtl_faulty_cull_fastsplat_fault_pkg.h"
#include "Vfs_rtl_faulty_fastsplat_fault_pkg.h"
#include "Vfs_rtl_faulty_post.h"
#include "Vfs_rtl_faulty_post___024root.h"
#include "Vfs_rtl_faulty_post_fastsplat_fault_pkg.h"
#include "Vfs_rtl_faulty_samples.h"
#include "Vfs_rtl_faulty_samples___024root.h"
#include "Vfs_rtl_faulty_samples_fastsplat_fault_pkg.h"
#include "testbench/device/verilated_device.hpp"

namespace fastsplat::testbench {
namespace {

// Of the device made next; VerilatedDevice makes its own top.
thread_local RtlFault next_fault = RtlFault::None;
thread_local Assertions next_assertions = Assertions::Off;

template <class Top>
class FaultyTop : public Top {
 public:
  explicit FaultyTop(VerilatedContext* context) : Top(context), fault_(next_fault) {
    context->assertOn(next_assertions == Assertions::On);
  }
  /// The selection holds from the first evaluation on.
  void eval() {
    this->rootp->__PVT__fastsplat_fault_pkg->selected = static_cast<std::uint32_t>(fault_);
    Top::eval();
  }

 private:
  RtlFault fault_;
};

}  // namespace

std::unique_ptr<RtlDevice> make_breakable_device(const cmodel::Config& config, cmodel::PixelSink& pixels,
                                                 const RtlOptions& options, RtlFault fault, Assertions assertions) {
  next_fault = fault;
  next_assertions = assertions;
  if (config.composite_every_sample != 0)
    return std::make_unique<VerilatedDevice<FaultyTop<Vfs_rtl_faulty_samples>>>(config, pixels, options);
  if (config.culls()) return std::make_unique<VerilatedDevice<FaultyTop<Vfs_rtl_faulty_cull>>>(config, pixels, options);
  if (config.interpolates())
    return std::make_unique<VerilatedDevice<FaultyTop<Vfs_rtl_faulty_post>>>(config, pixels, options);
  return std::make_unique<VerilatedDevice<FaultyTop<Vfs_rtl_faulty>>>(config, pixels, options);
}

}  // namespace fastsplat::testbench
