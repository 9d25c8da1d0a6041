// SPDX-License-Identifier: Apache-2.0
#include "cli/gaussian_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/version.hpp"
#include "cli/animation.hpp"
#include "cli/gaussian_picture.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

void check(const RenderArguments& arguments, Engine engine) {
  const auto refuse = [](const char* flag, const std::string& what, const std::string& fix) {
    throw_usage({.where = flag, .what = what, .expected = {}, .got = {}, .fix = fix});
  };
  const auto& flags = arguments.gaussians;
  if (!arguments.save_scene.empty())
    refuse("--save-scene", "a scene.toml describes volumes; it cannot be combined with --gaussians", "leave it out");
  if (arguments.plain && engine == Engine::Golden)
    refuse("--plain", "the golden renderer has one method for 3-D Gaussians", "add --engine cmodel, or leave it out");
  if (arguments.keep_memory) refuse("--keep-memory", "only voxels are kept", "leave it out");
  if (arguments.orbit && (flags.cameras || flags.pose || flags.eye))
    refuse("--orbit", "cannot be combined with --cameras, --pose or --eye", "use one of them");
  if (arguments.sequence && !flags.cameras)
    refuse("--sequence", "of 3-D Gaussians requires --cameras, whose cameras are its frames", "add --cameras FILE");
  if (arguments.sequence && (arguments.frames || flags.view))
    refuse(flags.view ? "--view" : "--frames",
           "cannot be combined with --sequence, which draws every camera of --cameras", "leave it out");
}

ExitCode run_still(const RenderArguments& arguments, const GaussianRenderer& renderer, const GaussianView& view,
                   const Output& output) {
  const scene::GaussianScene scene = build(arguments.gaussians, view);
  const FrameFiles files{.out = arguments.out, .raw = arguments.raw};
  output.line(summary(scene));
  output.remark(cli::remarks(*scene.cloud));
  GaussianPicture picture;
  {
    ProgressBar bar(arguments.engine, watching(arguments.common));
    picture = render_picture(renderer, scene, bar.callback());
  }
  output.line(cli::to_text(picture));
  output.remark(cli::remarks(picture));
  write_picture(picture, scene, view.shown.display, files,
                gaussian_metadata(arguments.engine, scene, renderer.config, renderer.order), output);
  ExitCode code = ExitCode::Pass;
  Wave wave;
  if (picture.checked) {
    const auto emit = [&](const cmodel::BeatSink& sink) {
      driver::GaussianFrame(scene, scene::project_all(scene), *renderer.config).emit(sink);
    };
    wave = write_wave(arguments.wave, emit, *renderer.config, *picture.checked);
    code = print_wave(wave, picture.checked->exit_code(), output);
  }
  Json json{{"verb", "render"},
            {"version", program_version()},
            {"engine", arguments.engine},
            {"gaussians", cli::to_json(scene)}};
  json.update(cli::to_json(picture));
  if (!wave.file.empty()) json["wave"] = cli::to_json(wave);
  json["outputs"] = files.out;
  if (!files.raw.empty()) json["raw"] = files.raw;
  json["seconds"] = output.seconds();
  output.json(json);
  output.note_time("rendered");
  return code;
}

bool of_one_size(const std::vector<scene::GaussianDescription>& frames) {
  return std::ranges::all_of(frames, [&](const scene::GaussianDescription& one) {
    return one.width == frames.front().width && one.height == frames.front().height;
  });
}

void check_frames(const RenderArguments& arguments, const std::vector<scene::GaussianDescription>& frames) {
  check_animation(arguments, static_cast<int>(frames.size()));
  if (of_one_size(frames) || arguments.video.empty()) return;
  throw_usage({.where = "--video",
               .what = "the cameras have pictures of different sizes",
               .expected = {},
               .got = {},
               .fix = "add --size"});
}

ExitCode run_frames(const RenderArguments& arguments, const GaussianRenderer& renderer, const GaussianView& view,
                    const std::vector<scene::GaussianDescription>& frames, const Output& output) {
  const int count = static_cast<int>(frames.size());
  scene::GaussianScene first = build(arguments.gaussians, view);
  if (first.description.placed) first.description.placed->name.clear();  // the summary is of all frames
  output.remark(cli::remarks(*first.cloud));
  output.line(fmt::format("{}, {}{}", summary(first), counted(frames.size(), "frame"),
                          of_one_size(frames) ? "" : " of different sizes, of which this is the first's"));
  const auto frame = [&](int number) {
    auto description = frames[static_cast<std::size_t>(number)];
    description.up = first.description.up;
    const auto scene = std::make_shared<scene::GaussianScene>(scene::seen_by(description, first));
    const images::Metadata metadata = gaussian_metadata(arguments.engine, *scene, renderer.config, renderer.order);
    const auto render = [&, scene, metadata](const Progress& progress) -> WriteFrame {
      return [&, scene, metadata, picture = render_picture(renderer, *scene, progress)](const FrameFiles& files,
                                                                                        Json& figures) {
        figures = cli::to_json(picture);
        figures["view"] = cli::to_json(*scene).at("view");
        if (const auto& camera = scene->description.placed; camera) figures["camera"] = camera->name;
        output.remark(cli::remarks(picture));
        write_picture(picture, *scene, view.shown.display, files, metadata, output);
        return picture.checked ? picture.checked->exit_code() : ExitCode::Pass;
      };
    };
    return AnimationFrame{metadata, render};
  };
  return run_animation(arguments, count, frame, output);
}

}  // namespace

ExitCode run_gaussians(const RenderArguments& arguments, const Renderer& how) {
  const Output output(arguments.common);
  check(arguments, how.engine);
  const auto sequence = sequence_of(arguments);
  GaussianRenderer renderer{how};
  if (renderer.engine != Engine::Golden) renderer.config = load_for_gaussians(arguments.config);
  const GaussianView view = renderer.config ? describe_for_device(arguments.gaussians, arguments.scene)
                                            : describe(arguments.gaussians, arguments.scene);
  renderer.order = view.order;
  if (renderer.config) driver::check_drawable(view.description, *renderer.config);
  std::vector<scene::GaussianDescription> frames;
  if (sequence) frames = frames_of(*sequence, view);
  if (arguments.sequence) frames = frames_of_cameras(arguments.gaussians, view);
  if (!frames.empty()) {
    check_frames(arguments, frames);
  } else {
    check_outputs(
        {.images = arguments.out,
         .maps = {},
         .raws = {arguments.raw},
         .others = {arguments.common.json, arguments.wave.file},
         .inputs = joined(inputs_of(arguments.gaussians), inputs_of_config(arguments.config.config.value_or("")))});
  }
  if (renderer.engine == Engine::Rtl)
    prepare_rtl(*renderer.config, wanted_abilities(arguments.wave), arguments.common,
                "use --engine cmodel, its bit-accurate model");
  return frames.empty() ? run_still(arguments, renderer, view, output)
                        : run_frames(arguments, renderer, view, frames, output);
}

}  // namespace fastsplat::cli
