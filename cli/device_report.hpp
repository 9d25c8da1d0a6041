// What `render --engine cmodel` and `stream replay` share: the device's counters told, its frame written, its origin
// kept.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cli/output.hpp"
#include "driver/render.hpp"
#include "images/image_file.hpp"

namespace fastsplat::cli {

/// Counts to stdout and into `json`; every loss that is not zero as a warning with the fix.
void report_device(const driver::DeviceRender& result, const cmodel::Config& config, const Output& output,
                   nlohmann::ordered_json& json);
void report_driver(const driver::DriverReport& report, const Output& output, nlohmann::ordered_json& json);

void write_device_images(const driver::DeviceRender& result, const std::vector<std::string>& out,
                         const std::string& raw, const images::Metadata& metadata, const Output& output);

}  // namespace fastsplat::cli
