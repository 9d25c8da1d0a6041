// The Verilated devices that count their lines; generated, as rtl_registry.hpp is.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>

#include "testbench/device/rtl_device.hpp"

namespace fastsplat::testbench {

/// Receives a device's counts, as Verilator writes them, when it goes.
using CoverageDat = std::function<void(const std::string& dat)>;

struct CoveredEntry {
  const char* config;  ///< name
  std::unique_ptr<RtlDevice> (*make)(const cmodel::Config&, cmodel::PixelSink&, const RtlOptions&, const CoverageDat&);
};
std::span<const CoveredEntry> covered_registry();

}  // namespace fastsplat::testbench
