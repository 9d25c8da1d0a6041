// The error of a kind of index's weights against the exact footprint, where splats overlap. The test is a field of
// constant value on a lattice along the pixels, at every offset, and on a turned one.
#pragma once

#include <vector>

#include "cmodel/numbers/config.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::analysis {

/// Of the field's mean, in 1/255.
struct FieldError {
  double largest = 0.0, rms = 0.0, bias = 0.0;
};

/// Splats a voxel apart, each of weight 1 at its centre; the voxel is radius / R pixels. Centres in pixels.
struct Lattice {
  struct Centre {
    double x = 0.0, y = 0.0;
  };
  std::vector<Centre> centres;
  int side = 0;               ///< pixels of the square field that are compared
  int wrapped = 0;            ///< > 0: each centre is a lattice of its own, that many pixels apart: its field is a cell
  double radius = 0.0;        ///< support, pixels
  std::vector<double> exact;  ///< the field of golden's footprint
  double mean = 0.0;          ///< of `exact`
};
/// A lattice along the pixels at 61 x 61 offsets a pixel (61 is prime to every grid). radius / R must be whole.
Lattice aligned_lattice(const scene::Kernel& kernel, int radius);
/// Turned by 0.4 radians, over 64 x 64 pixels.
Lattice turned_lattice(const scene::Kernel& kernel, int radius);

/// The configuration's weights, by the driver's tables and the model's unit, against the exact ones.
FieldError field_error(const cmodel::Config& config, const scene::Kernel& kernel, const Lattice& lattice);

/// Nanoseconds the model's unit takes for all weights of one splat, here and now.
double nanoseconds_per_splat(const cmodel::Config& config, const scene::Kernel& kernel, const Lattice& lattice);

}  // namespace fastsplat::analysis
