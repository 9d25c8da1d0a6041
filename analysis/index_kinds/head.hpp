// SPDX-License-Identifier: Apache-2.0
// A real picture with every index kind: the head scan by the integer model against golden, and the shares of its error
// that splat positions and the index cause.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/index_kinds/family_table.hpp"
#include "base/progress.hpp"
#include "scene/scene.hpp"

namespace fastsplat::analysis {

/// The scan with its transfer function at 128 x 128; a synthetic volume if the scan is not installed.
struct HeadScene {
  scene::Scene scene;
  bool is_scan = false;
  double radius = 0.0;  ///< of footprints, pixels
};
HeadScene head_scene();

struct HeadRange {
  std::vector<cmodel::IndexKind> kinds;
  std::vector<int> grids, entries;
};
/// All kinds, k 4..64, N 256 and 1024; without squared_elliptic, which has squared's words for circles.
HeadRange whole_head();

struct HeadCell {
  cmodel::Config config;
  bool has_table = false;
  FieldError error;  ///< of the picture's values, 1/255
  /// E[d e] / E[e^2] (docs/errors.md, section 2): e is the error. d is the change of the picture if the splats'
  /// positions (steps position and snap) are the device's, then if the index is, too.
  double place_share = 0.0, index_share = 0.0;
};
/// `threads` (0: all cores) never change the result.
std::vector<HeadCell> head_table(const HeadScene& head, const HeadRange& range, int threads, const Progress& progress);

/// One row of the table, and the page's section: heading, what was drawn, table.
std::string head_row(const HeadCell& cell);
std::string head_section(const HeadScene& head, const std::vector<HeadCell>& cells);

}  // namespace fastsplat::analysis
