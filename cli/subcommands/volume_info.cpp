// SPDX-License-Identifier: Apache-2.0
// fastsplat volume info: size, spacing, type, values, place.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string_view>

#include "base/printable.hpp"
#include "cli/common.hpp"
#include "cli/names.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/scene_flags.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cli/volume_json.hpp"
#include "scene/value_range.hpp"
#include "scene/volume/placement.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::cli {
namespace {

struct VolumeInfoArguments {
  Common common;
  std::string volume;
  std::optional<double> nan_as;
};

void declare(Options& options, VolumeInfoArguments& to) {
  options.positional("VOLUME", to.volume, "a file or a name");
  options.values(volume::known_volume_names);
  options.group("Input");
  declare_nan_as(options, to.nan_as);
  declare(options, to.common);
  options.example("fastsplat volume info shells:32", "size, spacing, range and position of a volume");
  options.example("fastsplat volume info ch2bet --json -", "a scan by name, as JSON");
}

std::string angle(double degrees) { return fmt::format("{:.1f} degrees", degrees); }

/// Position and orientation in the body, if the file has them.
std::string place_text(const volume::Volume& volume) {
  if (!volume.placed) return {};
  // Turns -0 into 0.
  const auto vector = [](const glm::dvec3& v) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x + 0.0, v.y + 0.0, v.z + 0.0);
  };
  std::string text = fmt::format("centre   {} mm, right anterior superior\n", vector(volume.centre));
  if (!volume.oblique) return text + "axes     straight\n";
  const auto turn = volume::turn_of(volume);
  text += fmt::format("axes     turned by {} about {}", angle(turn.degrees), vector(turn.about));
  return text + (turn.shear > 0.05 ? fmt::format(", sheared by {}\n", angle(turn.shear)) : "\n");
}

/// Statistics of the voxels' values, besides minimum and maximum.
struct Values {
  static constexpr std::array<double, 5> kShares{0.01, 0.25, 0.5, 0.75, 0.99};
  std::array<double, kShares.size()> percentiles{};  ///< of all voxels
  double background = 0.0;                           ///< its largest value
  std::size_t background_voxels = 0;
  scene::ValueSpan shown{};                 ///< range of the other voxels, without outliers at both ends
  std::array<std::size_t, 64> histogram{};  ///< equal bins from the least to the largest value
};

Values values_of(const volume::Volume& volume) {
  Values values;
  scene::RankedValues ranked(volume, -std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < values.percentiles.size(); ++i) values.percentiles[i] = ranked.at(Values::kShares[i]);
  values.background = scene::background_top(volume);
  values.shown = scene::shown_span(volume);
  const double width = (static_cast<double>(volume.max) - volume.min) / static_cast<double>(values.histogram.size());
  for (const float v : volume.voxels) {
    const auto bin = width > 0.0 ? static_cast<std::size_t>((v - volume.min) / width) : 0;
    ++values.histogram[std::min(bin, values.histogram.size() - 1)];
    values.background_voxels += v <= values.background ? 1 : 0;
  }
  return values;
}

/// One character per bin, by the logarithm of its count.
std::string drawn(const Values& values) {
  constexpr std::string_view kInk = " .:-=+*#%@";
  const double most = static_cast<double>(*std::max_element(values.histogram.begin(), values.histogram.end()));
  std::string text;
  for (const std::size_t count : values.histogram) {
    const double share = count == 0 ? 0.0 : std::log1p(static_cast<double>(count)) / std::log1p(most);
    text += kInk[static_cast<std::size_t>(std::ceil(share * static_cast<double>(kInk.size() - 1)))];
  }
  return text;
}

std::string values_text(const volume::Volume& volume, const Values& values) {
  std::string text = fmt::format("values   {:g} to {:g}{}\n         ", volume.min, volume.max,
                                 volume.water ? fmt::format(", as in a CT: 0 HU is {:g}", *volume.water) : "");
  for (std::size_t i = 0; i < values.percentiles.size(); ++i)
    text += fmt::format("{}{:g} %: {:g}", i > 0 ? ", " : "", 100 * Values::kShares[i], values.percentiles[i]);
  return text + fmt::format(
                    "\nshown    {:g} to {:g}; background to {:g}, {:.1f} % of the voxels\n"
                    "counts   [{}] logarithmic, least to greatest value\n",
                    values.shown.low, values.shown.high, values.background,
                    100.0 * static_cast<double>(values.background_voxels) / static_cast<double>(volume.voxels.size()),
                    drawn(values));
}

nlohmann::ordered_json to_json(const volume::Volume& volume, const Values& values) {
  nlohmann::ordered_json json;
  for (std::size_t i = 0; i < values.percentiles.size(); ++i)
    json["percentiles"][fmt::format("p{:g}", 100 * Values::kShares[i])] = values.percentiles[i];
  json["background_top"] = values.background;
  json["background_voxels"] = values.background_voxels;
  json["shown"] = {values.shown.low, values.shown.high};
  json["water"] = volume.water ? nlohmann::ordered_json(*volume.water) : nullptr;
  json["histogram"] = values.histogram;
  return json;
}

std::string to_text(const volume::Volume& volume, const Values& values) {
  const auto& dims = volume.dims;
  const auto& spacing = volume.spacing;
  const auto extent = glm::dvec3(dims) * spacing;
  return fmt::format(
      "volume   {}\n"
      "source   {}\n"
      "voxels   {} x {} x {} = {}\n"
      "type     {}\n"
      "spacing  {:g} x {:g} x {:g} mm\n"
      "extent   {:g} x {:g} x {:g} mm\n{}{}",
      printable(volume.name), printable(volume.source), dims.x, dims.y, dims.z, grouped(volume.voxels.size()),
      volume::to_string(volume.stored), spacing.x, spacing.y, spacing.z, extent.x, extent.y, extent.z,
      values_text(volume, values), place_text(volume));
}

ExitCode run(const VolumeInfoArguments& arguments) {
  const Output output(arguments.common);
  check_volume_name(arguments.volume);
  check_outputs({.others = {arguments.common.json}, .inputs = inputs_of_volume(arguments.volume)});
  const auto volume = volume::load_volume(arguments.volume, reading(arguments.nan_as));
  const Values values = values_of(volume);
  output.line(to_text(volume, values));
  output.remark(remarks(volume));
  auto json = volume_json(volume);
  json["values"] = to_json(volume, values);
  output.json(json);
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::volume_info{"volume info", "print size, spacing, type and range of a volume",
                                          subcommand<VolumeInfoArguments, declare, run>};

}  // namespace fastsplat::cli
