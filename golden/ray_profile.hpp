// The fields along one ray: emission and extinction of the kernels nearby, point-sampled along the view axis.
#pragma once

#include <cstddef>
#include <vector>

#include "golden/splat/projected_splat.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::golden {

/// Samples per kernel unit. Errors at this step (measured: at most 2.4e-6 of full scale for a=2, docs/golden.md):
/// - a step's own self-dimming is exact for a constant field: error of second order, < 1e-5 at optical depth 2 per
/// unit;
/// - the sum of a Gaussian's samples is its integral to 2 exp(-(pi/step)^2/a), nothing; the cut at R leaves at most
///   exp(-a R^2) / samples of the peak, 1e-5 for a=2, R=2.
inline constexpr int kSamplesPerUnit = 32;
inline constexpr double kSampleStep = 1.0 / kSamplesPerUnit;

/// Samples of a ray. Sample j lies at depth (first + j + 1/2) steps.
struct RaySamples {
  double first = 0.0;  ///< depth of the first sample's near end, in steps
  std::size_t count = 0;

  /// So many that depths up to half_depth (kernel units) on either side of the centre have one.
  explicit RaySamples(double half_depth);
  /// Where depth z (kernel units) lies among the samples: j for sample j.
  double position(double z) const { return z * kSamplesPerUnit - first - 0.5; }
  double depth(double position) const { return (position + first + 0.5) * kSampleStep; }
};

/// One kernel on a ray: what it adds at its centre's depth, times the step, and where that is.
struct RayHit {
  Sums amount{};          ///< emission and extinction
  double position = 0.0;  ///< RaySamples::position of the centre, which lies among the samples
};

/// Emission (RGB) and extinction of each sample, times the step. A hit adds to sample j
///
///     amount * exp(-a d^2),   d = its distance in depth from the centre < R
///
/// It proceeds outwards from the centre, towards the eye and away from it, with a recurrence for exp(-a d^2): the ratio
/// of neighbours shrinks by the constant factor exp(-2 a step^2).
class RayProfile {
 public:
  RayProfile(const scene::Kernel& kernel, const RaySamples& samples);

  /// Adds a hit as defined above.
  void add(const RayHit& hit);

  /// The same, bit for bit, for samples [begin, end) only and with vectors. Hits are kept until four can be walked side
  /// by side; each sample still gets them in their order of arrival. Call flush() before reading sums.
  void begin_part(std::size_t begin, std::size_t end);
  void add_to_part(const RayHit& hit);
  void flush();

  /// Samples [touched_begin, touched_end) may hold something; all others are 0.
  std::size_t touched_begin() const { return begin_; }
  std::size_t touched_end() const { return end_; }
  const Sums& operator[](std::size_t sample) const { return samples_[sample]; }
  /// Forgets what it holds.
  void clear();

 private:
  void walk(const Sums& amount, std::ptrdiff_t sample, std::ptrdiff_t direction, double distance);

  double a_, radius_, shrink_;
  std::vector<Sums> samples_;
  std::size_t begin_, end_;  ///< touched
  std::size_t part_begin_ = 0, part_end_ = 0;
  std::vector<RayHit> waiting_;  ///< of the part
};

}  // namespace fastsplat::golden
