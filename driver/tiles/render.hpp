// A scene through the integer device: compile to the stream, tile by tile, feed the device, gather the frame.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "base/image.hpp"
#include "base/progress.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/stream/frame.hpp"
#include "scene/scene.hpp"

namespace fastsplat::driver {

/// The two software devices: the same words and counters.
enum class Unit {
  Plain,  ///< cmodel/model.*: readable, tapped, what the RTL is held to
  Fast,   ///< cmodel/fast/: where the configuration and its tables allow, else plain
};

struct RenderOptions {
  int threads = 0;  ///< bands of tiles in parallel; 0: all cores. Never changes the result.
  Unit unit = Unit::Fast;
  int band_rows = 0;  ///< of the fast unit, rounded up to whole blocks; 0: as is best. Changes only hidden_splats.
  Progress progress = {};
};

/// What the driver had to bend to fit the formats; all but the first four are 0 in a healthy frame.
struct DriverReport {
  std::uint64_t voxels = 0;         ///< non-empty voxels
  std::uint64_t splat_records = 0;  ///< splat records over all tiles and sheets
  std::uint64_t tiles = 0;
  std::uint64_t sheets = 0;             ///< non-empty sheets over all tiles
  std::uint64_t saturated_voxels = 0;   ///< voxels whose whole splat left U 4.cf
  std::uint64_t saturated_records = 0;  ///< records whose share left the input format U 0.cf
  std::uint64_t vanished_voxels = 0;    ///< voxels whose words are all 0
  double vanished_share = 0.0;          ///< of all colour and opacity, what they had; 0 where it was carried on
  std::uint64_t widened_voxels = 0;     ///< drawn with a wider footprint than theirs (driver/splats/ellipse_shape.hpp)
  bool carried = false;                 ///< roundings were carried from voxel to voxel (rounding.carry)
};

/// Which unit drew the tiles of a frame.
struct UnitReport {
  std::uint64_t fast = 0, plain = 0;  ///< tiles; all plain where the fast unit cannot be
  std::uint64_t redone = 0;           ///< of the plain ones, those the fast unit gave up: a sum may have been cut
  /// Records the fast unit counted without drawing: nothing could change in the band of the tile they begin in.
  std::uint64_t hidden_splats = 0;
  const char* vectors = nullptr;    ///< the fast unit's instructions, "AVX2" and the like
  const char* why_plain = nullptr;  ///< why the fast unit, which was asked for, could not draw any
};

/// Adds what was drawn.
UnitReport& operator+=(UnitReport& report, const UnitReport& tile);

struct DeviceRender {
  cmodel::Frame frame;
  cmodel::Counters counters;
  DriverReport report;
  UnitReport units;
};

/// Throws UserError (Usage) where the scene does not fit the configuration (method, footprint radius, radius sets),
/// with both numbers and the nearest thing that would fit.
DeviceRender render(const scene::Scene& scene, const cmodel::Config& config, const RenderOptions& options = {});

/// word / 2^frac_bits, exactly representable in float up to 24 bits.
Image to_image(const cmodel::Frame& frame);

}  // namespace fastsplat::driver
