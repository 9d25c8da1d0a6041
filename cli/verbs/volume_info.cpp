// fastsplat volume info: size, spacing, type, range.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/common.hpp"
#include "cli/names.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/verbs/verbs.hpp"
#include "cli/volume_json.hpp"
#include "volume/volume_file.hpp"

namespace fastsplat::cli {
namespace {

struct Arguments {
  Common common;
  std::string volume;
};

void declare(Options& options, Arguments& to) {
  options.positional("VOLUME", to.volume, "a file or a name");
  declare(options, to.common);
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
      "values   {:g} to {:g}\n",
      volume.name, volume.source, dims.x, dims.y, dims.z, grouped(volume.voxels.size()),
      volume::to_string(volume.stored), spacing.x, spacing.y, spacing.z, extent.x, extent.y, extent.z, volume.min,
      volume.max);
}

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  check_volume_name(arguments.volume);
  check_outputs({.others = {arguments.common.json}, .inputs = inputs_of_volume(arguments.volume)});
  const auto volume = volume::load_volume(arguments.volume);
  output.line(to_text(volume));
  output.json(volume_json(volume));
  return ExitCode::Pass;
}

}  // namespace

const Verb verbs::volume_info{"volume info", "size, spacing, type, range", verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
