// SPDX-License-Identifier: Apache-2.0
// The bound of a splat's shares in the layers that it reaches (docs/errors.md, section 3).
#pragma once

#include <vector>

#include "analysis/errors/roundings.hpp"
#include "analysis/pipeline/chain.hpp"

namespace fastsplat::analysis {

/// A splat's shares in layers first .. first + size - 1, and the largest error of each part.
struct Sliced {
  int first = 0;
  golden::Sums whole{};             ///< the known whole splat
  std::vector<golden::Sums> value;  ///< known share
  std::vector<double> part;         ///< fraction of the kernel
  std::vector<double> cut;          ///< error of the fraction at boundary i, in front of layer i; one more than layers
  std::vector<double> word;         ///< error of a channel's word there
  golden::Sums whole_error{};       ///< error of the whole splat
  std::vector<golden::Sums> share_error;  ///< error of a share, in total
  std::vector<golden::Sums> over;         ///< its part that saturation adds
  std::size_t size() const { return value.size(); }
};

class SliceBound {
 public:
  /// Keeps references.
  SliceBound(const stages::Chain& chain, const stages::Mixture& known, const Roundings& roundings)
      : chain_(chain), known_(known), r_(roundings) {}

  /// The first sheet that the splat may reach on either side. `shape`: null in a frame of circles.
  int first(const stages::StagedSplat& splat, const stages::StagedShape* shape) const;
  /// `ratio`: of the device's values to the known ones. Its words contain this factor. Here weights contain all of it,
  /// so errors of words are divided by it.
  const Sliced& operator()(const stages::StagedSplat& splat, const stages::StagedShape* shape, double ratio);

 private:
  /// A boundary seen from a splat, in units of the kernel's own depth.
  struct Boundary {
    double near = 0.0;  ///< the least distance from its centre
    double error = 0.0;
    bool inside = false;  ///< may cut the kernel
  };
  Boundary boundary(const stages::StagedSplat& splat, const stages::Growth& growth, int at) const;

  const stages::Chain& chain_;
  const stages::Mixture& known_;
  const Roundings& r_;
  Sliced sliced_;
};

}  // namespace fastsplat::analysis
