// fastsplat volume info: size, spacing, type, range, place.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/common.hpp"
#include "cli/names.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/scene_flags.hpp"
#include "cli/verbs/verbs.hpp"
#include "cli/volume_json.hpp"
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
  options.example("fastsplat volume info shells:32", "size, spacing, range and place of a volume");
  options.example("fastsplat volume info ch2bet --json -", "of a scan by name, for programs");
}

std::string angle(double degrees) { return fmt::format("{:.1f} degrees", degrees); }

/// How the volume lies in the body, where its file says so.
std::string place_text(const volume::Volume& volume) {
  if (!volume.placed) return {};
  // Not -0, which nobody wants to read.
  const auto vector = [](const glm::dvec3& v) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x + 0.0, v.y + 0.0, v.z + 0.0);
  };
  std::string text = fmt::format("centre   {} mm, right anterior superior\n", vector(volume.centre));
  if (!volume.oblique) return text + "axes     straight\n";
  const auto turn = volume::turn_of(volume);
  text += fmt::format("axes     turned by {} about {}", angle(turn.degrees), vector(turn.about));
  return text + (turn.shear > 0.05 ? fmt::format(", sheared by {}\n", angle(turn.shear)) : "\n");
}

std::string to_text(const volume::Volume& volume) {
  const auto& dims = volume.dims;
  const auto& spacing = volume.spacing;
  const auto extent = glm::dvec3(dims) * spacing;
  return fmt::format(
      "volume   {}\n"
      "source   {}\n"
      "voxels   {} x {} x {} = {}\n"
      "type     {}\n"
      "spacing  {:g} x {:g} x {:g} mm\n"
      "extent   {:g} x {:g} x {:g} mm\n"
      "values   {:g} to {:g}\n{}",
      volume.name, volume.source, dims.x, dims.y, dims.z, grouped(volume.voxels.size()),
      volume::to_string(volume.stored), spacing.x, spacing.y, spacing.z, extent.x, extent.y, extent.z, volume.min,
      volume.max, place_text(volume));
}

ExitCode run(const VolumeInfoArguments& arguments) {
  const Output output(arguments.common);
  check_volume_name(arguments.volume);
  check_outputs({.others = {arguments.common.json}, .inputs = inputs_of_volume(arguments.volume)});
  const auto volume = volume::load_volume(arguments.volume, reading(arguments.nan_as));
  output.line(to_text(volume));
  output.remark(remarks(volume));
  output.json(volume_json(volume));
  return ExitCode::Pass;
}

}  // namespace

const Verb verbs::volume_info{"volume info", "size, spacing, type, range", verb<VolumeInfoArguments, declare, run>};

}  // namespace fastsplat::cli
