// SPDX-License-Identifier: Apache-2.0
// Occlusion culling's settings: docs/techniques/occlusion_culling.md. Only the golden renderer has them; the device has
// its configuration's own freeze_below.
#pragma once

#include <string>
#include <vector>

namespace fastsplat::scene {

enum class CullingMode {
  Off,
  Splats,  ///< every splat is tested when its nearest sheet's turn comes
  Blocks,  ///< blocks of voxels first, from the whole volume down; then the remaining splats
};

enum class VisibilityTest {
  Count,    ///< all pixels are opaque: exact
  Average,  ///< their mean opacity reaches theta: may lose splats behind a hole
};

struct Culling {
  CullingMode mode = CullingMode::Off;
  VisibilityTest test = VisibilityTest::Count;
  double freeze = 0.0;  ///< early-termination threshold on transmittance, in every mode
  double theta = 0.95;  ///< mean opacity that VisibilityTest::Average requires
  int block = 8;        ///< edge of the smallest block, voxels
};

const std::vector<std::string>& culling_mode_names();     ///< in the order of CullingMode
const std::vector<std::string>& visibility_test_names();  ///< in the order of VisibilityTest

}  // namespace fastsplat::scene
