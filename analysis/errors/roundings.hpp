// SPDX-License-Identifier: Apache-2.0
// How far each step of a configuration can move a value: input of the bound (docs/errors.md, section 3).
#pragma once

#include "analysis/pipeline/chain.hpp"
#include "analysis/pipeline/step.hpp"

namespace fastsplat::analysis {

/// Each is 0 if the step is known, or not the device's. Values, not words.
struct Roundings {
  Roundings(const stages::Chain& chain, const stages::Mixture& known, const stages::Mixture& device);

  double place = 0.0;          ///< of a circle's centre along an axis, pixels
  double ellipse_place = 0.0;  ///< of an ellipse's centre
  bool radius = false;         ///< step radius is open
  double distance = 0.0;       ///< of a circle's squared distance, in radial table entries
  double coefficient = 0.0;    ///< of one of the six coefficients of an ellipse, in radial table entries
  double index = 0.0;          ///< an entry stands for distances up to this away, in radial table entries
  double weight = 0.0;         ///< of an entry of the radial table
  double emission = 0.0;       ///< of a channel of a whole splat
  bool carries = false;        ///< a splat's emission also has the rounding error of the splat before
  double largest_whole = 0.0;  ///< splats saturate here; infinite if they are known
  double depth = 0.0;          ///< of a centre and a boundary together, kernel units
  double phi = 0.0;            ///< of a cumulative weight
  bool shares_known = false;   ///< word by word
  double share = 0.0;          ///< of the part in front of a boundary, per channel
  double last_share = 0.0;     ///< the same behind the splat: 0 if the whole splat is a word
  double largest_share = 0.0;  ///< shares saturate here; infinite if they are known
  double product = 0.0;        ///< half or all of an ulp
  double largest_sum = 0.0;    ///< infinite if sums do not saturate
  double factor = 0.0;         ///< of the slab factor: interpolation, table and rounding
  double slab = 0.0, composite = 0.0;
  double largest_slab = 0.0;   ///< slab colours saturate here; infinite if step slab is not open
  double largest_light = 0.0;  ///< composited colours saturate here
  double freeze = 0.0;         ///< the device's pixels terminate below it
  double pixel = 0.0;
  double largest_pixel = 0.0;
};

}  // namespace fastsplat::analysis
