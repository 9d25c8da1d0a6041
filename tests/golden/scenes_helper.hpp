// SPDX-License-Identifier: Apache-2.0
// Small scenes with known contents, and measures on images, for the tests of the golden renderers.
#pragma once

#include <string>
#include <vector>

#include "golden/render.hpp"
#include "scene/scene.hpp"
#include "scene/splats.hpp"

namespace fastsplat::golden::testing {

/// The contents of a test scene: a lattice of voxels of equal opacity, graded in colour along x.
struct Lattice {
  glm::ivec3 dims{16};
  glm::dvec3 spacing{1.0};
  double optical_depth = 0.9;  ///< extinction per kernel unit
  double a = 2.0, radius = 2.0;
  double azimuth = 0.0, elevation = 0.0, roll = 0.0;
  scene::Projection projection = scene::Projection::Orthographic;
  double fov = 30.0;
  double pixels_per_mm = 4.0;  ///< at the centre of the volume
  int width = 128, height = 128;
  double slab_width = 1.0;
  scene::SlabOpacity slab_opacity = scene::SlabOpacity::Exponential;
  int xray_sheets = 1;
};

scene::Scene make_scene(const Lattice& lattice);

/// A scene of the lattice's extent without any material.
scene::Scene make_empty_scene(const Lattice& lattice);

/// `count` splats at random places within the lattice's box, of random colour and extinction up to `optical_depth`.
std::vector<scene::Splat> random_splats(const scene::Scene& scene, int count, double optical_depth, unsigned seed);

/// Renders these splats by the technique of the scene's method.
Image render_splats(scene::Method method, const scene::Scene& scene, const std::vector<scene::Splat>& splats,
                    int threads = 0);

/// Largest |a-b| over all channels. The images must have the same size.
double max_difference(const Image& a, const Image& b);
/// Root mean square of a-b over the channels of those pixels where either image has opacity.
double rms_difference(const Image& a, const Image& b);
/// Sum of one channel over all pixels.
double channel_sum(const Image& image, int channel);
/// Sum, centre and second moments of a channel, as if each pixel were a point, pixels.
struct Moments {
  double sum = 0.0;
  double x = 0.0, y = 0.0;
  double xx = 0.0, xy = 0.0, yy = 0.0;
};
Moments moments(const Image& image, int channel);
/// Bound on the relative difference between the sum of a footprint's pixels and its integral. It has two parts:
/// aliasing of the endless Gaussian, and the step at the edge, exp(-aR^2) of the peak, on the pixels that the edge
/// (length 2 pi R s) crosses.
double sampling_bound(double a, double radius, double pixels_per_unit);
/// Largest opacity.
double max_opacity(const Image& image);

/// Slope of log(error) over log(width), least squares.
double fitted_order(const std::vector<double>& widths, const std::vector<double>& errors);

/// Prints "[figure] name = value (limit)" and records it as a property of the running test.
void figure(const std::string& name, double value, const char* limit);

}  // namespace fastsplat::golden::testing
