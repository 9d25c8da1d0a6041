// SPDX-License-Identifier: Apache-2.0
#include "cli/animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/provenance.hpp"
#include "base/machine_error.hpp"
#include "base/number_text.hpp"
#include "base/version.hpp"
#include "cli/frame_names.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "cli/scene_flags.hpp"
#include "cli/video.hpp"
#include "cli/volume_json.hpp"
#include "scene/splat_store.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kFramesASecond = 24.0;

[[noreturn]] void refuse_animation(const std::string& where, const std::string& what, const std::string& fix) {
  throw_usage({.where = where, .what = what, .expected = {}, .got = {}, .fix = fix});
}

std::optional<double> angle(std::string_view text) {
  const auto value = number_from(text);
  return value && std::abs(*value) <= 3600.0 ? value : std::nullopt;
}

scene::Sequence orbit_from(const std::string& text, int frames) {
  const auto dots = text.find("..");
  const auto from = angle(std::string_view(text).substr(0, dots));
  const auto to = dots == std::string::npos ? std::nullopt : angle(std::string_view(text).substr(dots + 2));
  if (!from || !to) {
    throw_usage({.where = "--orbit",
                 .what = "not a range of angles",
                 .expected = "A..B, each from -3600 to 3600 degrees",
                 .got = "'" + text + "'",
                 .fix = "for example --orbit 0..360"});
  }
  return scene::orbit(*from, *to, frames);
}

FrameFiles files_of(const RenderArguments& arguments, int frame, int frames) {
  FrameFiles files;
  for (const auto& pattern : arguments.out) files.out.push_back(FrameNames(pattern, frames)(frame));
  if (!arguments.raw.empty()) files.raw = FrameNames(arguments.raw, frames)(frame);
  return files;
}

/// Whether the file is a complete image with every entry of `metadata`.
bool is_current(const std::string& path, const images::Metadata& metadata) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return false;
  try {
    const auto found = images::read_image(path).metadata;
    return std::all_of(metadata.begin(), metadata.end(), [&found](const auto& entry) {
      const auto at = found.find(entry.first);
      return at != found.end() && at->second == entry.second;
    });
  } catch (const UserError&) {
    return false;  // truncated, or not our image: render it
  }
}

bool is_current(const FrameFiles& files, const images::Metadata& metadata) {
  return std::all_of(files.out.begin(), files.out.end(),
                     [&](const std::string& path) { return is_current(path, metadata); }) &&
         (files.raw.empty() || is_current(files.raw, metadata));
}

/// The frames of the video: the first --out that is a PNG, because only PNGs are display pictures.
const std::string& video_source(const RenderArguments& arguments) {
  const auto png = std::find_if(arguments.out.begin(), arguments.out.end(),
                                [](const std::string& path) { return path.ends_with(".png"); });
  if (png == arguments.out.end())
    refuse_animation("--video", "a video requires PNG frames", "add --out frame.####.png");
  return *png;
}

/// Figures of an animation; `seconds` is absent if it ended early.
struct Result {
  struct Frame {
    FrameFiles files;
    std::optional<Json> figures;  ///< absent: kept from an earlier run
  };
  std::string engine;
  std::vector<Frame> frames;
  std::string video;  ///< empty for none
  std::optional<double> seconds;

  std::size_t kept() const {
    return static_cast<std::size_t>(
        std::count_if(frames.begin(), frames.end(), [](const Frame& frame) { return !frame.figures; }));
  }
};

Json to_json(const Result& result) {
  Json json{{"verb", "render"}, {"version", program_version()}, {"engine", result.engine}, {"frames", Json::array()}};
  for (std::size_t at = 0; at < result.frames.size(); ++at) {
    const auto& [files, figures] = result.frames[at];
    Json entry{{"frame", at}, {"outputs", files.out}, {"kept", !figures}};
    if (!files.raw.empty()) entry["raw"] = files.raw;
    if (figures) entry.update(*figures);
    json["frames"].push_back(std::move(entry));
  }
  if (!result.seconds) return json;
  if (!result.video.empty()) json["video"] = result.video;
  json["rendered"] = result.frames.size() - result.kept();
  json["kept"] = result.kept();
  json["seconds"] = *result.seconds;
  return json;
}

}  // namespace

std::optional<scene::Sequence> sequence_of(const RenderArguments& arguments) {
  if (arguments.rate && arguments.video.empty()) refuse_animation("--rate", "requires --video", "add --video FILE.mp4");
  if (arguments.keep_memory &&
      (arguments.counters || arguments.plain || !arguments.common.json.empty() || arguments.engine != "cmodel")) {
    refuse_animation("--keep-memory", "only --engine cmodel without --counters, --json or --plain keeps voxels",
                     "leave --keep-memory out");
  }
  if (!arguments.orbit && !arguments.sequence) {
    if (arguments.keep_memory)
      refuse_animation("--keep-memory", "requires an animation", "add --orbit A..B --frames N");
    if (arguments.frames)
      refuse_animation("--frames", "requires --orbit or --sequence", "add --orbit A..B or --sequence");
    if (!arguments.video.empty()) refuse_animation("--video", "requires an animation", "add --orbit A..B --frames N");
    for (const auto& path : arguments.out) check_still_name(path);
    check_still_name(arguments.raw);
    return std::nullopt;
  }
  if (arguments.orbit && arguments.sequence)
    refuse_animation({}, "--orbit cannot be combined with --sequence", "use one of them");
  if (arguments.out.empty() && arguments.raw.empty())
    refuse_animation({}, "no frames to write", "add --out frame.####.png");
  if (arguments.rate && !(*arguments.rate >= 0.1 && *arguments.rate <= 1000.0)) {
    throw_usage({.where = "--rate",
                 .what = "out of range",
                 .expected = "0.1..1000 frames a second",
                 .got = fmt::format("{}", *arguments.rate),
                 .fix = "24 is the default"});
  }
  if (!arguments.save_scene.empty()) {
    refuse_animation("--save-scene", "cannot be combined with an animation, which has one scene per frame",
                     "leave --save-scene out: each frame's file holds its scene");
  }
  if (arguments.orbit) {
    if (!arguments.frames) refuse_animation("--orbit", "requires --frames", "add --frames N");
    if (arguments.scene.settings.contains("--azimuth"))
      refuse_animation("--azimuth", "cannot be combined with --orbit, which sets the azimuth", "leave --azimuth out");
    return orbit_from(*arguments.orbit, *arguments.frames);
  }
  if (arguments.gaussians.file) return std::nullopt;
  if (!arguments.scene.file)
    refuse_animation("--sequence", "requires a scene file", "add --scene FILE with a [sequence]");
  auto sequence = scene::load_sequence(*arguments.scene.file);
  if (arguments.frames) sequence.frames = *arguments.frames;
  return sequence;
}

void check_animation(const RenderArguments& arguments, int frames) {
  if (!arguments.wave.file.empty())
    refuse_animation("--wave", "cannot be combined with an animation, which has one run per frame",
                     "render the frame as a still");
  OutputNames names;
  names.others = {arguments.common.json, arguments.video};
  names.inputs = joined(arguments.gaussians.file ? inputs_of(arguments.gaussians) : inputs_of(arguments.scene),
                        inputs_of_config(arguments.config.config.value_or("")));
  for (int frame = 0; frame < frames; ++frame) {
    const auto files = files_of(arguments, frame, frames);
    names.images.insert(names.images.end(), files.out.begin(), files.out.end());
    if (!files.raw.empty()) names.raws.push_back(files.raw);
  }
  if (!arguments.video.empty()) {
    video_source(arguments);
    check_video(arguments.video);
  }
  check_outputs(names);
}

std::size_t kept_bytes(const RenderArguments& arguments) {
  return arguments.keep_memory ? static_cast<std::size_t>(*arguments.keep_memory) << 20 : scene::usual_store_bytes();
}

/// The scene of a frame; errors name the frame's number.
scene::Scene scene_of(const scene::Sequence& sequence, const scene::SceneDescription& still, std::size_t frame,
                      const std::shared_ptr<const volume::Volume>& volume) {
  const auto description = scene::at_frame(sequence, still, static_cast<int>(frame));
  try {
    return volume ? scene::build_scene(description, volume) : scene::build_scene(description);
  } catch (const UserError& error) {
    ErrorParts parts = error.parts();
    parts.where = fmt::format("frame {}{}{}", frame, parts.where.empty() ? "" : ": ", parts.where);
    throw_again(error, std::move(parts), error.code());
  }
}

/// Reports invalid frames before the first is rendered. Skips X-rays, whose automatic exposure traverses the volume.
void check_frames(const scene::Sequence& sequence, const scene::SceneDescription& still, std::size_t count,
                  const std::shared_ptr<const volume::Volume>& volume) {
  if (still.method == scene::Method::XRay) return;
  for (std::size_t frame = 1; frame < count; ++frame) scene_of(sequence, still, frame, volume);
}

ExitCode run_animation(const RenderArguments& arguments, int frames, const std::function<AnimationFrame(int)>& frame,
                       const Output& output) {
  const auto start = ProgressBar::Clock::now();
  Result result;
  result.engine = arguments.engine;
  for (int number = 0; number < frames; ++number) {
    const AnimationFrame next = frame(number);
    const auto files = files_of(arguments, number, frames);
    Result::Frame& entry = result.frames.emplace_back(Result::Frame{files, {}});
    ExitCode code = ExitCode::Pass;
    // A kept frame cannot be checked: with --check every frame is rendered.
    if (!arguments.check && is_current(files, next.metadata)) {
      for (const auto& path : files.out) output.line(path + " kept");
    } else {
      WriteFrame write;
      {
        ProgressBar bar(fmt::format("{} {}/{}", arguments.engine, number + 1, frames), watching(arguments.common),
                        start);
        const auto show = bar.callback();
        const auto whole = [&show, number, frames](std::size_t done, std::size_t total) {
          show(static_cast<std::size_t>(number) * total + done, static_cast<std::size_t>(frames) * total);
        };
        write = next.render(show ? Progress(whole) : Progress());
      }
      code = write(files, entry.figures.emplace());
    }
    if (code != ExitCode::Pass) {
      output.json(to_json(result));
      return code;
    }
  }
  if (!arguments.video.empty()) {
    write_video({.path = arguments.video,
                 .frames = FrameNames(video_source(arguments), frames).format(),
                 .count = frames,
                 .rate = arguments.rate.value_or(kFramesASecond)});
    output.line(arguments.video);
    result.video = arguments.video;
  }
  result.seconds = output.seconds();
  output.json(to_json(result));
  output.note_time(
      fmt::format("{} rendered, {} kept", counted(result.frames.size() - result.kept(), "frame"), result.kept()));
  return ExitCode::Pass;
}

ExitCode run_animation(const RenderArguments& arguments, const Renderer& renderer, const scene::SceneDescription& still,
                       const scene::Sequence& sequence, const Output& output) {
  const auto count = static_cast<std::size_t>(sequence.frames);
  std::shared_ptr<const volume::Volume> volume;  // no track changes it
  // A cropped volume is made anew for each frame.
  const auto store =
      count > 1 && still.crop.everything() ? std::make_shared<scene::SplatStore>(kept_bytes(arguments)) : nullptr;
  const auto frame = [&](int number) {
    const auto scene =
        std::make_shared<scene::Scene>(scene_of(sequence, still, static_cast<std::size_t>(number), volume));
    scene->store = store;
    if (!volume) {
      output.remark(remarks(*scene->volume));
      check_frames(sequence, still, count, scene->whole);
      output.line(fmt::format("{}, {}", summary(*scene), counted(count, "frame")));
    }
    volume = scene->whole;
    const images::Metadata metadata = metadata_of(renderer, *scene);
    const auto render = [&renderer, &output, scene, metadata](const Progress& progress) -> WriteFrame {
      return [&renderer, &output, scene, metadata, rendered = render_frame(renderer, *scene, progress)](
                 const FrameFiles& files, Json& figures) {
        const FrameReport report = report_of(renderer, *scene, rendered);
        figures = to_json(report);
        output.remark(remarks(report));
        write_frame(rendered, *scene, files, metadata, output);
        return rendered.checked ? rendered.checked->exit_code() : ExitCode::Pass;
      };
    };
    return AnimationFrame{metadata, render};
  };
  return run_animation(arguments, sequence.frames, frame, output);
}

}  // namespace fastsplat::cli
