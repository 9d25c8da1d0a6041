// SPDX-License-Identifier: Apache-2.0
// fastsplat gaussians convert: converts any readable format of 3-D Gaussians to a writable one.
#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "cli/common.hpp"
#include "cli/gaussian_flags.hpp"
#include "cli/gaussian_values.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"

namespace fastsplat::cli {
namespace {

struct GaussiansConvertArguments {
  Common common;
  std::string scene, out;
  bool strict = false;
};

void declare(Options& options, GaussiansConvertArguments& to) {
  options.positional("IN", to.scene, "a file of 3-D Gaussians, or a built-in scene");
  options.values(scene::synthetic_gaussian_names);
  static const std::string endings =
      fmt::format("the file to write: {}", fmt::join(scene::written_gaussian_endings(), ", "));
  options.positional("OUT", to.out, endings.c_str());
  options.group("Input");
  declare_strict(options, to.strict);
  declare(options, to.common);
  options.example("fastsplat gaussians convert shells:300 shells.ply", "a built-in scene as a file");
  options.example("fastsplat gaussians convert shells.ply shells.spz", "a trained scene in a tenth of the bytes");
}

/// The written file.
struct GaussiansConvertResult {
  scene::GaussianCloud cloud;
  std::string out;
  std::uintmax_t bytes = 0;
  std::vector<std::string> lost{};  ///< what the format cannot hold
  double bytes_each() const { return static_cast<double>(bytes) / static_cast<double>(cloud.gaussians.size()); }
};

std::string to_text(const GaussiansConvertResult& result) {
  return fmt::format("{}: {}, {} bytes, {:.1f} a Gaussian\n", result.out,
                     counted(result.cloud.gaussians.size(), "Gaussian"), grouped(result.bytes), result.bytes_each());
}

nlohmann::ordered_json to_json(const GaussiansConvertResult& result) {
  auto json = gaussian_json(result.cloud);
  json["out"] = result.out;
  json["bytes"] = result.bytes;
  json["bytes_each"] = result.bytes_each();
  json["lost"] = result.lost;
  return json;
}

ExitCode run(const GaussiansConvertArguments& arguments) {
  const Output output(arguments.common);
  scene::check_gaussian_ending(arguments.out);
  check_outputs({.others = {arguments.out, arguments.common.json}, .inputs = inputs_of_gaussians(arguments.scene)});
  GaussiansConvertResult result{.cloud = read_gaussians(arguments.scene, arguments.strict), .out = arguments.out};
  result.lost = scene::lost_in_gaussian_file(result.cloud, result.out);
  scene::save_gaussians(result.cloud, result.out);
  std::error_code no_size;  // devices have none
  const std::uintmax_t bytes = std::filesystem::file_size(result.out, no_size);
  result.bytes = no_size ? 0 : bytes;
  output.line(to_text(result));
  output.remark(remarks(result.cloud));
  for (const std::string& text : result.lost) output.warn(arguments.out + ": " + text);
  output.json(to_json(result));
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::gaussians_convert{"gaussians convert",
                                                "convert a scene of 3-D Gaussians to another file format",
                                                subcommand<GaussiansConvertArguments, declare, run>};

}  // namespace fastsplat::cli
