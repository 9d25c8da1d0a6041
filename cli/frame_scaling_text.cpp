// SPDX-License-Identifier: Apache-2.0
// A frame's scaling as text and JSON: figures, the limit, and what would help.
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/frame_rate.hpp"
#include "cli/frame_scaling.hpp"
#include "cli/output.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

struct Named {
  std::string name;
  std::uint64_t cycles = 0;
};

/// The largest entry of `table`, the first of equals; ignores `but`.
template <class Table>
Named largest(const Table& table, std::string_view but = {}) {
  Named out;
  table.for_each([&](std::string_view name, std::uint64_t cycles, std::string_view) {
    if (name != but && (out.name.empty() || cycles > out.cycles)) out = {std::string(name), cycles};
  });
  return out;
}

/// What limits the frame: docs/scaling.md, "Where the frame goes".
Named limit(const FrameScaling& scaling) {
  if (10 * scaling.shares.work >= 9 * scaling.device_cycles()) return {"work", scaling.shares.work};
  // Then only a faster link helps, whichever devices wait.
  if (10 * scaling.roofline.stream >= 9 * scaling.frame) return {"bandwidth", scaling.shares.bandwidth};
  return largest(scaling.shares, "work");
}

std::string help_against_work(const FrameScaling& scaling) {
  if (scaling.roofline.compositor > scaling.roofline.lanes)
    return "the devices are busy: thicker slabs (--slab-width) composite fewer blocks, and more devices share them";
  if (scaling.windows <= scaling.splats)
    return "the devices are busy, and each splat is a single window: use fewer splats or more devices";
  return fmt::format("the devices are busy with {:.2f} windows a splat: use more lanes (array.lanes) or more devices",
                     ratio(scaling.windows, scaling.splats));
}

std::string help_against_fill(const FrameScaling& scaling) {
  struct Part {
    std::uint64_t cycles;
    const char* text;
  };
  const auto& a = scaling.account;
  const Part parts[] = {
      {scaling.wipe, "most of it is the wipe after reset, which only the first frame needs"},
      {a.table_load, "most of it is table loading in every device: use larger tiles or fewer devices"},
      {a.records, "most of it is records of sheets and tiles: use thicker slabs (--slab-width) or larger tiles"},
      {a.sheet_buffer, "most of it is sheets waiting for a buffer: use thicker slabs (--slab-width) for longer sheets"},
      {a.drain, "most of it is pipelines draining at the end of each tile: use larger tiles"},
      {a.hazard, "most of it is windows that overlap the previous one and wait for it (composite.every_sample)"}};
  return std::max_element(std::begin(parts), std::end(parts),
                          [](const Part& x, const Part& y) { return x.cycles < y.cycles; })
      ->text;
}

std::string help_against_tail(const FrameScaling& scaling) {
  std::uint64_t tiles = 0;
  for (const auto& device : scaling.each) tiles += device.tiles.size();
  const std::string what = tiles < scaling.devices
                               ? fmt::format("{} for {} devices", counted(tiles, "tile"), scaling.devices)
                               : fmt::format("the longest tile takes {:.1f} % of the frame",
                                             100.0 * ratio(scaling.longest_tile(), scaling.frame));
  return what + ": use smaller tiles (tile.width, tile.height) or a larger picture to balance the work";
}

std::string help_against_bandwidth(const FrameScaling& scaling) {
  if (scaling.bytes_per_cycle == 0) return "the source of --input is late: the devices accept every beat at once";
  // If the device that ended last had not waited, the same bytes would have passed in `waited` fewer cycles.
  const auto last = std::max_element(scaling.each.begin(), scaling.each.end(),
                                     [](const auto& x, const auto& y) { return x.end < y.end; });
  const std::uint64_t waited = last->account.input + last->idle - scaling.wipe / scaling.devices;
  return fmt::format(
      "the link is too slow for {}: about {:.0f} bytes a cycle would keep them busy; {} are equivalent to no limit",
      counted(scaling.devices, "device"), ratio(scaling.bytes_in, scaling.frame - waited),
      cmodel::kBeatBytes * scaling.devices);
}

std::string help_against_pixel_out(const FrameScaling& scaling) {
  if (scaling.account.output > scaling.account.pixels)
    return "the sink is slow: use one that is always ready (--ready always)";
  return "a tile's picture leaves while nothing is splatted: use more lanes (array.lanes) for wider beats; a second "
         "set of tile registers would hide it";
}

/// Advice against the limit.
std::string help(const FrameScaling& scaling) {
  const std::string name = limit(scaling).name;
  if (name == "work") return help_against_work(scaling);
  if (name == "tail") return help_against_tail(scaling);
  if (name == "bandwidth") return help_against_bandwidth(scaling);
  if (name == "pixel_out") return help_against_pixel_out(scaling);
  return help_against_fill(scaling);
}

double milliseconds(const FrameScaling& scaling) { return frame_milliseconds(scaling.frame, *scaling.clock); }
double fps(const FrameScaling& scaling) { return frames_per_second(scaling.frame, *scaling.clock); }
double bytes_per_second(const FrameScaling& scaling, std::uint64_t bytes) {
  return static_cast<double>(bytes) * fps(scaling);
}

std::string bytes_text(const FrameScaling& scaling, const char* name, std::uint64_t bytes) {
  std::string text =
      fmt::format("  {:<14}{:>18} bytes a frame, {:.2f} a cycle", name, grouped(bytes), ratio(bytes, scaling.frame));
  if (scaling.clock) text += fmt::format(", {:.1f} MB/s", bytes_per_second(scaling, bytes) / 1e6);
  return text + "\n";
}

}  // namespace

std::string to_text(const FrameScaling& scaling) {
  const std::string link = scaling.fetches ? "each with a source that fetches"
                           : scaling.bytes_per_cycle == 0
                               ? "on one link without limit"
                               : fmt::format("on one link of {} bytes a cycle", scaling.bytes_per_cycle);
  std::string text = fmt::format("{} {}\n", counted(scaling.devices, "device"), link);
  text += fmt::format("  {:<14}{:>18} cycles from reset to the last pixel", "frame", grouped(scaling.frame));
  if (scaling.clock)
    text += fmt::format(", {:.4f} ms, {:.2f} fps at {:g} MHz", milliseconds(scaling), fps(scaling), *scaling.clock);
  text +=
      "\n" + bytes_text(scaling, "stream in", scaling.bytes_in) + bytes_text(scaling, "pixels out", scaling.bytes_out);
  text += fmt::format("  {:<14}{:>18.3f} over one device like these ({} cycles)\n", "speed-up", scaling.speed_up(),
                      grouped(scaling.one_device));
  text +=
      fmt::format("  {:<14}{:>18.3f} % of all devices' cycles are work\n", "efficiency", 100.0 * scaling.efficiency());
  scaling.shares.for_each([&](std::string_view name, std::uint64_t cycles, std::string_view meaning) {
    text += fmt::format("{} {:<14}{:>18}{:>9.3f} %  {}\n", name == "work" ? ' ' : '+', name, grouped(cycles),
                        100.0 * ratio(cycles, scaling.device_cycles()), meaning);
  });
  text += fmt::format("= {:<14}{:>18}             devices x frame\n", "all", grouped(scaling.device_cycles()));
  const auto [name, cycles] = limit(scaling);
  text += fmt::format("limit: {}, {:.1f} %; {}\n", name, 100.0 * ratio(cycles, scaling.device_cycles()), help(scaling));
  text += "roofline, cycles of the frame at least:\n";
  scaling.roofline.for_each([&](std::string_view bound, std::uint64_t least, std::string_view meaning) {
    text += fmt::format("  {:<14}{:>18}{:>9.3f} %  {}\n", bound, grouped(least), 100.0 * ratio(least, scaling.frame),
                        meaning);
  });
  const Named ruling = largest(scaling.roofline);
  text += fmt::format("ruling bound: {}; the frame takes {:.3f} times it\n", ruling.name,
                      ratio(scaling.frame, ruling.cycles));
  return text;
}

std::string to_table(const std::vector<FrameScaling>& scalings) {
  const bool clocked = scalings.front().clock.has_value();
  std::string text =
      fmt::format("{:>7}{:>18}{}{:>11}{:>13}  {}\n", "devices", "frame",
                  clocked ? fmt::format("{:>12}{:>11}", "ms", "fps") : "", "speed-up", "efficiency", "limit");
  for (const auto& scaling : scalings) {
    const auto [name, cycles] = limit(scaling);
    const std::string rate = clocked ? fmt::format("{:>12.4f}{:>11.2f}", milliseconds(scaling), fps(scaling)) : "";
    text += fmt::format("{:>7}{:>18}{}{:>11.3f}{:>11.1f} %  {}, {:.1f} %\n", scaling.devices, grouped(scaling.frame),
                        rate, scaling.speed_up(), 100.0 * scaling.efficiency(), name,
                        100.0 * ratio(cycles, scaling.device_cycles()));
  }
  return text;
}

Json to_json(const FrameScaling& scaling) {
  Json json{{"devices", scaling.devices},     {"bytes_per_cycle", scaling.bytes_per_cycle},
            {"frame_cycles", scaling.frame},  {"one_device_cycles", scaling.one_device},
            {"speed_up", scaling.speed_up()}, {"efficiency", scaling.efficiency()},
            {"bytes_in", scaling.bytes_in},   {"bytes_out", scaling.bytes_out}};
  if (scaling.clock) {
    json["clock_mhz"] = *scaling.clock;
    json["milliseconds"] = milliseconds(scaling);
    json["fps"] = fps(scaling);
  }
  scaling.shares.for_each([&](const char* name, std::uint64_t cycles, const char*) { json["shares"][name] = cycles; });
  const auto [name, cycles] = limit(scaling);
  json["limit"] = {{"name", name}, {"share", ratio(cycles, scaling.device_cycles())}, {"help", help(scaling)}};
  scaling.roofline.for_each(
      [&](const char* bound, std::uint64_t least, const char*) { json["roofline"][bound] = least; });
  json["roofline"]["ruling"] = largest(scaling.roofline).name;
  json["longest_tile"] = scaling.longest_tile();
  json["each"] = Json::array();
  for (const auto& device : scaling.each) {
    Json account;
    device.account.for_each([&](const char* kind, std::uint64_t spent, const char*) { account[kind] = spent; });
    json["each"].push_back({{"tiles", device.tiles},
                            {"busy", device.stalls.busy},
                            {"idle", device.idle},
                            {"end", device.end},
                            {"account", account}});
  }
  return json;
}

}  // namespace fastsplat::cli
