// SPDX-License-Identifier: Apache-2.0
// Emission and extinction of nearby kernels along one ray, point-sampled along the view axis.
#pragma once

#include <cstddef>
#include <vector>

#include "golden/splat/projected_splat.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::golden {

/// Samples per kernel unit. Errors at this step (measured: at most 2.4e-6 of full scale for a=2, docs/golden.md):
/// - A step's self-dimming is exact for a constant field: error of second order, < 1e-5 at optical depth 2 per unit.
/// - A Gaussian's samples add up to its integral within 2 exp(-(pi/step)^2/a), which is negligible.
/// - The cut at R leaves at most exp(-a R^2) / samples of the peak, 1e-5 for a=2, R=2.
inline constexpr int kSamplesPerUnit = 32;
inline constexpr double kSampleStep = 1.0 / kSamplesPerUnit;

/// Samples of a ray. Sample j lies at depth (first + j + 1/2) steps.
struct RaySamples {
  double first = 0.0;  ///< depth of the first sample's near end, in steps
  std::size_t count = 0;

  /// Covers depths up to half_depth (kernel units) on either side of the centre.
  explicit RaySamples(double half_depth);
  /// Position of depth z (kernel units) among the samples: j at sample j.
  double position(double z) const { return z * kSamplesPerUnit - first - 0.5; }
  double depth(double position) const { return (position + first + 0.5) * kSampleStep; }
};

/// One kernel on a ray: its contribution at its centre's depth, times the step, and its position.
struct RayHit {
  Sums amount{};          ///< emission and extinction
  double position = 0.0;  ///< RaySamples::position of the centre, which lies among the samples
};

/// Emission (RGB) and extinction of each sample, times the step. A hit adds to sample j
///
///     amount * exp(-a d^2),   d = its distance in depth from the centre < R
///
/// Values are computed outwards from the centre, towards the eye and away from it, with a recurrence for exp(-a d^2):
/// the ratio of neighbours shrinks by the constant factor exp(-2 a step^2).
class RayProfile {
 public:
  RayProfile(const scene::Kernel& kernel, const RaySamples& samples);

  /// Adds a hit as defined above.
  void add(const RayHit& hit);

  /// The same, bit for bit, for samples [begin, end) only and with vectors. Hits are buffered until four can be
  /// evaluated side by side; each sample still gets them in order of arrival. Call flush() before reading sums.
  void begin_part(std::size_t begin, std::size_t end);
  void add_to_part(const RayHit& hit);
  void flush();

  /// All samples outside [touched_begin, touched_end) are 0.
  std::size_t touched_begin() const { return begin_; }
  std::size_t touched_end() const { return end_; }
  const Sums& operator[](std::size_t sample) const { return samples_[sample]; }
  /// Sets all samples to 0.
  void clear();

 private:
  void walk(const Sums& amount, std::ptrdiff_t sample, std::ptrdiff_t direction, double distance);

  double a_, radius_, shrink_;
  std::vector<Sums> samples_;
  std::size_t begin_, end_;  ///< touched samples
  std::size_t part_begin_ = 0, part_end_ = 0;
  std::vector<RayHit> waiting_;  ///< buffered hits of the part
};

}  // namespace fastsplat::golden
