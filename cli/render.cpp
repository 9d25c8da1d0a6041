// fastsplat render: a scene through one engine, to image files.
#include "driver/render.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/image_file.hpp"
#include "analysis/provenance.hpp"
#include "base/atomic_file.hpp"
#include "base/suggest.hpp"
#include "cli/device_report.hpp"
#include "cli/image_output.hpp"
#include "cli/output.hpp"
#include "cli/progress_bar.hpp"
#include "cli/rtl_run.hpp"
#include "cli/scene_flags.hpp"
#include "cli/verbs.hpp"
#include "driver/config_file.hpp"
#include "golden/render.hpp"
#include "scene/splats.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

enum class Engine { Golden, CModel, Rtl };

Engine engine_from(const std::string& name) {
  if (name == "golden") return Engine::Golden;
  if (name == "cmodel") return Engine::CModel;
  if (name == "rtl") return Engine::Rtl;
  const std::vector<std::string> known{"golden", "cmodel", "rtl"};
  throw_usage({.where = "--engine",
               .what = "unknown engine '" + name + "'",
               .expected = {},
               .got = {},
               .fix = suggestion(name, known)});
}

// Everything about the flags that can be wrong without reading a file.
void check(const RenderArguments& arguments, Engine engine) {
  if (arguments.out.empty() && arguments.raw.empty() && arguments.common.json.empty() && arguments.save_scene.empty()) {
    throw_usage({.where = {},
                 .what = "nothing to write",
                 .expected = {},
                 .got = {},
                 .fix = "add --out FILE.exr or --out FILE.png"});
  }
  if (engine == Engine::Golden && arguments.config) {
    throw_usage({.where = "--config",
                 .what = "the golden renderer has no hardware configuration",
                 .expected = {},
                 .got = {},
                 .fix = "add --engine cmodel, or leave --config out"});
  }
  if (engine == Engine::Golden && !arguments.raw.empty()) {
    throw_usage({.where = "--raw",
                 .what = "the golden renderer has no integer words",
                 .expected = {},
                 .got = {},
                 .fix = "add --engine cmodel, or use --out FILE.exr"});
  }
  if (engine != Engine::Rtl && arguments.check) {
    throw_usage({.where = "--check",
                 .what = "there is nothing to check the " + arguments.engine + " engine against here",
                 .expected = {},
                 .got = {},
                 .fix = "add --engine rtl; `fastsplat compare` compares two images"});
  }
  check_outputs({.images = arguments.out,
                 .maps = {},
                 .raw = arguments.raw,
                 .others = {arguments.save_scene, arguments.common.json},
                 .inputs = {}});
}

int sheet_count(const scene::Scene& scene) {
  switch (scene.description.method) {
    case scene::Method::ImageAligned:
      return scene::slab_grid(scene).count;
    case scene::Method::AxisAligned:
      return scene::axis_sheet_count(scene);
    case scene::Method::XRay:
      return scene.description.xray_sheets;
    case scene::Method::Westover:
    case scene::Method::RayCast:
      return 0;
  }
  return 0;
}

std::uint64_t voxel_count(const scene::Scene& scene) {
  std::uint64_t count = 0;
  scene::for_each_splat(scene, [&count](const scene::Splat&) { ++count; });
  return count;
}

Json scene_json(const scene::Scene& scene) {
  const auto& description = scene.description;
  const auto& volume = *scene.volume;
  return {{"volume", volume.name},
          {"source", volume.source},
          {"dims", {volume.dims.x, volume.dims.y, volume.dims.z}},
          {"transfer_function", scene.transfer_function.name},
          {"method", scene::to_string(description.method)},
          {"width", scene.camera.width()},
          {"height", scene.camera.height()},
          {"toml", scene::to_toml(description)}};
}

Image render_golden(const RenderArguments& arguments, const scene::Scene& scene, const Output& output, Json& json) {
  Image image;
  {
    ProgressBar bar("golden", arguments.common.quiet ? Watching::Never : Watching::IfTerminal);
    image = golden::render(scene, {.threads = arguments.common.threads, .progress = bar.callback()});
  }
  output.line(summary(scene));
  const auto voxels = voxel_count(scene);
  const int sheets = sheet_count(scene);
  output.line(fmt::format("golden: {}{}", counted(voxels, "splat"), sheets > 0 ? ", " + counted(sheets, "sheet") : ""));
  json["voxels"] = voxels;
  json["sheets"] = sheets;
  return image;
}

}  // namespace

ExitCode run(const RenderArguments& arguments) {
  const Output output(arguments.common);
  const Engine engine = engine_from(arguments.engine);
  check(arguments, engine);

  std::optional<cmodel::Config> config;
  if (engine != Engine::Golden) config = driver::load_config(arguments.config.value_or("base"));
  if (engine == Engine::Rtl) check_has_rtl(*config);
  const scene::Scene scene = build(arguments.scene);

  Json json{{"verb", "render"},
            {"version", analysis::program_version()},
            {"engine", arguments.engine},
            {"scene", scene_json(scene)}};
  std::optional<analysis::HardwareConfig> hardware;
  if (config) hardware = {config->name, cmodel::config_hash(*config)};
  auto metadata = analysis::render_metadata(arguments.engine, scene.description, hardware);
  metadata["volume"] = scene.volume->source;
  std::optional<RtlRun> checked;
  if (engine == Engine::Golden) {
    const Image image = render_golden(arguments, scene, output, json);
    warn_if_empty(image, output);
    write_images(arguments.out, image, metadata, output);
  } else {
    driver::DeviceRender result;
    {
      ProgressBar bar(arguments.engine, arguments.common.quiet ? Watching::Never : Watching::IfTerminal);
      const driver::RenderOptions options{.threads = arguments.common.threads, .progress = bar.callback()};
      result = engine == Engine::Rtl
                   ? render_rtl(scene, *config, options, arguments.check ? Checking::EveryTap : Checking::Off, checked)
                   : driver::render(scene, *config, options);
    }
    output.line(summary(scene));
    report_device(result, *config, output, json);
    if (checked) report_rtl(*checked, output, json);
    write_device_images(result, arguments.out, arguments.raw, metadata, output);
  }
  if (!arguments.save_scene.empty()) write_text_file(arguments.save_scene, scene::to_toml(scene.description));

  json["outputs"] = arguments.out;
  if (!arguments.raw.empty()) json["raw"] = arguments.raw;
  json["seconds"] = output.seconds();
  output.json(json.dump(2));
  output.note_time("rendered");
  return checked ? checked->exit_code() : ExitCode::Pass;
}

}  // namespace fastsplat::cli
