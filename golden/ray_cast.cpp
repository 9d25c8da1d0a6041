// Ray casting: the reference of references. For every pixel the fields of extinction and emission are reconstructed
// along its ray from the kernels nearby, and the transmittance integral
//     C = Int e(z) exp(-Int_{<z} kappa dz') dz,   A = 1 - exp(-Int kappa dz)
// is taken in fine steps. Image order and point samples of h, where the splatting techniques work in object order with
// integrals of h: nothing is shared but the kernel, so that each checks the other.
//
// Depth runs along the view axis, and the distance of a kernel from the ray is measured in the plane of constant depth
// through the kernel's centre: the same cylinder support and, in perspective, the same circular footprint as splatting.
#include <algorithm>
#include <cmath>
#include <vector>

#include "golden/bands.hpp"
#include "golden/collect_splats.hpp"
#include "golden/render.hpp"
#include "golden/splat/composite.hpp"
#include "golden/splat/projection.hpp"
#include "golden/splat_tree.hpp"

namespace fastsplat::golden {

namespace {

/// Samples per kernel unit. Errors at this step (measured: at most 2.4e-6 of full scale for a=2, docs/golden.md):
/// - a step's own self-dimming is exact for a constant field: error of second order, < 1e-5 at optical depth 2 per
/// unit;
/// - the sum of a Gaussian's samples is its integral to 2 exp(-(pi/step)^2/a), nothing; the cut at R leaves at most
///   exp(-a R^2) / samples of the peak, 1e-5 for a=2, R=2.
constexpr int kSamplesPerUnit = 32;

/// Fields along one ray: per sample emission (RGB) and extinction, times the step.
class RayProfile {
 public:
  RayProfile(const scene::Kernel& kernel, double half_depth)
      : kernel_(kernel),
        first_(-std::ceil(half_depth * kSamplesPerUnit)),
        samples_(static_cast<std::size_t>(-2.0 * first_)),
        begin_(samples_.size()),
        end_(0),
        shrink_(std::exp(-2.0 * kernel.a() * kStep * kStep)) {}

  /// Adds value * h at squared distance rho2 (kernel units) from a kernel centred at depth z.
  void add(const Sums& value, double rho2, double z) {
    // Sample j lies at depth (first_ + j + 1/2) steps; `nearest` is the last one not behind the centre.
    const double position = z * kSamplesPerUnit - first_ - 0.5;
    const double nearest = std::floor(position);
    const double offset = (nearest - position) * kStep;  // depth of that sample relative to the centre, in (-step, 0]
    const double radius = kernel_.radius();
    const double peak = kernel_.value(rho2, 0.0) * kStep;
    const Sums amount = {value[0] * peak, value[1] * peak, value[2] * peak, value[3] * peak};

    // Outwards from the centre, towards the eye and away from it, with a recurrence for exp(-a d^2):
    // the ratio of neighbours shrinks by the constant factor exp(-2 a step^2).
    const auto nearer = static_cast<std::ptrdiff_t>(nearest);
    walk(amount, nearer, -1, -offset, radius);
    walk(amount, nearer + 1, +1, kStep + offset, radius);
  }

  /// Integrates front to back and forgets the fields.
  FrontToBack integrate() {
    FrontToBack pixel;
    for (std::size_t j = begin_; j < end_; ++j) {
      pixel.add(make_layer(samples_[j], scene::SlabOpacity::Exponential));
      samples_[j] = {};
    }
    begin_ = samples_.size();
    end_ = 0;
    return pixel;
  }

 private:
  static constexpr double kStep = 1.0 / kSamplesPerUnit;

  void walk(const Sums& amount, std::ptrdiff_t sample, std::ptrdiff_t direction, double distance, double radius) {
    double value = std::exp(-kernel_.a() * distance * distance);
    double ratio = std::exp(-kernel_.a() * kStep * (2.0 * distance + kStep));
    for (; distance < radius; distance += kStep, sample += direction) {
      if (sample < 0 || sample >= static_cast<std::ptrdiff_t>(samples_.size())) return;
      Sums& sums = samples_[static_cast<std::size_t>(sample)];
      for (int c = 0; c < 4; ++c) sums[c] += amount[c] * value;
      begin_ = std::min(begin_, static_cast<std::size_t>(sample));
      end_ = std::max(end_, static_cast<std::size_t>(sample) + 1);
      value *= ratio;
      ratio *= shrink_;
    }
  }

  const scene::Kernel& kernel_;
  double first_;  ///< depth of the first sample's near end, in steps
  std::vector<Sums> samples_;
  std::size_t begin_, end_;  ///< the samples touched
  double shrink_;
};

}  // namespace

Image ray_cast(const scene::Scene& scene, const RenderOptions& options) {
  const double unit = scene.volume->kernel_unit();
  const double radius = scene.kernel.radius();
  const double half_depth = scene.volume->bounding_radius() / unit + radius + 1.0;
  const double density = cell_density(scene);
  const glm::dvec3 forward = scene.camera.direction();
  const std::vector<scene::Splat> splats = collect_splats(scene, options.threads);
  const SplatTree tree(splats);

  Image image(scene.camera.width(), scene.camera.height());
  const Bands bands{image.height};
  for_each_band(bands, options.threads, options.progress, [&](int band) {
    RayProfile profile(scene.kernel, half_depth);
    const Rows rows = bands.rows(band);
    for (int y = rows.first; y < rows.end; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const scene::Ray ray = scene.camera.ray(x, y);
        // The distance in the plane of constant depth is never shorter than the distance to the line.
        tree.near_line(ray.origin, ray.direction, radius * unit, [&](std::uint32_t i) {
          const scene::Splat& splat = splats[i];
          const glm::dvec3 centre(splat.position);
          const double depth = glm::dot(centre, forward);
          const glm::dvec3 across = ray.origin + ray.direction * (depth / ray.depth_per_mm) - centre;
          const double rho2 = glm::dot(across, across) / (unit * unit);
          if (rho2 >= radius * radius) return;
          const Sums value = {density * splat.emission.x, density * splat.emission.y, density * splat.emission.z,
                              density * splat.extinction};
          profile.add(value, rho2, depth / unit);
        });
        profile.integrate().store(image.pixel(x, y));
      }
    }
  });
  return image;
}

}  // namespace fastsplat::golden
