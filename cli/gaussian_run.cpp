// SPDX-License-Identifier: Apache-2.0
#include "cli/gaussian_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>

#include "base/hash_text.hpp"
#include "base/srgb.hpp"
#include "base/version.hpp"
#include "cli/config_json.hpp"
#include "cli/device_report.hpp"
#include "cli/frame.hpp"
#include "cli/image_output.hpp"
#include "cli/output_names.hpp"
#include "cli/progress_bar.hpp"
#include "driver/tiles/gaussian_frame.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

void check(const RenderArguments& arguments, Engine engine) {
  const auto refuse = [](const char* flag, const std::string& what, const std::string& fix) {
    throw_usage({.where = flag, .what = what, .expected = {}, .got = {}, .fix = fix});
  };
  const std::string none = "it cannot be combined with --gaussians";
  if (arguments.orbit || arguments.sequence || arguments.frames || arguments.keep_memory)
    refuse("--orbit, --sequence, --frames, --keep-memory", "animations support volumes only",
           "render stills with --azimuth");
  if (!arguments.save_scene.empty()) refuse("--save-scene", "a scene.toml describes volumes; " + none, "leave it out");
  if (arguments.plain && engine == Engine::Golden)
    refuse("--plain", "the golden renderer has one method for 3-D Gaussians", "add --engine cmodel, or leave it out");
}

struct GoldenGaussians {
  scene::ProjectionReport projection;
  std::uint64_t samples = 0;
};
struct DeviceGaussians {
  cmodel::Config config;
  driver::GaussianReport report;
  cmodel::Counters counters;
  driver::UnitReport units;
  bool counted = true;  ///< driver::GaussianRender::counted
  double lanes() const { return static_cast<double>(config.lanes) * config.lanes; }
  /// Share of the lanes of all windows that have a weight.
  double used() const {
    return static_cast<double>(counters.lanes_weighted) /
           (lanes() * static_cast<double>(std::max<std::uint64_t>(counters.windows, 1)));
  }
  double windows_each() const {
    return static_cast<double>(counters.windows) / static_cast<double>(std::max<std::uint64_t>(report.in_tiles, 1));
  }
};

struct Result {
  std::string engine;
  const scene::GaussianScene& scene;
  std::variant<GoldenGaussians, DeviceGaussians> of{};
  FrameFiles files{};
  std::optional<RtlRun> checked{};  ///< engine rtl only
  Wave wave{};
  double seconds = 0.0;
};

std::string to_text(const scene::ProjectionReport& projection) {
  return fmt::format("projection: {} drawn, {} behind the near plane, {} outside the picture\n",
                     grouped(projection.gaussians - projection.near - projection.outside - projection.degenerate),
                     grouped(projection.near), grouped(projection.outside));
}

std::string to_text(const GoldenGaussians& golden) {
  return to_text(golden.projection) + fmt::format("golden: {} composited\n", counted(golden.samples, "sample"));
}

std::string to_text(const DeviceGaussians& device) {
  if (!device.counted) {
    return to_text(device.report.projection) + visible_text(counted(device.report.in_tiles, "Gaussian") + " in tiles",
                                                            counted(device.report.records, "ellipse record"),
                                                            device.config, device.units);
  }
  return to_text(device.report.projection) +
         fmt::format("driver: {} Gaussians in tiles, {}, {}\n", grouped(device.report.in_tiles),
                     counted(device.report.records, "ellipse record"), counted(device.report.tiles, "tile")) +
         fmt::format(
             "device: configuration {} {}, {} ({:.2f} a Gaussian and tile, {:.1f} % of their lanes used), {} "
             "composited, {} of them terminated\n",
             device.config.name, hash_text(cmodel::config_hash(device.config)),
             counted(device.counters.windows, "window"), device.windows_each(), 100.0 * device.used(),
             counted(device.counters.pixels_composited, "sample"), grouped(device.counters.frozen_pixels)) +
         cli::to_text(device.units, device.counters);
}

Json to_json(const scene::ProjectionReport& projection) {
  return {{"gaussians", projection.gaussians},
          {"near", projection.near},
          {"outside", projection.outside},
          {"degenerate", projection.degenerate}};
}

Json to_json(const GoldenGaussians& golden) {
  return {{"projection", to_json(golden.projection)}, {"samples", golden.samples}};
}

Json to_json(const DeviceGaussians& device) {
  Json json{{"config", priced_config_json(device.config)}, {"projection", to_json(device.report.projection)}};
  if (!device.counted) {
    json.update(uncounted_json(device.report.in_tiles, device.report.records));
    return json;
  }
  json["driver"] = {{"drawn", device.report.drawn},         {"vanished", device.report.vanished},
                    {"saturated", device.report.saturated}, {"cut", device.report.cut},
                    {"thin", device.report.thin},           {"in_tiles", device.report.in_tiles},
                    {"records", device.report.records},     {"tiles", device.report.tiles}};
  if (device.units.fast + device.units.plain > 0) json["units"] = cli::to_json(device.units);
  auto& counts = json["counters"];
  device.counters.for_each(
      [&](std::string_view name, std::uint64_t value, std::string_view) { counts[std::string(name)] = value; });
  return json;
}

/// Everything that decides what of the scene is where in the picture.
std::string view_text(const scene::GaussianScene& scene) {
  const auto& description = scene.description;
  const auto& camera = description.camera;
  std::string text;
  if (description.placed) {
    const auto vector = [](const glm::dvec3& of) { return fmt::format("{},{},{}", of.x, of.y, of.z); };
    const glm::dmat3 back = glm::transpose(scene.turn);  // to the file's axes
    text = fmt::format("eye {}, right {}, forward {}, scale {} and {}, axis at {},{}, near {}",
                       vector(description.placed->eye), vector(back * scene.camera.right()),
                       vector(back * scene.camera.direction()), scene.camera.scale_at(0.0),
                       scene.camera.scale_at(0.0) * scene.camera.stretch(), scene.camera.centre().x,
                       scene.camera.centre().y, scene.near);
  } else {
    text = fmt::format("{}, azimuth {}, elevation {}, roll {}, zoom {}, fov {}, up {}",
                       camera.projection == scene::Projection::Perspective ? "perspective" : "orthographic",
                       camera.azimuth, camera.elevation, camera.roll, camera.zoom, camera.fov,
                       scene::up_axis_names()[static_cast<std::size_t>(description.up)]);
    if (description.near) text += fmt::format(", near {}", scene.near);
  }
  return text + fmt::format(", low-pass {}, cutoff {}", description.low_pass, description.cutoff);
}

Json to_json(const Result& result) {
  const auto& description = result.scene.description;
  Json json{{"verb", "render"},
            {"version", program_version()},
            {"engine", result.engine},
            {"gaussians",
             {{"name", result.scene.cloud->name},
              {"source", result.scene.cloud->source},
              {"count", result.scene.cloud->gaussians.size()},
              {"degree", result.scene.cloud->degree},
              {"content_hash", hash_text(scene::content_hash(*result.scene.cloud))},
              {"up", scene::up_axis_names()[static_cast<std::size_t>(description.up)]},
              {"low_pass", description.low_pass},
              {"cutoff", description.cutoff},
              {"view", view_text(result.scene)},
              {"width", description.width},
              {"height", description.height}}}};
  if (result.scene.cloud->antialiased) json["gaussians"]["antialiased"] = true;
  if (result.scene.cloud->linear) json["gaussians"]["linear"] = true;
  if (!result.scene.cloud->remarks.empty()) json["gaussians"]["remarks"] = result.scene.cloud->remarks;
  std::visit([&json](const auto& of) { json.update(to_json(of)); }, result.of);
  if (result.checked) json.update(to_json(*result.checked));
  if (!result.wave.file.empty()) json["wave"] = to_json(result.wave);
  json["outputs"] = result.files.out;
  if (!result.files.raw.empty()) json["raw"] = result.files.raw;
  json["seconds"] = result.seconds;
  return json;
}

std::vector<Remark> remarks(const DeviceGaussians& device) {
  std::vector<Remark> said;
  const auto& report = device.report;
  if (report.cut > 0) {
    said.push_back(
        {Remark::Warning,
         fmt::format(
             "{} Gaussians exceed the reach of an ellipse record and were clipped; use a smaller --size or --zoom",
             grouped(report.cut))});
  }
  if (report.thin > 0) {
    said.push_back({Remark::Warning,
                    fmt::format("{} Gaussians are so long and thin that an ellipse's words do not hold their shape; "
                                "`fastsplat errors` says what that costs, under step radius",
                                grouped(report.thin))});
  }
  if (report.saturated > 0) {
    said.push_back(
        {Remark::Warning, fmt::format("{} Gaussians are brighter than the input format allows and were clamped",
                                      grouped(report.saturated))});
  }
  if (report.vanished > 0) {
    said.push_back({Remark::Note, fmt::format("{} Gaussians are too transparent for the input format and vanished",
                                              grouped(report.vanished))});
  }
  const int one = 1 << device.config.composite_frac_bits;
  const int wanted = static_cast<int>(std::ceil(scene::kFinished * one));
  if (device.config.freeze_below != wanted) {
    said.push_back(
        {Remark::Note, fmt::format("pixels terminate below a transmittance of {:.2g}, but golden's below {:g}; use "
                                   "--set composite.freeze_below={} to match",
                                   static_cast<double>(device.config.freeze_below) / one, scene::kFinished, wanted)});
  }
  device.counters.for_each([&](std::string_view name, std::uint64_t value, std::string_view meaning) {
    if (name.ends_with("_saturated") && value > 0)
      said.push_back({Remark::Warning, fmt::format("{} {}", grouped(value), meaning)});
  });
  return said;
}

/// The display picture. Colours of trained scenes are sRGB-encoded, as in photographs, and are blended in that encoding
/// unless the file declares them linear. Blends over the background.
Image shown_of(const Image& image, const scene::Display& display, bool linear) {
  const bool behind = display.background != glm::dvec3(0.0);
  Image shown = image;
  for (std::size_t at = 0; at < shown.data.size(); at += 4) {
    const double left = 1.0 - static_cast<double>(shown.data[at + 3]);
    for (int c = 0; c < 3; ++c) {
      const double value = static_cast<double>(shown.data[at + static_cast<std::size_t>(c)]);
      const double ground = linear ? display.background[c] : srgb_encode(display.background[c]);
      const double over = behind ? value + left * ground : value;
      shown.data[at + static_cast<std::size_t>(c)] = static_cast<float>(linear ? over : srgb_decode(over));
    }
    if (behind) shown.data[at + 3] = 1.0F;
  }
  return shown;
}

}  // namespace

images::Metadata gaussian_metadata(const std::string& engine, const scene::GaussianScene& scene,
                                   const std::optional<cmodel::Config>& config, golden::GaussianOrder order) {
  images::Metadata metadata{{"engine", engine},
                            {"method", order == golden::GaussianOrder::Pixels ? "gaussians, ordered at every pixel"
                                       : scene.order == scene::GaussianSort::Distance ? "gaussians, ordered by distance"
                                                                                      : "gaussians"},
                            {"gaussians", scene.cloud->source},
                            {"content_hash", hash_text(scene::content_hash(*scene.cloud))},
                            {"view", view_text(scene)},
                            {"version", program_version()}};
  if (config) {
    metadata["config"] = config->name;
    metadata["config_hash"] = hash_text(cmodel::config_hash(*config));
  }
  return metadata;
}

ExitCode run_gaussians(const RenderArguments& arguments) {
  const Output output(arguments.common);
  const Engine engine = engine_from(arguments.engine);
  check(arguments, engine);
  std::optional<cmodel::Config> config;
  if (engine != Engine::Golden) config = load_for_gaussians(arguments.config);
  const GaussianView view = engine == Engine::Golden ? describe(arguments.gaussians, arguments.scene)
                                                     : describe_for_device(arguments.gaussians, arguments.scene);
  check_outputs(
      {.images = arguments.out,
       .maps = {},
       .raws = {arguments.raw},
       .others = {arguments.common.json, arguments.wave.file},
       .inputs = joined(inputs_of(arguments.gaussians), inputs_of_config(arguments.config.config.value_or("")))});
  if (engine == Engine::Rtl)
    prepare_rtl(*config, wanted_abilities(arguments.wave), arguments.common,
                "use --engine cmodel, its bit-accurate model");
  const scene::GaussianScene scene = build(arguments.gaussians, view);

  Result result{.engine = arguments.engine, .scene = scene, .files = {.out = arguments.out, .raw = arguments.raw}};
  scene::ProjectionReport projection;
  const auto projected = scene::project_all(scene, &projection, arguments.common.threads);
  const images::Metadata metadata = gaussian_metadata(arguments.engine, scene, config, view.order);
  std::optional<driver::GaussianFrame> frame;
  std::optional<RtlRun> checked;
  if (config) frame.emplace(scene, projected, *config, arguments.common.threads);
  output.line(summary(scene));
  output.remark(remarks(*scene.cloud));
  output.remark(remarks(projection));
  const auto shown = [&](const Image& image) { return shown_of(image, view.shown.display, scene.cloud->linear); };
  if (frame) {
    driver::GaussianRender render;
    if (engine == Engine::Rtl) {
      ProgressBar bar(arguments.engine, watching(arguments.common));
      const cmodel::BeatSource source = [&](const cmodel::BeatSink& sink) {
        render.report = frame->emit(sink, bar.callback());
      };
      auto [words, counters] =
          render_rtl(source, frame->grid(), *config, arguments.check ? Checking::EveryTap : Checking::Off, checked);
      render.frame = std::move(words);
      render.counters = counters;
    } else {
      ProgressBar bar(arguments.engine, watching(arguments.common));
      render = driver::render_gaussians(*frame, {.threads = arguments.common.threads,
                                                 .unit = arguments.plain ? driver::Unit::Plain : driver::Unit::Fast,
                                                 .counters = arguments.counts(),
                                                 .progress = bar.callback()});
    }
    DeviceGaussians device{*config, render.report, render.counters, render.units, render.counted};
    device.report.projection = projection;
    output.line(to_text(device) + (checked ? to_text(*checked) : ""));
    output.remark(remarks(device));
    result.of = device;
    result.checked = checked;
    write_device_images(render.frame, result.files.out, result.files.raw, shown, metadata, output);
  } else {
    GoldenGaussians golden{projection};
    Image image;
    {
      ProgressBar bar(arguments.engine, watching(arguments.common));
      image = golden::render_gaussians(scene, projected,
                                       {.threads = arguments.common.threads,
                                        .progress = bar.callback(),
                                        .order = view.order,
                                        .samples = &golden.samples});
    }
    output.line(to_text(golden));
    result.of = golden;
    write_images(result.files.out, image, shown, metadata, output);
  }
  ExitCode code = ExitCode::Pass;
  if (checked) {
    result.wave = write_wave(
        arguments.wave, [&](const cmodel::BeatSink& sink) { frame->emit(sink); }, *config, *checked);
    code = print_wave(result.wave, checked->exit_code(), output);
  }
  result.seconds = output.seconds();
  output.json(to_json(result));
  output.note_time("rendered");
  return code;
}

}  // namespace fastsplat::cli
