// SPDX-License-Identifier: Apache-2.0
// fastsplat volume convert: converts any readable volume format to a writable one.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "cli/common.hpp"
#include "cli/names.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/scene_flags.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cli/volume_json.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::cli {
namespace {

struct VolumeConvertArguments {
  Common common;
  std::string volume, out;
  std::optional<std::string> type;
  std::optional<double> nan_as;
};

void declare(Options& options, VolumeConvertArguments& to) {
  options.positional("VOLUME", to.volume, "a file or a name");
  options.values(volume::known_volume_names);
  options.positional("OUT", to.out, "the file to write");
  options.group("Input");
  declare_nan_as(options, to.nan_as);
  options.group("Output");
  options.choice("--type", to.type, {"u8", "i8", "u16", "i16", "f32"}, "u8|i8|u16|i16|f32",
                 "voxel type; default as stored");
  declare(options, to.common);
  options.example("fastsplat volume convert shells:32 shells.nrrd", "a built-in volume as a file");
  options.example("fastsplat volume convert shells.nrrd shells.nii.gz --type f32",
                  "a file in another format and voxel type");
}

volume::VoxelType type_from(const std::string& name) {
  static const std::map<std::string, volume::VoxelType> types{{"u8", volume::VoxelType::U8},
                                                              {"i8", volume::VoxelType::I8},
                                                              {"u16", volume::VoxelType::U16},
                                                              {"i16", volume::VoxelType::I16},
                                                              {"f32", volume::VoxelType::F32}};
  return types.at(name);  // declare() accepts no other names
}

/// The written file.
struct VolumeConvertResult {
  volume::Volume volume;
  std::string out;
  volume::VoxelType type;
};

std::string to_text(const VolumeConvertResult& result) {
  const auto& dims = result.volume.dims;
  return fmt::format("{}: {} x {} x {}, {}\n", result.out, dims.x, dims.y, dims.z, volume::to_string(result.type));
}

nlohmann::ordered_json to_json(const VolumeConvertResult& result) {
  auto json = volume_json(result.volume);
  json["out"] = result.out;
  json["out_type"] = volume::to_string(result.type);
  return json;
}

ExitCode run(const VolumeConvertArguments& arguments) {
  const Output output(arguments.common);
  check_volume_name(arguments.volume);
  check_outputs({.others = {arguments.out, volume::data_file_of(arguments.out).string(), arguments.common.json},
                 .inputs = inputs_of_volume(arguments.volume)});
  auto volume = volume::load_volume(arguments.volume, reading(arguments.nan_as));
  const auto type = arguments.type ? type_from(*arguments.type) : volume.stored;
  volume::save_volume(volume, arguments.out, type);
  const VolumeConvertResult result{.volume = std::move(volume), .out = arguments.out, .type = type};
  output.line(to_text(result));
  output.remark(remarks(result.volume));
  output.json(to_json(result));
  return ExitCode::Pass;
}

}  // namespace

const Subcommand subcommands::volume_convert{"volume convert",
                                             "convert a volume to .nrrd, .nhdr, .nii, .nii.gz, .mha or .mhd",
                                             subcommand<VolumeConvertArguments, declare, run>};

}  // namespace fastsplat::cli
