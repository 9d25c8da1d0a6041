// The Verilated device with its line counts handed over at its end. Included by generated sources only.
#pragma once

#include <verilated_cov.h>

#include <filesystem>

#include "base/read_file.hpp"
#include "testbench/device/covered_registry.hpp"
#include "testbench/device/verilated_device.hpp"

namespace fastsplat::testbench {

template <class Top>
class CoveredDevice final : public VerilatedDevice<Top> {
 public:
  CoveredDevice(const cmodel::Config& config, cmodel::PixelSink& pixels, const RtlOptions& options, CoverageDat dat)
      : VerilatedDevice<Top>(config, pixels, options), dat_(std::move(dat)) {}

  ~CoveredDevice() override {
    // Verilator only writes files.
    const auto path =
        std::filesystem::temp_directory_path() / ("fastsplat-coverage-" + std::to_string(::getpid()) + "-" +
                                                  std::to_string(reinterpret_cast<std::uintptr_t>(this)) + ".dat");
    try {
      this->context().coveragep()->write(path.c_str());
      dat_(read_text_file(path, std::size_t{1} << 26));
    } catch (const UserError&) {
      dat_({});  // no counts: what was to be covered stays uncovered
    }
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }

 private:
  CoverageDat dat_;
};

}  // namespace fastsplat::testbench
