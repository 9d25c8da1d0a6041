// SPDX-License-Identifier: Apache-2.0
#include "tests/pipeline/oracle/splats.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include "scene/real_splat.hpp"
#include "scene/splats.hpp"
#include "tests/pipeline/oracle/tables.hpp"

namespace fastsplat::stages::oracle {

namespace {

bool carries(const scene::Scene& scene, const cmodel::Config& config) {
  const auto carry = static_cast<cmodel::Carry>(config.rounding_carry);
  return carry == cmodel::Carry::On ||
         (carry == cmodel::Carry::XRay && scene.description.method == scene::Method::XRay);
}

/// N-8-62.
struct Sheets {
  bool sliced = false, of_grid = false;
  int count = 1;
  double first = 0.0, width = 1.0;

  Sheets(const scene::Scene& scene, int slices) {
    const volume::Volume& volume = *scene.volume;
    const glm::dvec3 diagonal = glm::dvec3(volume.dims - 1) * volume.spacing;
    // N-8-6.
    const double d = 0.5 * std::sqrt(diagonal.x * diagonal.x + diagonal.y * diagonal.y + diagonal.z * diagonal.z);
    const double w = scene.description.slab_width;
    const double half = std::ceil((d / volume.kernel_unit() + scene.kernel.radius()) / w);
    const int asked = scene.description.xray_sheets;
    switch (scene.description.method) {
      case scene::Method::ImageAligned:
        *this = Sheets(true, false, static_cast<int>(2.0 * half), -half * w, w);
        break;
      case scene::Method::XRay:
        if (asked > 1) *this = Sheets(true, false, asked, -half * w, 2.0 * half * w / asked);
        break;
      case scene::Method::Westover:
        break;
      default:
        *this = Sheets(false, true, slices, 0.0, 1.0);
    }
  }

 private:
  Sheets(bool in_slabs, bool by_slice, int n, double nearest, double thick)
      : sliced(in_slabs), of_grid(by_slice), count(n), first(nearest), width(thick) {}
};

/// Steps of one frame.
class Steps {
 public:
  Steps(const scene::Scene& scene, const cmodel::Config& config, const Mixture& mixture, const Sheets& sheets,
        int columns)
      : scene_(scene),
        config_(config),
        mixture_(mixture),
        sheets_(sheets),
        columns_(columns),
        sets_(scene, config),
        shown_(radial_table(scene.kernel.a(), scene.kernel.radius(), config), config) {
    const double a = scene.kernel.a(), r = scene.kernel.radius();
    const double u = scene.volume->kernel_unit();
    const glm::dvec3 cell = scene.volume->spacing / u;
    const double peak = a / (std::numbers::pi * (1.0 - std::exp(-a * r * r)));
    const double exposure = scene.description.method == scene::Method::XRay ? scene.xray_scale : 1.0;
    amplitude_ = peak * cell.x * cell.y * cell.z * exposure;
    if (scene.description.classify == scene::ClassifyOrder::Pre) return;
    const volume::Volume& volume = *scene.volume;
    for (int z = 0; z < volume.dims.z; ++z) {
      for (int y = 0; y < volume.dims.y; ++y) {
        for (int x = 0; x < volume.dims.x; ++x) {
          const glm::vec3 at(volume.position(x, y, z));
          // N-8-90
          above_[{at.x, at.y, at.z}] = static_cast<double>(volume.at(x, y, z) - volume.min);
        }
      }
    }
  }

  Splat operator()(const scene::Splat& voxel, std::uint32_t line) {
    scene::RealSplat real = scene::real_splat(scene_, voxel);
    if (!above_.empty() && !mixture_.device(Step::Emission)) {
      const double range = static_cast<double>(scene_.volume->max) - scene_.volume->min;
      real.material[3] =
          above_.at({voxel.position.x, voxel.position.y, voxel.position.z}) / (range * scene_.description.slab_width);
    }
    Splat splat;
    splat.x = place(real.at.x, splat.closeness);
    splat.y = place(real.at.y, splat.closeness);
    const double own = scene_.kernel.radius() * scene_.volume->kernel_unit() * real.at.scale;
    splat.radius = mixture_.device(Step::Radius) ? sets_.of(own, splat.closeness) : own;
    const Values v = emitted(real.material, own / splat.radius, line, voxel.sheet, splat.closeness);
    splat.shares.assign(static_cast<std::size_t>(sheets_.count), Values{});
    splat.position = voxel.position;
    if (sheets_.sliced) {
      const double start = narrow(mixture_, Step::Depth, real.depth, splat.closeness) - scene_.kernel.radius();
      splat.first =
          static_cast<int>(cut(std::floor((start - sheets_.first) / sheets_.width), 0.0, sheets_.count - 1.0));
      while (mixture_.floats(Step::Depth) && splat.first > 0 && phi(splat.first, real.depth, splat.closeness) > 0.0)
        --splat.first;
      slice(real.depth, v, splat);
    } else {
      const double most = largest(config_.colour_int_bits, config_.colour_frac_bits);
      splat.first = sheets_.of_grid ? real.sheet : 0;
      Values& share = splat.shares[static_cast<std::size_t>(splat.first)];
      for (std::size_t c = 0; c < 4; ++c) share[c] = mixture_.device(Step::Share) ? std::min(v[c], most) : v[c];
    }
    return splat;
  }

 private:
  /// N-8-36.
  double place(double x, Closeness& closeness) const {
    const int pf = config_.position_frac_bits, kl = grid_bits(config_);
    const bool snap_rounds = kl < pf && config_.rounding_snap == static_cast<int>(cmodel::Rounding::RND);
    if (!mixture_.tile_centres()) x = narrow(mixture_, Step::Position, x, closeness);
    if (mixture_.device(Step::Position)) x = snap_rounds ? trn(x, pf, closeness) : rnd(x, pf, closeness);
    if (mixture_.device(Step::Snap)) x = round_by(config_.rounding_snap, x, kl, closeness);
    return x;
  }

  Values emitted(const Values& e, double ratio, std::uint32_t line, int slice, Closeness& closeness) {
    const double f = amplitude_ * ratio * ratio;
    const int cf = config_.colour_frac_bits;
    Values v{};
    for (std::size_t c = 0; c < 4; ++c) v[c] = e[c] * f;
    for (double& value : v) value = narrow(mixture_, Step::Emission, value, closeness);
    if (!mixture_.device(Step::Emission)) return v;
    const double most = std::ldexp(1.0, cf + 4) - 1.0;
    if (!carries(scene_, config_)) {
      for (double& value : v) value = std::min(rnd(value, cf, closeness), std::ldexp(most, -cf));
      return v;
    }
    const std::uint32_t i = line / static_cast<std::uint32_t>(columns_),
                        j = line % static_cast<std::uint32_t>(columns_);
    // N-8-58, N-8-59, N-8-61.
    const double shift = ((32768 + 49472ULL * i + 37345ULL * j) % 65536) / 65536.0 - 0.5;
    Rest& rest = rests_[line];
    const bool neighbour = rest.count > 0 && rest.slice + 1 == slice;
    if (!neighbour) rest = Rest{{0.5, 0.5, 0.5, 0.5}, {}, slice, 0};
    rest.slice = slice, ++rest.count;
    for (std::size_t c = 0; rest.count == 3 && c < 4; ++c) rest.of[c] += shift;
    for (std::size_t c = 0; c < 4; ++c) {
      const double t = std::ldexp(v[c], cf) + rest.of[c];
      const double whole = t > 0.0 ? trn(t, 0, rest.closeness) : 0.0;
      const double word = std::min(whole, most);
      rest.of[c] = whole > most ? 0.0 : t - shown_(word);
      v[c] = std::ldexp(word, -cf);
    }
    closeness |= rest.closeness;  // and so for all later splats in this run
    return v;
  }

  /// Share of the kernel in front of `distance` from its middle (N-8-64).
  double kernel_share(double distance) const {
    const double a = scene_.kernel.a(), r = scene_.kernel.radius();
    if (distance <= -r) return 0.0;
    if (distance >= r) return 1.0;
    return (1.0 + std::erf(std::sqrt(a) * distance) / std::erf(std::sqrt(a) * r)) / 2.0;
  }

  double phi(int s, double depth, Closeness& closeness) const {
    if (s == 0) return 0.0;  // N-8-66
    if (s == sheets_.count) return 1.0;
    const int zf = config_.slice_phase_bits;
    const auto depth_of = [&](double value) { return narrow(mixture_, Step::Depth, value, closeness); };
    double z = depth_of(depth), boundary = depth_of(sheets_.first + s * sheets_.width);
    if (mixture_.device(Step::Depth)) {
      z = rnd(depth - sheets_.first, zf, closeness);  // N-8-65
      boundary = rnd(s * sheets_.width, zf, closeness);
    }
    const double share = narrow(mixture_, Step::Phi, kernel_share(depth_of(boundary - z)), closeness);
    return mixture_.device(Step::Phi) ? rnd(share, config_.slice_frac_bits, closeness) : share;
  }

  void slice(double depth, const Values& v, Splat& splat) const {
    const int cf = config_.colour_frac_bits;
    for (int s = 0; s < sheets_.count; ++s) {
      const double near = phi(s, depth, splat.closeness), far = phi(s + 1, depth, splat.closeness);
      Values& share = splat.shares[static_cast<std::size_t>(s)];
      for (std::size_t c = 0; c < 4; ++c) {
        if (mixture_.device(Step::Share)) {
          const double h = rnd(v[c] * far, cf, splat.closeness) - rnd(v[c] * near, cf, splat.closeness);
          share[c] = std::min(h, largest(config_.colour_int_bits, cf));
        } else {
          const double part = narrow(mixture_, Step::Share, far - near, splat.closeness);
          share[c] = narrow(mixture_, Step::Share, v[c] * part, splat.closeness);
        }
      }
    }
  }

  struct Rest {
    Values of;
    Closeness closeness;
    int slice = 0, count = 0;  ///< of the last splat; splats of the run so far
  };

  const scene::Scene& scene_;
  const cmodel::Config& config_;
  const Mixture& mixture_;
  const Sheets& sheets_;
  int columns_;
  RadiusSets sets_;
  Shown shown_;
  double amplitude_ = 0.0;
  std::map<std::uint32_t, Rest> rests_;
  std::map<std::array<float, 3>, double> above_;  ///< of densities: a voxel's value less the least, by its place
};

}  // namespace

std::vector<Splat> splats_of(const scene::Scene& scene, const cmodel::Config& config, const Mixture& mixture) {
  const bool densities = scene.description.classify == scene::ClassifyOrder::Post;
  const scene::Traversal traversal(scene, densities ? scene::SplatKind::Densities : scene::SplatKind::Colours);
  const Sheets sheets(scene, traversal.slices());
  Steps steps(scene, config, mixture, sheets, traversal.columns());
  std::vector<Splat> all;
  traversal.visit(traversal.all(), [&](std::span<const scene::Splat> row, std::span<const std::uint32_t> lines) {
    for (std::size_t i = 0; i < row.size(); ++i) all.push_back(steps(row[i], lines[i]));
  });
  const auto place = [&](const Splat& splat) {
    const glm::vec3 at = densities ? splat.position : glm::vec3(0.0F);
    return std::tuple(splat.first, at.z, at.y, at.x);
  };
  std::stable_sort(all.begin(), all.end(), [&](const Splat& a, const Splat& b) { return place(a) < place(b); });
  return all;
}

}  // namespace fastsplat::stages::oracle
