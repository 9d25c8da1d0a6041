// fastsplat volume info: size, spacing, type, range.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/common.hpp"
#include "cli/output.hpp"
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

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  const auto volume = volume::load_volume(arguments.volume);
  const auto& dims = volume.dims;
  const auto& spacing = volume.spacing;
  const auto extent = glm::dvec3(dims) * spacing;
  output.line(fmt::format("volume   {}", volume.name));
  output.line(fmt::format("source   {}", volume.source));
  output.line(fmt::format("voxels   {} x {} x {} = {}", dims.x, dims.y, dims.z, grouped(volume.voxels.size())));
  output.line(fmt::format("type     {}", volume::to_string(volume.stored)));
  output.line(fmt::format("spacing  {:g} x {:g} x {:g} mm", spacing.x, spacing.y, spacing.z));
  output.line(fmt::format("extent   {:g} x {:g} x {:g} mm", extent.x, extent.y, extent.z));
  output.line(fmt::format("values   {:g} to {:g}", volume.min, volume.max));
  output.json(volume_json(volume).dump(2));
  return ExitCode::Pass;
}

}  // namespace

const Verb verbs::volume_info{"volume info", "size, spacing, type, range", verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
