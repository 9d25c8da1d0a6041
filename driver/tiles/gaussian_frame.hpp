// SPDX-License-Identifier: Apache-2.0
// A view of 3-D Gaussians compiled for a device that composites every sample of ellipses (docs/numerics.md, section 8,
// "3-D Gaussians").
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/progress.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/stream/beat.hpp"
#include "cmodel/stream/device.hpp"
#include "cmodel/stream/frame.hpp"
#include "cmodel/stream/record_sink.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/tiles/render.hpp"
#include "driver/tiles/tile_bins.hpp"
#include "scene/gaussians/projected_gaussian.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::cmodel::fast {
template <class Word>
class TileUnit;
}

namespace fastsplat::driver {

/// A configuration and the changes of it that draw Gaussians with golden's early-termination threshold.
inline constexpr const char* kGaussianConfig = "ellipse";
inline constexpr std::array kGaussianChanges{"composite.every_sample=1", "composite.freeze_below=7"};

/// exp(-q/2), cut at the cutoff.
scene::Kernel kernel_of(const scene::GaussianDescription& description);
/// UserError (Usage) if the configuration has no ellipses, does not composite every sample, or has no words for the
/// smallest footprints.
void check_drawable(const scene::GaussianDescription& description, const cmodel::Config& config);
/// Whether some of the Gaussian's pixels in the picture lie farther from its centre than `reach` (gaussian_reach()).
bool too_far(const scene::GaussianScene& scene, const scene::ProjectedGaussian& splat, int reach);

/// Report on a compiled view; `cut` and `saturated` are 0 in a healthy one.
struct GaussianReport {
  scene::ProjectionReport projection;
  std::uint64_t drawn = 0;      ///< Gaussians that have records if all tiles are written
  std::uint64_t vanished = 0;   ///< Gaussians whose words are all 0
  std::uint64_t saturated = 0;  ///< Gaussians brighter than the input format holds
  double brightest = 0.0;       ///< largest colour
  std::uint64_t cut = 0;        ///< Gaussians that reach farther into the picture than a record can express
  std::uint64_t thin = 0;       ///< Gaussians so long and thin that an ellipse's words do not hold their shape
  std::uint64_t records = 0;    ///< over all tiles
  std::uint64_t in_tiles = 0;   ///< Gaussians with a record, over all tiles
  std::uint64_t tiles = 0;
};

/// The words of a Gaussian in image coordinates.
struct QuantisedGaussian {
  std::int32_t x = 0, y = 0;  ///< 2^-pf pixel
  std::array<std::uint32_t, 4> colour{};
  cmodel::EllipseShape shape;
  Extent box;  ///< pixels that it may touch

  bool empty() const { return (colour[0] | colour[1] | colour[2] | colour[3]) == 0; }
};

class GaussianFrame {
 public:
  /// `projected` from project_all(). Throws as check_drawable() does. `threads` (0: all cores) never change it.
  GaussianFrame(const scene::GaussianScene& scene, const std::vector<scene::ProjectedGaussian>& projected,
                const cmodel::Config& config, int threads = 0);

  const cmodel::Config& config() const { return config_; }
  const TileGrid& grid() const { return grid_; }
  /// begin_frame and the tables.
  std::span<const cmodel::Beat> preamble() const { return preamble_; }
  /// begin_tile .. end_tile. Returns the tile's contribution to the report. Tiles may be emitted in parallel.
  GaussianReport emit_tile(int tile, cmodel::RecordSink& sink) const;
  /// The same, for a unit that does not count: Gaussians whose pixels are all terminated are left out.
  template <class Word>
  GaussianReport emit_visible(int tile, cmodel::fast::TileUnit<Word>& unit) const;
  /// All of them, as beats.
  GaussianReport emit_tile(int tile, const cmodel::BeatSink& sink) const;
  /// Preamble and all tiles in order: a subset stream, without end_frame.
  GaussianReport emit(const cmodel::BeatSink& sink, const Progress& progress = {}) const;
  /// The report without contributions of tiles.
  const GaussianReport& report() const { return report_; }
  /// Number of Gaussians in each tile: an estimate of its work.
  std::vector<std::uint64_t> work() const;

 private:
  /// Writes the words of `splats` from gaussians_[first] on; they stay empty where nothing is drawn.
  void quantise_all(const scene::GaussianScene& scene, std::span<const scene::ProjectedGaussian> splats,
                    std::size_t first, GaussianReport& report);
  template <class Hidden>
  GaussianReport emit_tile(int tile, cmodel::RecordSink& sink, const Hidden& hidden) const;

  cmodel::Config config_;
  TileGrid grid_;
  std::vector<cmodel::Beat> preamble_;
  std::vector<QuantisedGaussian> gaussians_;  ///< nearest first
  std::optional<TileBins> bins_;              ///< per tile, nearest first; some may meet no pixel of it
  GaussianReport report_;
};

GaussianReport& operator+=(GaussianReport& report, const GaussianReport& tile);

struct GaussianRender {
  cmodel::Frame frame;
  cmodel::Counters counters;
  GaussianReport report;  ///< if not `counted`, without Gaussians and records that can change no pixel
  UnitReport units;
  bool counted = true;  ///< if not, counters are of what can change a pixel
};

/// Renders with the integer model, tiles in parallel, without bands.
GaussianRender render_gaussians(const GaussianFrame& frame, const RenderOptions& options = {});

}  // namespace fastsplat::driver
