// SPDX-License-Identifier: Apache-2.0
// One picture of 3-D Gaussians by one engine: a still, or a frame of an animation.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/frame.hpp"
#include "cli/gaussian_flags.hpp"

namespace fastsplat::cli {

/// How pictures of Gaussians are rendered.
struct GaussianRenderer : Renderer {
  golden::GaussianOrder order = golden::GaussianOrder::Centres;
};

/// Figures of golden.
struct GoldenGaussians {
  scene::ProjectionReport projection;
  std::uint64_t samples = 0;
};
/// Figures of the device.
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

struct GaussianPicture {
  std::variant<Image, cmodel::Frame> picture;
  std::variant<GoldenGaussians, DeviceGaussians> figures;
  std::optional<RtlRun> checked{};  ///< engine rtl only
};

/// Everything that determines a picture's values: pictures with equal entries are comparable. `engine`: what made it.
images::Metadata gaussian_metadata(const std::string& engine, const scene::GaussianScene& scene,
                                   const std::optional<cmodel::Config>& config, golden::GaussianOrder order);

GaussianPicture render_picture(const GaussianRenderer& renderer, const scene::GaussianScene& scene,
                               const Progress& progress);
std::string to_text(const GaussianPicture& picture);
/// Keys of a subcommand's JSON.
nlohmann::ordered_json to_json(const GaussianPicture& picture);
nlohmann::ordered_json to_json(const scene::GaussianScene& scene);
std::vector<Remark> remarks(const GaussianPicture& picture);
void write_picture(const GaussianPicture& picture, const scene::GaussianScene& scene, const scene::Display& display,
                   const FrameFiles& files, const images::Metadata& metadata, const Output& output);

}  // namespace fastsplat::cli
