// fastsplat volume info|convert.
#include "volume/volume.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "volume/volume_file.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

volume::VoxelType type_from(const std::string& name) {
  static const std::map<std::string, volume::VoxelType> types{{"u8", volume::VoxelType::U8},
                                                              {"i8", volume::VoxelType::I8},
                                                              {"u16", volume::VoxelType::U16},
                                                              {"i16", volume::VoxelType::I16},
                                                              {"f32", volume::VoxelType::F32}};
  return types.at(name);  // parse.cpp lets no other name through
}

Json to_json(const volume::Volume& volume) {
  return {{"name", volume.name},
          {"source", volume.source},
          {"dims", {volume.dims.x, volume.dims.y, volume.dims.z}},
          {"spacing_mm", {volume.spacing.x, volume.spacing.y, volume.spacing.z}},
          {"type", volume::to_string(volume.stored)},
          {"voxels", volume.voxels.size()},
          {"min", volume.min},
          {"max", volume.max},
          {"kernel_unit_mm", volume.kernel_unit()}};
}

}  // namespace

ExitCode run(const VolumeInfoArguments& arguments) {
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
  output.json(to_json(volume).dump(2));
  return ExitCode::Pass;
}

ExitCode run(const VolumeConvertArguments& arguments) {
  const Output output(arguments.common);
  { const AtomicFile probe(arguments.out); }  // before the volume is read
  const auto volume = volume::load_volume(arguments.volume);
  const auto type = arguments.type ? type_from(*arguments.type) : volume.stored;
  volume::save_volume(volume, arguments.out, type);
  output.line(fmt::format("{}: {} x {} x {}, {}", arguments.out, volume.dims.x, volume.dims.y, volume.dims.z,
                          volume::to_string(type)));
  Json json = to_json(volume);
  json["out"] = arguments.out;
  json["out_type"] = volume::to_string(type);
  output.json(json.dump(2));
  return ExitCode::Pass;
}

}  // namespace fastsplat::cli
