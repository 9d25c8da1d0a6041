// SPDX-License-Identifier: Apache-2.0
// fastsplat gaussians info: counts, ranges, harmonics, declarations, dropped rows.
#include <nlohmann/json.hpp>

#include "cli/common.hpp"
#include "cli/gaussian_flags.hpp"
#include "cli/gaussian_values.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"

namespace fastsplat::cli {
namespace {

struct GaussiansInfoArguments {
  Common common;
  std::string scene;
  bool strict = false;
};

void declare(Options& options, GaussiansInfoArguments& to) {
  options.positional("FILE", to.scene, "a file of 3-D Gaussians, or a built-in scene");
  options.values(scene::synthetic_gaussian_names);
  options.group("Input");
  declare_strict(options, to.strict);
  declare(options, to.common);
  options.example("fastsplat gaussians info shells:300", "counts, ranges and harmonics of a scene");
  options.example("fastsplat gaussians info cloud:200 --json -", "the same as JSON");
}

ExitCode run(const GaussiansInfoArguments& arguments) {
  const Output output(arguments.common);
  check_outputs({.others = {arguments.common.json}, .inputs = inputs_of_gaussians(arguments.scene)});
  const scene::GaussianCloud cloud = read_gaussians(arguments.scene, arguments.strict);
  output.line(gaussian_text(cloud));
  output.remark(remarks(cloud));
  output.json(gaussian_json(cloud));
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::gaussians_info{"gaussians info",
                                             "print counts, ranges and declarations of a scene of 3-D Gaussians",
                                             subcommand<GaussiansInfoArguments, declare, run>};

}  // namespace fastsplat::cli
