// SPDX-License-Identifier: Apache-2.0
// Runs a frame through any device, tile after tile: for `render --engine rtl` and the checker.
#pragma once

#include <functional>
#include <memory>

#include "cmodel/stream/device.hpp"
#include "driver/tiles/render.hpp"
#include "driver/tiles/tile_bins.hpp"

namespace fastsplat::driver {

using DeviceFactory = std::function<std::unique_ptr<cmodel::Device>(cmodel::PixelSink& pixels)>;

struct DeviceFrame {
  cmodel::Frame frame;
  cmodel::Counters counters;
};
/// Feeds a subset stream (no end_frame) to one device and gathers the frame. `finished` receives the device at the end,
/// to read further results.
DeviceFrame run_device(const cmodel::BeatSource& source, const TileGrid& grid, const cmodel::Config& config,
                       const DeviceFactory& make, const std::function<void(cmodel::Device&)>& finished = {});

/// The same for preamble and tiles of a scene.
DeviceRender run_device(const scene::Scene& scene, const cmodel::Config& config, const DeviceFactory& make,
                        const RenderOptions& options = {}, const std::function<void(cmodel::Device&)>& finished = {});

}  // namespace fastsplat::driver
