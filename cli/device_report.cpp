#include "cli/device_report.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "cli/image_output.hpp"
#include "cmodel/config.hpp"
#include "cmodel/counters.hpp"

namespace fastsplat::cli {
namespace {

// What to do about a counter of lost bits; the counter's own words say what it counts.
std::string fix_for(std::string_view counter) {
  if (counter == "snap_saturated")
    return "the picture is larger than the configuration's positions reach: reduce --size or --zoom";
  if (counter == "product_saturated" || counter == "sheet_saturated") {
    return "lower --opacity-scale or --xray-exposure, or choose a configuration with more sheet integer bits";
  }
  if (counter == "opacity_saturated")
    return "use --slab-opacity exponential, a smaller --slab-width or a lower --opacity-scale";
  return "lower --opacity-scale or --xray-exposure";
}

bool is_loss(std::string_view name) { return name.ends_with("_saturated"); }

}  // namespace

void report_driver(const driver::DriverReport& report, const Output& output, nlohmann::ordered_json& json) {
  // A replayed stream no longer knows its voxels.
  const std::string voxels = report.voxels > 0 ? counted(report.voxels, "voxel") + ", " : "";
  output.line(fmt::format("driver: {}{}, {}, {}", voxels, counted(report.splat_records, "splat record"),
                          counted(report.sheets, "sheet"), counted(report.tiles, "tile")));
  if (report.saturated_voxels + report.saturated_records > 0) {
    output.warn(fmt::format(
        "{} voxels and {} splat records had more colour or opacity than the input format holds and were cut; "
        "lower --opacity-scale or --xray-exposure, or use a smaller --slab-width",
        grouped(report.saturated_voxels), grouped(report.saturated_records)));
  }
  if (report.vanished_voxels > 0) {
    output.note(fmt::format("{} of {} voxels are too transparent for the input format and vanished",
                            grouped(report.vanished_voxels), grouped(report.voxels)));
  }
  json["voxels"] = report.voxels;
  json["sheets"] = report.sheets;
  json["tiles"] = report.tiles;
  json["driver"] = {{"splat_records", report.splat_records},
                    {"saturated_voxels", report.saturated_voxels},
                    {"saturated_records", report.saturated_records},
                    {"vanished_voxels", report.vanished_voxels}};
}

void report_device(const driver::DeviceRender& result, const cmodel::Config& config, const Output& output,
                   nlohmann::ordered_json& json) {
  const std::string hash = hash_text(cmodel::config_hash(config));
  json["config"] = {{"name", config.name}, {"hash", hash}};
  report_driver(result.report, output, json);
  const auto& counters = result.counters;
  output.line(fmt::format("device: configuration {} {}, {}, {} composited", config.name, hash,
                          counted(counters.windows, "window"), counted(counters.pixels_composited, "pixel")));
  auto& counts = json["counters"];
  counters.for_each([&](std::string_view name, std::uint64_t value, std::string_view meaning) {
    counts[std::string(name)] = value;
    if (is_loss(name) && value > 0) output.warn(fmt::format("{} {}; {}", grouped(value), meaning, fix_for(name)));
  });
}

void write_device_images(const driver::DeviceRender& result, const std::vector<std::string>& out,
                         const std::string& raw, const images::Metadata& metadata, const Output& output) {
  const Image image = driver::to_image(result.frame);
  warn_if_empty(image, output);
  write_images(out, image, metadata, output);
  if (!raw.empty()) {
    const cmodel::Frame& frame = result.frame;
    images::write_raw(raw,
                      {.width = frame.width,
                       .height = frame.height,
                       .int_bits = frame.int_bits,
                       .frac_bits = frame.frac_bits,
                       .words = frame.words,
                       .config_hash = frame.config_hash},
                      metadata);
    output.line(raw);
  }
}

}  // namespace fastsplat::cli
