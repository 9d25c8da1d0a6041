// SPDX-License-Identifier: Apache-2.0
// fastsplat render: a scene through one engine, to image files: a still or the frames of an animation.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/provenance.hpp"
#include "base/atomic_file.hpp"
#include "base/utf8.hpp"
#include "base/version.hpp"
#include "cli/animation.hpp"
#include "cli/frame.hpp"
#include "cli/gaussian_run.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_flags.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cli/volume_json.hpp"
#include "driver/config/changed.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

// Checks the flags as far as possible without reading files.
void check(const RenderArguments& arguments, Engine engine) {
  if (arguments.out.empty() && arguments.raw.empty() && arguments.common.json.empty() && arguments.save_scene.empty() &&
      arguments.wave.file.empty() && arguments.video.empty()) {
    throw_usage({.where = {},
                 .what = "nothing to write",
                 .expected = {},
                 .got = {},
                 .fix = "add --out FILE.exr or --out FILE.png"});
  }
  if (engine == Engine::Golden && (arguments.config.config || !arguments.config.changes.empty())) {
    const auto& changes = arguments.config.changes;
    throw_usage({.where = arguments.config.config ? "--config" : driver::as_flag(changes.front()),
                 .what = "the golden renderer does not use a hardware configuration",
                 .expected = {},
                 .got = {},
                 .fix = "add --engine cmodel, or leave it out"});
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
                 .what = "cannot check the " + arguments.engine + " engine",
                 .expected = {},
                 .got = {},
                 .fix = "add --engine rtl, or compare two images with `fastsplat compare`"});
  }
  range_of(arguments.wave);
  if (engine != Engine::Rtl && !arguments.wave.file.empty()) {
    throw_usage({.where = "--wave",
                 .what = "the " + arguments.engine + " engine has no signals",
                 .expected = {},
                 .got = {},
                 .fix = "add --engine rtl"});
  }
  if (engine != Engine::CModel && (arguments.counters || arguments.no_counters)) {
    throw_usage({.where = arguments.counters ? "--counters" : "--no-counters",
                 .what = "only the cmodel engine can count or not: golden has no counters, the RTL always counts",
                 .expected = "--engine cmodel",
                 .got = "--engine " + arguments.engine,
                 .fix = "leave it out"});
  }
  if (engine == Engine::Rtl && arguments.plain) {
    throw_usage({.where = "--plain",
                 .what = "the rtl engine has one implementation only",
                 .expected = {},
                 .got = {},
                 .fix = "add --engine cmodel, or leave it out"});
  }
}

/// Figures of a picture; its pixels are in the files.
struct RenderResult {
  std::string engine;
  scene::Scene scene;
  FrameReport frame;
  FrameFiles files;
  Wave wave;
  double seconds = 0.0;
};

Json to_json(const scene::Scene& scene) {
  const auto& description = scene.description;
  const auto& volume = *scene.volume;
  Json json{{"volume", volume.name},
            {"source", volume.source},
            {"dims", {volume.dims.x, volume.dims.y, volume.dims.z}},
            {"transfer_function", scene.transfer_function.name},
            {"method", scene::to_string(description.method)},
            {"width", scene.camera.width()},
            {"height", scene.camera.height()},
            {"toml", scene::to_toml(description)}};
  if (description.method == scene::Method::XRay) {
    json["xray_exposure"] = scene.xray_scale;
    json["xray_exposure_automatic"] = !(description.xray_exposure > 0.0);
  }
  return json;
}

Json to_json(const RenderResult& result) {
  Json json{
      {"verb", "render"}, {"version", program_version()}, {"engine", result.engine}, {"scene", to_json(result.scene)}};
  json.update(to_json(result.frame));
  json["outputs"] = result.files.out;
  if (!result.files.raw.empty()) json["raw"] = result.files.raw;
  if (!result.wave.file.empty()) json["wave"] = to_json(result.wave);
  json["seconds"] = result.seconds;
  return json;
}

/// TOML is UTF-8 text and cannot name files whose names are not.
void require_saveable(const scene::SceneDescription& description) {
  if (is_utf8(scene::to_toml(description))) return;
  throw_usage({.where = "--save-scene",
               .what = "a file name of the scene is not UTF-8, which TOML requires",
               .expected = {},
               .got = {},
               .fix = "rename the file or its folder, or leave --save-scene out"});
}

ExitCode run_still(const RenderArguments& arguments, const Renderer& renderer,
                   const scene::SceneDescription& description, const Output& output) {
  require_file("--save-scene", arguments.save_scene);
  if (!arguments.save_scene.empty()) require_saveable(description);
  const scene::Scene scene = scene::build_scene(description);
  output.remark(remarks(scene));
  RenderedFrame frame;
  {
    ProgressBar bar(arguments.engine, watching(arguments.common));
    frame = render_frame(renderer, scene, bar.callback());
  }
  RenderResult result{.engine = arguments.engine,
                      .scene = scene,
                      .frame = report_of(renderer, scene, frame),
                      .files = {.out = arguments.out, .raw = arguments.raw},
                      .wave = {}};
  output.line(to_text(result.frame));
  output.remark(remarks(result.frame));
  write_frame(frame, scene, result.files, metadata_of(renderer, scene), output);
  if (!arguments.save_scene.empty()) write_text_file(arguments.save_scene, scene::to_toml(scene.description));

  ExitCode code = ExitCode::Pass;
  if (frame.checked) {
    result.wave = write_wave(arguments.wave, scene, *renderer.config, *frame.checked);
    code = print_wave(result.wave, frame.checked->exit_code(), output);
  }
  result.seconds = output.seconds();
  output.json(to_json(result));
  output.note_time("rendered");
  return code;
}

ExitCode run(const RenderArguments& arguments) {
  const Output output(arguments.common);
  Renderer renderer{.engine = engine_from(arguments.engine),
                    .config = {},
                    .checking = arguments.check ? Checking::EveryTap : Checking::Off,
                    .unit = arguments.plain ? driver::Unit::Plain : driver::Unit::Fast,
                    .counters = arguments.counts(),
                    .threads = arguments.common.threads};
  check(arguments, renderer.engine);
  if (arguments.gaussians.file) return run_gaussians(arguments, renderer);
  refuse_without_gaussians(arguments.gaussians);
  const auto sequence = sequence_of(arguments);
  const scene::SceneDescription description = describe(arguments.scene, sequence ? &*sequence : nullptr);
  if (renderer.engine != Engine::Golden) renderer.config = load(arguments.config);
  if (sequence) {
    check_animation(arguments, sequence->frames);
  } else {
    check_outputs(
        {.images = arguments.out,
         .maps = {},
         .raws = {arguments.raw},
         .others = {arguments.save_scene, arguments.common.json, arguments.wave.file},
         .inputs = joined(inputs_of(arguments.scene), inputs_of_config(arguments.config.config.value_or("")))});
  }
  if (renderer.engine == Engine::Rtl)
    prepare_rtl(*renderer.config, wanted_abilities(arguments.wave), arguments.common,
                "use --engine cmodel, its bit-accurate model");
  return sequence ? run_animation(arguments, renderer, description, *sequence, output)
                  : run_still(arguments, renderer, description, output);
}

}  // namespace

const Subcommand subcommands::render{"render", "render a volume or 3-D Gaussians to an image",
                                     subcommand<RenderArguments, declare, run>};

}  // namespace fastsplat::cli
