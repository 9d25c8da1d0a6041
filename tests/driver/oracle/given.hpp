// SPDX-License-Identifier: Apache-2.0
// The inputs that docs/numerics.md, section 8, takes as given for a frame, by the names of the page; all unrounded.
#pragma once

#include <array>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "scene/scene.hpp"
#include "tests/cmodel/oracle/symbols.hpp"

namespace fastsplat::scene_oracle {

/// S: of the kernel's unit disc on the screen, square pixels.
struct Shape {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

struct RealSplat {
  double x = 0.0, y = 0.0;    ///< projected centre, image pixels
  double z = 0.0;             ///< depth from the volume's centre, mm
  double s = 0.0;             ///< pixels per mm at that depth
  std::array<double, 4> e{};  ///< emission R, G, B and extinction
  int g = 0;                  ///< grid sheet, 0 nearest
  int i = 0, j = 0;           ///< steps of the outer and the inner loop in it
  std::vector<Shape> shapes;  ///< the circle, then what each technique leaves
  double lambda = 1.0;        ///< the kernel's growth in depth
};

enum class Method { ImageAligned, AxisAligned, XRay, Westover };

struct Given {
  oracle::Symbols symbols;
  int width = 0, height = 0;  ///< image, pixels
  Method method = Method::ImageAligned;
  bool additive = false;                    ///< slabs.opacity
  int xray_sheets = 1;                      ///< xray.sheets
  double xray_exposure = 0.0;               ///< xray.exposure
  double a = 0.0, R = 0.0;                  ///< kernel
  double u = 0.0, D = 0.0;                  ///< mm
  double cx = 0.0, cy = 0.0, cz = 0.0;      ///< spacings divided by u
  double w = 0.0;                           ///< slab width, kernel units
  double o = 0.0;                           ///< opacity_scale
  double L = 0.0;                           ///< densest line of voxels
  std::array<double, 8> scale_at_corner{};  ///< pixels per mm at the corners of the box of voxel centres
  bool shapes = false;                      ///< the view or a technique requires shapes
  double slabs_before = 0.0;                ///< for grown kernels: nearer and
  double slabs_behind = 0.0;                ///< farther than all others
  int grid_sheets = 0;                      ///< voxels along the axis of the slices
  std::vector<RealSplat> splats;            ///< in traversal order
};

/// From the scene's own splats and camera. The order is enumerated here by the page; throws std::runtime_error where
/// the scene's traversal has another one.
Given given_by(const scene::Scene& scene, const cmodel::Config& config);

}  // namespace fastsplat::scene_oracle
