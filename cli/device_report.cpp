// SPDX-License-Identifier: Apache-2.0
#include "cli/device_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "cli/config_json.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"

namespace fastsplat::cli {
namespace {

// The fix for a counter of lost bits; the counter's own text names it.
std::string fix_for(std::string_view counter) {
  if (counter == "snap_saturated")
    return "the picture exceeds the range of the configuration's positions: reduce --size or --zoom";
  if (counter == "product_saturated" || counter == "sheet_saturated") {
    return "lower --opacity-scale or --xray-exposure, or choose a configuration with more sheet integer bits";
  }
  if (counter == "opacity_saturated")
    return "use --slab-opacity exponential, a smaller --slab-width or a lower --opacity-scale";
  return "lower --opacity-scale or --xray-exposure";
}

bool is_loss(std::string_view name) { return name.ends_with("_saturated"); }

/// If the format ends below 1.0, every opaque pixel saturates to the largest word, which stands for "opaque".
bool only_opaque(const DeviceReport& report) {
  return !report.sums && report.config.pixel_int_bits == 0 && report.counters.composite_saturated == 0 &&
         report.counters.opacity_saturated == 0;
}

}  // namespace

std::string to_text(const driver::UnitReport& units, const cmodel::Counters& counters) {
  if (units.fast == 0) {
    if (units.plain == 0) return "";
    const std::string why = units.redone > 0 ? ": in each, a sum may have saturated, which the fast unit cannot count"
                            : units.why_plain != nullptr ? fmt::format("; fast unit not used: {}", units.why_plain)
                                                         : "";
    return fmt::format("unit: plain, {}{}\n", counted(units.plain, "tile"), why);
  }
  return fmt::format("unit: fast ({}), {}{}; {:.1f} % of the splats lay on terminated blocks and were only counted\n",
                     units.vectors, counted(units.fast, "tile"),
                     units.plain > 0 ? fmt::format(", {} repeated by the plain unit", grouped(units.plain)) : "",
                     100.0 * static_cast<double>(units.hidden_splats) /
                         static_cast<double>(std::max<std::uint64_t>(counters.splats, 1)));
}

nlohmann::ordered_json to_json(const driver::UnitReport& units) {
  nlohmann::ordered_json json{{"fast_tiles", units.fast},
                              {"plain_tiles", units.plain},
                              {"redone_tiles", units.redone},
                              {"hidden_splats", units.hidden_splats}};
  if (units.vectors != nullptr) json["vectors"] = units.vectors;
  if (units.why_plain != nullptr) json["why_plain"] = units.why_plain;
  return json;
}

std::string to_text(const driver::DriverReport& report) {
  // A replayed stream does not contain its number of voxels.
  const std::string voxels = report.voxels > 0 ? counted(report.voxels, "voxel") + ", " : "";
  return fmt::format("driver: {}{}, {}, {}\n", voxels, counted(report.splat_records, "splat record"),
                     counted(report.sheets, "sheet"), counted(report.tiles, "tile"));
}

nlohmann::ordered_json to_json(const driver::DriverReport& report) {
  return {{"voxels", report.voxels},
          {"sheets", report.sheets},
          {"tiles", report.tiles},
          {"driver",
           {{"splat_records", report.splat_records},
            {"saturated_voxels", report.saturated_voxels},
            {"saturated_records", report.saturated_records},
            {"vanished_voxels", report.vanished_voxels},
            {"vanished_share", report.vanished_share},
            {"widened_voxels", report.widened_voxels},
            {"carried", report.carried}}}};
}

std::vector<Remark> remarks(const driver::DriverReport& report) {
  std::vector<Remark> remarks;
  if (report.saturated_voxels + report.saturated_records > 0) {
    remarks.push_back(
        {Remark::Warning, fmt::format("{} voxels and {} splat records exceeded the input format and were clamped; "
                                      "lower --opacity-scale or --xray-exposure, or use a smaller --slab-width",
                                      grouped(report.saturated_voxels), grouped(report.saturated_records))});
  }
  if (report.vanished_voxels > 0 && !report.carried) {
    // With a brightest pixel of 1.0, a loss is visible from half a step of an 8-bit display.
    const bool shows = report.vanished_share >= 0.5 / 255.0;
    remarks.push_back(
        {shows ? Remark::Warning : Remark::Note,
         fmt::format("{} of {} voxels are too transparent for the input format and vanished, with {:.2g} % of all "
                     "colour and opacity{}",
                     grouped(report.vanished_voxels), grouped(report.voxels), 100.0 * report.vanished_share,
                     shows ? "; use a configuration with more colour.frac_bits, or --set rounding.carry=on" : "")});
  }
  if (report.widened_voxels > 0) {
    remarks.push_back(
        {Remark::Note, fmt::format("{} of {} voxels have footprints thinner than half a pixel and were widened to that "
                                   "and dimmed accordingly; use --antialias on or a larger --size",
                                   grouped(report.widened_voxels), grouped(report.voxels))});
  }
  return remarks;
}

std::string visible_text(const std::string& splats, const std::string& records, const cmodel::Config& config,
                         const driver::UnitReport& units) {
  return fmt::format("driver: {} and {} can change a pixel; others are left out (--counters counts them)\n", splats,
                     records) +
         fmt::format("device: configuration {} {}\nunit: fast ({}), without counters\n", config.name,
                     hash_text(cmodel::config_hash(config)), units.vectors);
}

nlohmann::ordered_json uncounted_json(std::uint64_t visible_splats, std::uint64_t visible_records) {
  return {{"visible", {{"splats", visible_splats}, {"splat_records", visible_records}}}, {"counters", nullptr}};
}

std::string to_text(const DeviceReport& report) {
  const std::string name = report.config.name + " " + hash_text(cmodel::config_hash(report.config));
  if (!report.counted) {
    return visible_text(counted(report.driver.voxels, "voxel"), counted(report.driver.splat_records, "splat record"),
                        report.config, report.units);
  }
  return to_text(report.driver) +
         fmt::format("device: configuration {}, {}, {} composited\n", name,
                     counted(report.counters.windows, "window"),
                     counted(report.counters.pixels_composited, "pixel")) +
         to_text(report.units, report.counters);
}

nlohmann::ordered_json to_json(const DeviceReport& report) {
  nlohmann::ordered_json json{{"config", priced_config_json(report.config)}};
  if (!report.counted) {
    json.update(uncounted_json(report.driver.voxels, report.driver.splat_records));
    return json;
  }
  json.update(to_json(report.driver));
  if (report.units.fast + report.units.plain > 0) json["units"] = to_json(report.units);
  auto& counts = json["counters"];
  report.counters.for_each(
      [&](std::string_view name, std::uint64_t value, std::string_view) { counts[std::string(name)] = value; });
  return json;
}

std::vector<Remark> remarks(const DeviceReport& report) {
  auto remarks = cli::remarks(report.driver);
  report.counters.for_each([&](std::string_view name, std::uint64_t value, std::string_view meaning) {
    if (!is_loss(name) || value == 0) return;
    if (name == "pixel_saturated" && only_opaque(report)) {
      const std::int64_t largest = report.config.pixel_format().max;
      remarks.push_back(
          {Remark::Note, fmt::format("{} output words of 1.0 are {}/{} in this configuration's pixel format",
                                     grouped(value), largest, largest + 1)});
      return;
    }
    remarks.push_back({Remark::Warning, fmt::format("{} {}; {}", grouped(value), meaning, fix_for(name))});
  });
  return remarks;
}

void write_device_images(const cmodel::Frame& frame, const std::vector<std::string>& out, const std::string& raw,
                         const Shown& shown, const images::Metadata& metadata, const Output& output) {
  write_images(out, driver::to_image(frame), shown, metadata, output);
  if (raw.empty()) return;
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

}  // namespace fastsplat::cli
