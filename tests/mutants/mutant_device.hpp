// A Verilated class with the mutant selected, for the generated source of each configuration.
#pragma once

#include <memory>

#include "testbench/device/verilated_device.hpp"
#include "tests/mutants/check_mutants.hpp"

namespace fastsplat::test {

template <class Top>
class MutantTop : public Top {
 public:
  explicit MutantTop(VerilatedContext* context) : Top(context) {}
  /// The selection holds from the first evaluation on.
  void eval() {
    this->rootp->__PVT__fastsplat_mutant_pkg->selected = static_cast<std::uint32_t>(selected_mutant);
    Top::eval();
  }
};

}  // namespace fastsplat::test
