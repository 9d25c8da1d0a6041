// SPDX-License-Identifier: Apache-2.0
// Renders a scene with the integer device: compiles it to the stream tile by tile, feeds the device, gathers the frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/image.hpp"
#include "base/progress.hpp"
#include "cmodel/cull/terminations.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/stream/frame.hpp"
#include "driver/tiles/driver_report.hpp"
#include "scene/scene.hpp"

namespace fastsplat::driver {

/// The two software devices, with the same words and counters.
enum class Unit {
  Plain,  ///< cmodel/model.*: readable, tapped, the reference for the RTL
  Fast,   ///< cmodel/fast/: if the configuration and its tables allow it, else plain
};

struct RenderOptions {
  int threads = 0;  ///< bands of tiles in parallel; 0: all cores. Never changes the result.
  Unit unit = Unit::Fast;
  /// Without counters only what can change a pixel is visited, where Unit::Fast can draw it so; DeviceRender::counted
  /// says whether it did.
  bool counters = true;
  int band_rows = 0;  ///< for the fast unit, rounded up to whole blocks; 0: automatic. Changes only hidden_splats.
  Progress progress = {};
  /// Of the picture's size, all open: receives the sheets after which pixels are terminated (modes 0 and 1).
  cmodel::Terminations* terminations = nullptr;
};

/// Which unit drew the tiles of a frame.
struct UnitReport {
  std::uint64_t fast = 0, plain = 0;  ///< tiles; all plain if the fast unit cannot draw the frame
  std::uint64_t redone = 0;  ///< tiles that the fast unit gave up and the plain one drew: a sum might have been cut
  /// Records that the fast unit counted but did not draw: they could not change the band of the tile they begin in.
  std::uint64_t hidden_splats = 0;
  const char* vectors = nullptr;    ///< the fast unit's instructions, "AVX2" and the like
  const char* why_plain = nullptr;  ///< reason why the requested fast unit could not draw
};

/// Adds the counts of `tile`.
UnitReport& operator+=(UnitReport& report, const UnitReport& tile);

struct DeviceRender {
  cmodel::Frame frame;
  cmodel::Counters counters;
  DriverReport report;
  UnitReport units;
  /// If not, counters and report are those of Picture (driver/tiles/picture.hpp).
  bool counted = true;
};

/// Throws UserError (Usage) if the scene does not fit the configuration (method, footprint radius, radius sets), with
/// both numbers and the nearest value that would fit.
DeviceRender render(const scene::Scene& scene, const cmodel::Config& config, const RenderOptions& options = {});

/// word / 2^frac_bits, exactly representable in float up to 24 bits.
Image to_image(const cmodel::Frame& frame);

}  // namespace fastsplat::driver
