// SPDX-License-Identifier: Apache-2.0
#include "cli/gaussian_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "base/srgb.hpp"
#include "base/version.hpp"
#include "cli/config_json.hpp"
#include "cli/device_report.hpp"
#include "cli/image_output.hpp"
#include "cli/progress_bar.hpp"
#include "driver/tiles/gaussian_frame.hpp"
#include "lab/link.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

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

const scene::ProjectionReport& projection_of(const GoldenGaussians& golden) { return golden.projection; }
const scene::ProjectionReport& projection_of(const DeviceGaussians& device) { return device.report.projection; }

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
  json["driver"] = {{"drawn", device.report.drawn},
                    {"vanished", device.report.vanished},
                    {"saturated", device.report.saturated},
                    {"brightest", device.report.brightest},
                    {"cut", device.report.cut},
                    {"thin", device.report.thin},
                    {"in_tiles", device.report.in_tiles},
                    {"records", device.report.records},
                    {"tiles", device.report.tiles}};
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

std::vector<Remark> remarks(const DeviceGaussians& device) {
  std::vector<Remark> said = cli::remarks(device.report, device.config);
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
  const std::string link = order == golden::GaussianOrder::Pixels ? "" : lab::link_of_gaussians(scene);
  if (!link.empty()) metadata["lab"] = link;
  if (config) {
    metadata["config"] = config->name;
    metadata["config_hash"] = hash_text(cmodel::config_hash(*config));
  }
  return metadata;
}

GaussianPicture render_picture(const GaussianRenderer& renderer, const scene::GaussianScene& scene,
                               const Progress& progress) {
  scene::ProjectionReport projection;
  const auto projected = scene::project_all(scene, &projection, renderer.threads, step_of(progress, 0, 2));
  const Progress drawing = step_of(progress, 1, 2);
  if (renderer.engine == Engine::Golden) {
    GoldenGaussians golden{projection};
    Image image = golden::render_gaussians(
        scene, projected,
        {.threads = renderer.threads, .progress = drawing, .order = renderer.order, .samples = &golden.samples});
    return {std::move(image), golden};
  }
  const cmodel::Config& config = *renderer.config;
  const driver::GaussianFrame frame(scene, projected, config, renderer.threads);
  driver::GaussianRender render;
  std::optional<RtlRun> checked;
  if (renderer.engine == Engine::Rtl) {
    const cmodel::BeatSource source = [&](const cmodel::BeatSink& sink) { render.report = frame.emit(sink, drawing); };
    auto [words, counters] = render_rtl(source, frame.grid(), config, renderer.checking, checked);
    render.frame = std::move(words);
    render.counters = counters;
  } else {
    render = driver::render_gaussians(
        frame,
        {.threads = renderer.threads, .unit = renderer.unit, .counters = renderer.counters, .progress = drawing});
  }
  DeviceGaussians device{config, render.report, render.counters, render.units, render.counted};
  device.report.projection = projection;
  return {std::move(render.frame), device, std::move(checked)};
}

std::string to_text(const GaussianPicture& picture) {
  return std::visit([](const auto& of) { return to_text(of); }, picture.figures) +
         (picture.checked ? to_text(*picture.checked) : "");
}

Json to_json(const GaussianPicture& picture) {
  Json json = std::visit([](const auto& of) { return to_json(of); }, picture.figures);
  if (picture.checked) json.update(to_json(*picture.checked));
  return json;
}

Json to_json(const scene::GaussianScene& scene) {
  const auto& description = scene.description;
  const auto& cloud = *scene.cloud;
  Json json{{"name", cloud.name},
            {"source", cloud.source},
            {"count", cloud.gaussians.size()},
            {"degree", cloud.degree},
            {"content_hash", hash_text(scene::content_hash(cloud))},
            {"up", scene::up_axis_names()[static_cast<std::size_t>(description.up)]},
            {"low_pass", description.low_pass},
            {"cutoff", description.cutoff},
            {"view", view_text(scene)},
            {"order", scene.order == scene::GaussianSort::Distance ? "distance" : "centres"},
            {"width", description.width},
            {"height", description.height}};
  if (cloud.antialiased) json["antialiased"] = true;
  if (cloud.linear) json["linear"] = true;
  if (description.placed && !description.placed->name.empty()) json["camera"] = description.placed->name;
  if (!cloud.remarks.empty()) json["remarks"] = cloud.remarks;
  return json;
}

std::vector<Remark> remarks(const GaussianPicture& picture) {
  const auto* const device = std::get_if<DeviceGaussians>(&picture.figures);
  const auto& projection =
      std::visit([](const auto& of) -> const scene::ProjectionReport& { return projection_of(of); }, picture.figures);
  std::vector<Remark> out = remarks(projection);
  if (device != nullptr)
    for (Remark& remark : remarks(*device)) out.push_back(std::move(remark));
  return out;
}

void write_picture(const GaussianPicture& picture, const scene::GaussianScene& scene, const scene::Display& display,
                   const FrameFiles& files, const images::Metadata& metadata, const Output& output) {
  const auto shown = [&](const Image& image) { return shown_of(image, display, scene.cloud->linear); };
  if (const auto* const words = std::get_if<cmodel::Frame>(&picture.picture)) {
    write_device_images(*words, files.out, files.raw, shown, metadata, output);
  } else {
    write_images(files.out, std::get<Image>(picture.picture), shown, metadata, output);
  }
}

}  // namespace fastsplat::cli
