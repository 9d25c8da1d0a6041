// fastsplat volume info|convert.
#include "scene/volume.hpp"

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "scene/volume_file.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

scene::VoxelType type_from(const std::string& name) {
  static const std::map<std::string, scene::VoxelType> types{{"u8", scene::VoxelType::U8},
                                                             {"i8", scene::VoxelType::I8},
                                                             {"u16", scene::VoxelType::U16},
                                                             {"i16", scene::VoxelType::I16},
                                                             {"f32", scene::VoxelType::F32}};
  return types.at(name);  // parse.cpp lets no other name through
}

Json to_json(const scene::Volume& volume) {
  return {{"name", volume.name},
          {"source", volume.source},
          {"dims", {volume.dims.x, volume.dims.y, volume.dims.z}},
          {"spacing_mm", {volume.spacing.x, volume.spacing.y, volume.spacing.z}},
          {"type", scene::to_string(volume.stored)},
          {"voxels", volume.voxels.size()},
          {"min", volume.min},
          {"max", volume.max},
          {"kernel_unit_mm", volume.kernel_unit()}};
}

}  // namespace

ExitCode run(const VolumeInfoArguments& arguments) {
  const Output output(arguments.common);
  const auto volume = scene::load_volume(arguments.volume);
  const auto& dims = volume.dims;
  const auto& spacing = volume.spacing;
  const auto extent = glm::dvec3(dims) * spacing;
  output.line(fmt::format("volume   {}", volume.name));
  output.line(fmt::format("source   {}", volume.source));
  output.line(fmt::format("voxels   {} x {} x {} = {}", dims.x, dims.y, dims.z, grouped(volume.voxels.size())));
  output.line(fmt::format("type     {}", scene::to_string(volume.stored)));
  output.line(fmt::format("spacing  {:g} x {:g} x {:g} mm", spacing.x, spacing.y, spacing.z));
  output.line(fmt::format("extent   {:g} x {:g} x {:g} mm", extent.x, extent.y, extent.z));
  output.line(fmt::format("values   {:g} to {:g}", volume.min, volume.max));
  output.json(to_json(volume).dump(2));
  return ExitCode::Pass;
}

ExitCode run(const VolumeConvertArguments& arguments) {
  const Output output(arguments.common);
  { const AtomicFile probe(arguments.out); }  // before the volume is read
  const auto volume = scene::load_volume(arguments.volume);
  const auto type = arguments.type ? type_from(*arguments.type) : volume.stored;
  scene::save_volume(volume, arguments.out, type);
  output.line(fmt::format("{}: {} x {} x {}, {}", arguments.out, volume.dims.x, volume.dims.y, volume.dims.z,
                          scene::to_string(type)));
  Json json = to_json(volume);
  json["out"] = arguments.out;
  json["out_type"] = scene::to_string(type);
  output.json(json.dump(2));
  return ExitCode::Pass;
}

}  // namespace fastsplat::cli
