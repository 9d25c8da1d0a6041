// SPDX-License-Identifier: Apache-2.0
// Shared by `render --engine cmodel` and `stream replay`: reports the device's counters and writes its images.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/images/image_file.hpp"
#include "cli/image_output.hpp"
#include "cli/output.hpp"
#include "driver/tiles/render.hpp"

namespace fastsplat::cli {

/// Figures of a device's run on a scene or a stream, without its picture.
struct DeviceReport {
  cmodel::Config config;
  driver::DriverReport driver;
  cmodel::Counters counters;
  driver::UnitReport units{};  ///< of the integer model
  bool sums = false;           ///< an X-ray: sums can exceed 1.0, so saturation is a real loss
  bool counted = true;         ///< driver::DeviceRender::counted
};

/// Which unit rendered the tiles; `counters` are of the same frame.
std::string to_text(const driver::UnitReport& units, const cmodel::Counters& counters);
std::string to_text(const driver::DriverReport& report);
/// Of a picture without counters; `splats` and `records` are counts with their words.
std::string visible_text(const std::string& splats, const std::string& records, const cmodel::Config& config,
                         const driver::UnitReport& units);
std::string to_text(const DeviceReport& report);
/// Keys of a subcommand's JSON, here of a picture without counters.
nlohmann::ordered_json uncounted_json(std::uint64_t visible_splats, std::uint64_t visible_records);
nlohmann::ordered_json to_json(const driver::UnitReport& units);
nlohmann::ordered_json to_json(const driver::DriverReport& report);
nlohmann::ordered_json to_json(const DeviceReport& report);
/// All nonzero losses, each with its fix.
std::vector<Remark> remarks(const driver::DriverReport& report);
std::vector<Remark> remarks(const DeviceReport& report);

/// The picture by write_images() and, if `raw` is a file's name, its words.
void write_device_images(const cmodel::Frame& frame, const std::vector<std::string>& out, const std::string& raw,
                         const Shown& shown, const images::Metadata& metadata, const Output& output);

}  // namespace fastsplat::cli
