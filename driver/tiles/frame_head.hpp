// SPDX-License-Identifier: Apache-2.0
// What a frame is before its first splat: the device's mode, slabs, footprints and tables, from scene and configuration.
#pragma once

#include <vector>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/beat.hpp"
#include "cmodel/stream/stream_layout.hpp"
#include "driver/splats/slices.hpp"
#include "driver/tables/radius_sets.hpp"
#include "driver/tiles/tile_bins.hpp"
#include "scene/capability.hpp"
#include "scene/scene.hpp"
#include "scene/sheet_plan.hpp"
#include "scene/textured_splats.hpp"

namespace fastsplat::driver {

/// Whether a frame's samples are composited one by one (modes 4 and 5), not summed in sheets.
bool every_sample(const scene::SceneDescription& description);

/// The mode of the frame's tiles.
cmodel::Mode mode_of(const scene::SceneDescription& description);

/// The sheets that the device receives, whichever method makes them; one sheet if every sample is composited. The scene
/// must have passed scene::check_capability().
scene::SheetPlan plan_for_device(const scene::Scene& scene);

/// What a device of this configuration offers: always the methods with sheets; with ellipses, footprints of any shape.
scene::Offers offers(const cmodel::Config& config);

struct FrameHead {
  cmodel::Config config;
  cmodel::Mode mode;
  scene::SheetPlan plan;
  Slices slices;
  scene::TexturedSplats textures;  ///< the sets' pictures, if any
  RadiusSets sets;
  TileGrid grid;
  std::vector<cmodel::Beat> preamble;  ///< begin_frame and the tables

  /// Throws UserError (Usage) if the scene does not fit the configuration. `threads` never changes the result.
  FrameHead(const scene::Scene& scene, const cmodel::Config& device, int threads);

  /// The pictures for SplatQuantiser; null: none.
  const scene::TexturedSplats* pictures() const { return textures.phases().empty() ? nullptr : &textures; }
  int halo() const { return cmodel::holds_densities(mode) ? 1 : 0; }  ///< width of the halo, pixels
  bool sliced() const { return plan.use == scene::SheetUse::Sliced; }

 private:
  void make_preamble(const scene::Scene& scene, int threads);
};

}  // namespace fastsplat::driver
