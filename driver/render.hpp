// A scene through the integer device: compile to the stream, tile by tile, feed the device, gather the frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/image.hpp"
#include "base/progress.hpp"
#include "cmodel/config.hpp"
#include "cmodel/counters.hpp"
#include "cmodel/frame.hpp"
#include "scene/scene.hpp"

namespace fastsplat::driver {

struct RenderOptions {
  int threads = 0;  ///< tiles in parallel; 0: all cores. Never changes the result.
  Progress progress;
};

/// What the driver had to bend to fit the formats; the last three are 0 in a healthy frame.
struct DriverReport {
  std::uint64_t voxels = 0;         ///< non-empty voxels
  std::uint64_t splat_records = 0;  ///< splat records over all tiles and sheets
  std::uint64_t tiles = 0;
  std::uint64_t sheets = 0;             ///< non-empty sheets over all tiles
  std::uint64_t saturated_voxels = 0;   ///< voxels whose whole splat left U 4.cf
  std::uint64_t saturated_records = 0;  ///< records whose share left the input format U 0.cf
  std::uint64_t vanished_voxels = 0;    ///< voxels whose colour and opacity rounded to 0
};

struct DeviceRender {
  cmodel::Frame frame;
  cmodel::Counters counters;
  DriverReport report;
};

/// Throws UserError (Usage) where the scene does not fit the configuration (method, footprint radius, radius sets),
/// with both numbers and the nearest thing that would fit.
DeviceRender render(const scene::Scene& scene, const cmodel::Config& config, const RenderOptions& options = {});

/// word / 2^frac_bits, exactly representable in float up to 24 bits.
Image to_image(const cmodel::Frame& frame);

}  // namespace fastsplat::driver
