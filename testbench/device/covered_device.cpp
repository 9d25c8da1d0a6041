// SPDX-License-Identifier: Apache-2.0
#include "testbench/device/covered_device.hpp"

#include <unistd.h>

#include <filesystem>

#include "base/error.hpp"
#include "base/read_file.hpp"
#include "testbench/device/passing_device.hpp"
#include "testbench/device/verilated_device.hpp"

namespace fastsplat::testbench {
namespace {

class CoveredDevice final : public PassingDevice {
 public:
  CoveredDevice(SimulatedTop& top, std::unique_ptr<RtlDevice> device, CoverageDat dat)
      : PassingDevice(std::move(device)), top_(top), dat_(std::move(dat)) {}

  ~CoveredDevice() override {
    // Verilator only writes files.
    const auto path =
        std::filesystem::temp_directory_path() / ("fastsplat-coverage-" + std::to_string(::getpid()) + "-" +
                                                  std::to_string(reinterpret_cast<std::uintptr_t>(this)) + ".dat");
    try {
      top_.write_coverage(path.c_str());
      dat_(read_text_file(path, std::size_t{1} << 26));
    } catch (const UserError&) {
      dat_({});  // no counts: its lines stay uncovered
    }
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }

 private:
  SimulatedTop& top_;  ///< the device's
  CoverageDat dat_;
};

}  // namespace

std::unique_ptr<RtlDevice> make_covered_device(std::unique_ptr<SimulatedTop> top, const cmodel::Config& config,
                                               cmodel::PixelSink& pixels, const RtlOptions& options,
                                               const CoverageDat& dat) {
  SimulatedTop& simulated = *top;
  auto device = make_verilated_device(std::move(top), config, pixels, options);
  return std::make_unique<CoveredDevice>(simulated, std::move(device), dat);
}

}  // namespace fastsplat::testbench
