// What `render --engine cmodel` and `stream replay` share: the device's counters told, its frame written, its origin
// kept.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/images/image_file.hpp"
#include "cli/output.hpp"
#include "driver/tiles/render.hpp"

namespace fastsplat::cli {

/// What a device made of a scene or a stream, without its picture.
struct DeviceReport {
  cmodel::Config config;
  driver::DriverReport driver;
  cmodel::Counters counters;
  driver::UnitReport units{};  ///< of the integer model
  bool sums = false;           ///< an X-ray: its words may truly be too large
};

/// Which unit drew; `counters` of the same frame.
std::string to_text(const driver::UnitReport& units, const cmodel::Counters& counters);
std::string to_text(const driver::DriverReport& report);
std::string to_text(const DeviceReport& report);
/// Keys for the JSON of a verb.
nlohmann::ordered_json to_json(const driver::UnitReport& units);
nlohmann::ordered_json to_json(const driver::DriverReport& report);
nlohmann::ordered_json to_json(const DeviceReport& report);
/// Every loss that is not zero, with the fix.
std::vector<Remark> remarks(const driver::DriverReport& report);
std::vector<Remark> remarks(const DeviceReport& report);

/// `description`: of the scene that says how the picture is shown; absent for a replay.
void write_device_images(const driver::DeviceRender& result, const std::vector<std::string>& out,
                         const std::string& raw, const images::Metadata& metadata, const Output& output,
                         const scene::SceneDescription* description = nullptr);

}  // namespace fastsplat::cli
