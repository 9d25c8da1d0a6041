// SPDX-License-Identifier: Apache-2.0
// Ray casting: the reference for all other techniques. For every pixel, extinction and emission along its ray are
// reconstructed from nearby kernels, and the transmittance integral
//     C = Int e(z) exp(-Int_{<z} kappa dz') dz,   A = 1 - exp(-Int kappa dz)
// is evaluated in fine steps. It works in image order with point samples of h; the splatting techniques work in object
// order with integrals of h. They share only the kernel, so that each checks the other.
//
// Depth runs along the view axis. The distance of a kernel from the ray is measured in the plane of constant depth
// through the kernel's centre: the same cylinder support and, in perspective, the same circular footprint as splatting.
//
// Two ways to the same bits. The plain one evaluates every kernel near a ray, then integrates. The fast one proceeds
// along the ray in parts. It takes from the tree only the kernels that reach the part, evaluates four of them side by
// side, and stops once nothing behind can change the pixel (settled_pixels.hpp).
#include <algorithm>
#include <limits>
#include <vector>

#include "golden/bands.hpp"
#include "golden/collect_splats.hpp"
#include "golden/ray_profile.hpp"
#include "golden/render.hpp"
#include "golden/settled_pixels.hpp"
#include "golden/splat/composite.hpp"
#include "golden/splat/projection.hpp"
#include "golden/splat_tree.hpp"

namespace fastsplat::golden {

namespace {

/// splats[k] becomes the old splats[order[k]]. Follows the permutation's cycles: a copy would be the peak of memory.
void sort_in_place(std::vector<scene::Splat>& splats, const std::vector<std::uint32_t>& order) {
  std::vector<bool> placed(splats.size());
  for (std::size_t first = 0; first < order.size(); ++first) {
    if (placed[first]) continue;
    const scene::Splat held = splats[first];
    std::size_t at = first;
    for (; order[at] != first; at = order[at]) {
      splats[at] = splats[order[at]];
      placed[at] = true;
    }
    splats[at] = held;
    placed[at] = true;
  }
}

/// A scene prepared for ray casting.
struct RayScene {
  RayScene(const scene::Scene& scene, int threads)
      : kernel(scene.kernel),
        unit(scene.volume->kernel_unit()),
        radius(scene.kernel.radius()),
        samples(scene.volume->bounding_radius() / unit + radius + 1.0),
        forward(scene.camera.direction()),
        density(cell_density(scene)),
        ray_end(scene.description.ray_end),
        splats(collect_splats(scene, threads)),
        tree(splats),
        bounded(never_brighter_than_opaque(splats)) {
    sort_in_place(splats, tree.order());
  }

  /// Calls take(RayHit) if the ray passes through the splat's kernel.
  template <class Take>
  void hit(const scene::Ray& ray, const scene::Splat& splat, Take&& take) const {
    const glm::dvec3 centre(splat.position);
    const double depth = glm::dot(centre, forward);
    // The distance in the plane of constant depth is never shorter than the distance to the line.
    const glm::dvec3 across = ray.origin + ray.direction * (depth / ray.depth_per_mm) - centre;
    const double rho2 = glm::dot(across, across) / (unit * unit);
    if (rho2 >= radius * radius) return;
    const double peak = kernel.value(rho2, 0.0) * kSampleStep;
    take(RayHit{.amount = {density * splat.emission.x * peak, density * splat.emission.y * peak,
                           density * splat.emission.z * peak, density * splat.extinction * peak},
                .position = samples.position(depth / unit)});
  }

  const scene::Kernel& kernel;
  double unit, radius;  ///< mm; kernel units
  RaySamples samples;
  glm::dvec3 forward;
  double density;
  double ray_end;                    ///< a ray ends where its transmittance is below this
  std::vector<scene::Splat> splats;  ///< in the tree's order, so that its neighbours are adjacent in memory
  SplatTree tree;
  bool bounded;  ///< settled() is applicable
};

/// Whether the ray continues.
bool goes_on(const FrontToBack& pixel, const RayScene& of) { return !(pixel.transmittance < of.ray_end); }

FrontToBack plain_ray(const RayScene& of, const scene::Ray& ray, RayProfile& profile) {
  const double everywhere = std::numeric_limits<double>::infinity();
  of.tree.near_line_between(
      ray.origin, ray.direction, of.radius * of.unit, of.forward, -everywhere, everywhere,
      [&](std::uint32_t place) { of.hit(ray, of.splats[place], [&](const RayHit& hit) { profile.add(hit); }); });
  FrontToBack pixel;
  for (std::size_t j = profile.touched_begin(); j < profile.touched_end() && goes_on(pixel, of); ++j) {
    pixel.add(make_layer(profile[j], scene::SlabOpacity::Exponential));
  }
  profile.clear();
  return pixel;
}

FrontToBack fast_ray(const RayScene& of, const scene::Ray& ray, RayProfile& profile) {
  // Long compared with a kernel, so that most kernels lie in one part; short compared with the hidden part of a ray.
  constexpr std::size_t kPart = 8 * kSamplesPerUnit;
  // A kernel within R of a part's samples reaches it; the rest is a margin for rounding.
  const double reach = of.radius * kSamplesPerUnit + 2.0;
  FrontToBack pixel;
  bool open = true;
  for (std::size_t begin = 0; begin < of.samples.count && open; begin += kPart) {
    const std::size_t end = std::min(begin + kPart, of.samples.count);
    profile.begin_part(begin, end);
    const double low = of.samples.depth(static_cast<double>(begin) - reach) * of.unit;
    const double high = of.samples.depth(static_cast<double>(end) + reach) * of.unit;
    of.tree.near_line_between(ray.origin, ray.direction, of.radius * of.unit, of.forward, low, high,
                              [&](std::uint32_t place) {
                                const scene::Splat& splat = of.splats[place];
                                const double depth = glm::dot(glm::dvec3(splat.position), of.forward);
                                if (depth < low || depth > high) return;
                                of.hit(ray, splat, [&](const RayHit& hit) { profile.add_to_part(hit); });
                              });
    profile.flush();
    for (std::size_t j = profile.touched_begin(); j < profile.touched_end() && open; ++j) {
      pixel.add(make_layer(profile[j], scene::SlabOpacity::Exponential));
      open = goes_on(pixel, of) && !(of.bounded && settled(pixel));
    }
    profile.clear();
  }
  return pixel;
}

}  // namespace

Image ray_cast(const scene::Scene& scene, const RenderOptions& options) {
  const RayScene of(scene, options.threads);
  const auto cast = options.plain ? plain_ray : fast_ray;
  Image image(scene.camera.width(), scene.camera.height());
  const Bands bands{image.height};
  for_each_band(bands, options.threads, options.progress, [&](int band) {
    RayProfile profile(scene.kernel, of.samples);
    const Rows rows = bands.rows(band);
    for (int y = rows.first; y < rows.end; ++y) {
      for (int x = 0; x < image.width; ++x) {
        cast(of, scene.camera.ray(x, y), profile).store(image.pixel(x, y));
      }
    }
  });
  return image;
}

}  // namespace fastsplat::golden
