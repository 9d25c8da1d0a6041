// SPDX-License-Identifier: Apache-2.0
// SimulatedTop over a class that Verilator made.
#pragma once

#include <verilated.h>
#if VM_TRACE_FST
#include <verilated_fst_c.h>

#include "testbench/module/wave_ports.hpp"
#endif
#if VM_COVERAGE
#include <verilated_cov.h>
#endif

#include <limits>

#include "testbench/module/simulated_top.hpp"
#include "testbench/module/simulator_output.hpp"

namespace fastsplat::testbench {

/// `select` plants the fault of its number in a top, before each evaluation; null where a device has none.
template <class Top>
using SelectFault = void (*)(Top&, std::uint32_t fault);

template <class Top>
class VerilatedTop final : public SimulatedTop {
 public:
  explicit VerilatedTop(const SimulatorOptions& options, SelectFault<Top> select = nullptr)
      : select_(select), fault_(options.fault) {
    context_.threads(1);  // the default starts idle workers
    context_.randReset(options.fill);
    context_.randSeed(options.seed);
    context_.traceEverOn(options.trace);
    context_.assertOn(options.assertions);
    // A failing assertion is counted; the default is to end the process.
    context_.fatalOnError(false);
    context_.errorLimit(std::numeric_limits<int>::max());
    take_simulator_output();
    top_ = std::make_unique<Top>(&context_);
  }
  ~VerilatedTop() override {
#if VM_TRACE_FST
    if (wave_) {
      wave_->close();
      write_wave_ports(wave_name_, wave_name_ + ".ports");
    }
#endif
    // The simulator's objects unregister from the thread's context, which is that of the device that ran last.
    Verilated::threadContextp(&context_);
    top_->final();
    top_.reset();
  }

  Ports ports() override {
    return {
#define X(name) top_->name,
        FASTSPLAT_NARROW_PORTS(X)
#undef X
#define X(name) WidePort(top_->name),
            FASTSPLAT_WIDE_PORTS(X)
#undef X
#define X(name) name(*top_),
                FASTSPLAT_SLICE_PORTS(X)
#undef X
    };
  }
  /// A failing assertion is printed through the thread's context: without this, that of a later device, which may be
  /// gone.
  void eval() override {
    Verilated::threadContextp(&context_);
    if (select_ != nullptr) select_(*top_, fault_);
    top_->eval();
  }
  bool failed() const override { return context_.errorCount() != 0; }
  std::string take_output() override { return take_simulator_output(); }
  bool trace([[maybe_unused]] const char* path) override {
#if VM_TRACE_FST
    wave_ = std::make_unique<VerilatedFstC>();
    top_->trace(wave_.get(), 99);
    wave_->open(path);
    wave_name_ = path;
    return wave_->isOpen();
#else
    return false;
#endif
  }
  void dump([[maybe_unused]] std::uint64_t time) override {
#if VM_TRACE_FST
    wave_->dump(time);
#endif
  }
  void write_coverage([[maybe_unused]] const char* path) override {
#if VM_COVERAGE
    context_.coveragep()->write(path);
#endif
  }

 private:
#define X(name)                                             \
  static const std::uint8_t* name(const auto& top) {        \
    if constexpr (requires { top.name; }) return &top.name; \
    return nullptr;                                         \
  }
  FASTSPLAT_SLICE_PORTS(X)
#undef X

  VerilatedContext context_;
  std::unique_ptr<Top> top_;
#if VM_TRACE_FST
  std::unique_ptr<VerilatedFstC> wave_;
  std::string wave_name_;
#endif
  SelectFault<Top> select_;
  std::uint32_t fault_;
};

}  // namespace fastsplat::testbench
