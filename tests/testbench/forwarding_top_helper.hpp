// SPDX-License-Identifier: Apache-2.0
// A simulated top that passes everything on: tests override what is to be wrong.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "testbench/module/simulated_top.hpp"

namespace fastsplat::test {

class ForwardingTop : public testbench::SimulatedTop {
 public:
  explicit ForwardingTop(std::unique_ptr<testbench::SimulatedTop> top) : top_(std::move(top)), ports_(top_->ports()) {}
  void eval() override {
    const bool rises = ports_.clk_i != 0 && !was_high_;
    was_high_ = ports_.clk_i != 0;
    eval(rises);
  }
  testbench::Ports ports() override { return ports_; }
  bool failed() const override { return top_->failed(); }
  std::string take_output() override { return top_->take_output(); }
  bool trace(const char* path) override { return top_->trace(path); }
  void dump(std::uint64_t time) override { top_->dump(time); }
  void write_coverage(const char* path) override { top_->write_coverage(path); }

 protected:
  /// `rises`: the clock has just gone high.
  virtual void eval(bool rises) = 0;

  std::unique_ptr<testbench::SimulatedTop> top_;
  testbench::Ports ports_;

 private:
  bool was_high_ = false;
};

}  // namespace fastsplat::test
