// SPDX-License-Identifier: Apache-2.0
#include "cli/frame.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "analysis/provenance.hpp"
#include "base/suggest.hpp"
#include "cli/device_report.hpp"
#include "cli/image_output.hpp"
#include "cli/scene_flags.hpp"
#include "driver/splats/splat_quantiser.hpp"
#include "scene/sheet_plan.hpp"
#include "scene/splats.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNarrow = 2.0;  // pixels: a narrower footprint covers one to four of them

const std::vector<std::string> kEngines{"golden", "cmodel", "rtl"};

/// For techniques that do not count splats: the ray caster, and densities classified after splatting.
std::uint64_t voxel_count(const scene::Scene& scene) {
  const scene::Traversal traversal(scene);
  return traversal.count(traversal.all());
}

std::string to_text(const golden::CullingReport& culling) {
  const auto share = [&culling](std::uint64_t part) {
    return culling.voxels == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(culling.voxels);
  };
  return fmt::format("culling: {:.1f} % splatted, {:.1f} % culled in blocks, {:.1f} % singly, {:.1f} % outside\n",
                     share(culling.splatted), share(culling.culled_in_blocks), share(culling.culled_singly),
                     share(culling.outside)) +
         fmt::format("culling: {} of splats, {} of blocks, {} hidden\n", counted(culling.splat_tests, "test"),
                     counted(culling.block_tests, "test"), counted(culling.blocks_culled, "block"));
}

Json to_json(const golden::CullingReport& culling) {
  return {{"voxels", culling.voxels},
          {"splatted", culling.splatted},
          {"culled_in_blocks", culling.culled_in_blocks},
          {"culled_singly", culling.culled_singly},
          {"outside", culling.outside},
          {"share_splatted", culling.share_splatted()},
          {"splat_tests", culling.splat_tests},
          {"block_tests", culling.block_tests},
          {"blocks", culling.blocks},
          {"blocks_culled", culling.blocks_culled},
          {"map_seconds", culling.map_seconds},
          {"test_seconds", culling.test_seconds}};
}

std::string to_text(const GoldenReport& golden) {
  const std::string text =
      fmt::format("golden: {}{}\n", counted(golden.voxels, "splat"),
                  golden.sheets > 0 ? ", " + counted(static_cast<std::uint64_t>(golden.sheets), "sheet") : "");
  return golden.report.culling ? text + to_text(*golden.report.culling) : text;
}

Json to_json(const GoldenReport& golden) {
  Json json{{"voxels", golden.voxels},
            {"sheets", golden.sheets},
            {"traversal_seconds", golden.report.traversal_seconds},
            {"splatting_seconds", golden.report.splatting_seconds}};
  if (golden.report.culling) json["culling"] = to_json(*golden.report.culling);
  return json;
}

}  // namespace

Engine engine_from(const std::string& name) {
  const auto found = std::find(kEngines.begin(), kEngines.end(), name);
  if (found == kEngines.end()) {
    throw_usage({.where = "--engine",
                 .what = "unknown engine '" + name + "'",
                 .expected = {},
                 .got = {},
                 .fix = suggestion(name, kEngines)});
  }
  return static_cast<Engine>(found - kEngines.begin());
}

const char* to_string(Engine engine) { return kEngines[static_cast<std::size_t>(engine)].c_str(); }

images::Metadata metadata_of(const Renderer& renderer, const scene::Scene& scene) {
  std::optional<analysis::HardwareConfig> hardware;
  if (renderer.config) hardware = {renderer.config->name, cmodel::config_hash(*renderer.config)};
  return analysis::render_metadata(to_string(renderer.engine), scene, hardware);
}

RenderedFrame render_frame(const Renderer& renderer, const scene::Scene& scene, const Progress& progress) {
  RenderedFrame frame;
  if (renderer.engine == Engine::Golden) {
    frame.picture = golden::render(scene, {.threads = renderer.threads,
                                           .progress = progress,
                                           .report = &frame.golden,
                                           .plain = renderer.unit == driver::Unit::Plain});
    return frame;
  }
  const driver::RenderOptions options{.threads = renderer.threads,
                                      .unit = renderer.unit,
                                      .counters = renderer.counters,
                                      .progress = progress};
  frame.picture = renderer.engine == Engine::Rtl
                      ? render_rtl(scene, *renderer.config, options, renderer.checking, frame.checked)
                      : driver::render(scene, *renderer.config, options);
  return frame;
}

FrameReport report_of(const Renderer& renderer, const scene::Scene& scene, const RenderedFrame& frame) {
  FrameReport report{.scene = summary(scene),
                     .footprint_width = 2.0 * driver::pixel_radius(scene, scene.camera.scale_at(0.0)),
                     .engine = {},
                     .checked = frame.checked};
  if (const auto* device = std::get_if<driver::DeviceRender>(&frame.picture)) {
    report.engine = DeviceReport{*renderer.config, device->report, device->counters, device->units,
                                 scene.description.method == scene::Method::XRay, device->counted};
  } else {
    report.engine = GoldenReport{frame.golden.splats ? *frame.golden.splats : voxel_count(scene),
                                 scene::sheet_plan(scene).slabs.count, frame.golden};
  }
  return report;
}

std::string to_text(const FrameReport& report) {
  return report.scene + "\n" + std::visit([](const auto& engine) { return to_text(engine); }, report.engine) +
         (report.checked ? to_text(*report.checked) : "");
}

nlohmann::ordered_json to_json(const FrameReport& report) {
  auto json = std::visit([](const auto& engine) { return to_json(engine); }, report.engine);
  if (report.checked) json.update(to_json(*report.checked));
  return json;
}

std::vector<Remark> remarks(const FrameReport& report) {
  const auto* device = std::get_if<DeviceReport>(&report.engine);
  if (device == nullptr) return {};
  auto said = remarks(*device);
  if (report.footprint_width < kNarrow) {
    said.push_back(
        {Remark::Note,
         fmt::format(
             "footprints are {:.2g} pixels wide: below {:g} the device's rounding of positions to 1/{} pixel is "
             "visible; use a larger --size or --zoom, or more phases (--set snap.phases and position.frac_bits)",
             report.footprint_width, kNarrow, device->config.phases)});
  }
  return said;
}

void write_frame(const RenderedFrame& frame, const scene::Scene& scene, const FrameFiles& files,
                 const images::Metadata& metadata, const Output& output) {
  const auto shown = [&scene](const Image& image) { return scene::displayed(image, scene.description); };
  if (const auto* device = std::get_if<driver::DeviceRender>(&frame.picture))
    write_device_images(device->frame, files.out, files.raw, shown, metadata, output);
  else
    write_images(files.out, std::get<Image>(frame.picture), shown, metadata, output);
}

}  // namespace fastsplat::cli
