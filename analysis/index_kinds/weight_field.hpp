// SPDX-License-Identifier: Apache-2.0
// The error of an index kind's weights against the exact footprint where splats overlap. The test is a constant field
// on a lattice along the pixels, at every offset, and on a turned lattice.
#pragma once

#include <vector>

#include "cmodel/numbers/config.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::analysis {

/// Relative to the field's mean, in 1/255.
struct FieldError {
  double largest = 0.0, rms = 0.0, bias = 0.0;
};

/// Splats a voxel apart, each of weight 1 at its centre; the voxel is radius / R pixels. Centres in pixels.
struct Lattice {
  struct Centre {
    double x = 0.0, y = 0.0;
  };
  std::vector<Centre> centres;
  int side = 0;     ///< pixels of the square field that are compared
  int wrapped = 0;  ///< > 0: each centre is a lattice of its own with this pitch in pixels, and its field is one cell
  double radius = 0.0;        ///< support, pixels
  std::vector<double> exact;  ///< the field of golden's footprint
  double mean = 0.0;          ///< of `exact`
};
/// A lattice along the pixels at 61 x 61 offsets a pixel (61 is prime to every grid). radius / R must be whole.
Lattice aligned_lattice(const scene::Kernel& kernel, int radius);
/// Turned by 0.4 radians, over 64 x 64 pixels.
Lattice turned_lattice(const scene::Kernel& kernel, int radius);

/// The error of the configuration's weights, by the driver's tables and the model's unit.
FieldError field_error(const cmodel::Config& config, const scene::Kernel& kernel, const Lattice& lattice);

/// Nanoseconds that the model's unit takes for all weights of one splat, measured now.
double nanoseconds_per_splat(const cmodel::Config& config, const scene::Kernel& kernel, const Lattice& lattice);

}  // namespace fastsplat::analysis
