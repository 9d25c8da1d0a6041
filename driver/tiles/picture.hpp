// SPDX-License-Identifier: Apache-2.0
// Draws a frame's words without counting anything: what cannot change a pixel is neither classified nor projected.
#pragma once

#include <optional>

#include "base/progress.hpp"
#include "cmodel/fast/frame_tables.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/stream/frame.hpp"
#include "driver/tiles/driver_report.hpp"
#include "driver/tiles/frame_head.hpp"
#include "scene/scene.hpp"

namespace fastsplat::driver {

/// Whether draw_picture() can draw the frame: circles in sheets, without error diffusion.
bool draws_pictures(const scene::Scene& scene, const FrameHead& head);

/// A frame and what was visited for it: no more than can change a pixel, as far as bricks and blocks tell.
struct Picture {
  cmodel::Frame frame;
  cmodel::Counters losses;  ///< only the *_saturated, of visible pixels
  DriverReport report;      ///< of the splats visited; no tiles or sheets
};

/// The words are those of the counting units. Empty if a sum may have been cut. `band_rows`, the height of a band,
/// rounded up to blocks, and `threads` (0: all cores) never change the frame. Takes splats from scene.store, if there
/// is one, and keeps them there. Progress counts bands.
std::optional<Picture> draw_picture(const scene::Scene& scene, const FrameHead& head,
                                    const cmodel::fast::FrameTables& tables, int band_rows, int threads,
                                    const Progress& progress);

}  // namespace fastsplat::driver
