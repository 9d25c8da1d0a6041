// SPDX-License-Identifier: Apache-2.0
#include "driver/tables/index_tables.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "cmodel/numbers/index_set.hpp"
#include "cmodel/numbers/window_geometry.hpp"
#include "cmodel/splat/blit_unit.hpp"
#include "driver/tables/quantise.hpp"
#include "driver/tables/radius_sets.hpp"
#include "driver/tables/tables.hpp"

namespace fastsplat::driver {
namespace {

/// A set's footprint on the centres' grid.
struct Footprint {
  int grid, extent, padded;
  std::int64_t rho;
  double rim;  ///< r K

  Footprint(const cmodel::Config& config, double radius, std::uint32_t support)
      : grid(config.grid()), rho(support), rim(radius * config.grid()) {
    const auto geometry = cmodel::window_geometry(config, support);
    extent = static_cast<int>(geometry.extent);
    padded = static_cast<int>(geometry.padded);
  }
  /// d(m,i), 1/K pixel
  double distance(int phase, int i) const { return static_cast<double>(std::int64_t{i + 1} * grid - phase - rho); }
};

double gaussian(const scene::Kernel& kernel, double u) {
  return std::exp(-kernel.a() * kernel.radius() * kernel.radius() * u);
}

/// g along one axis, [phase][column].
std::vector<std::uint32_t> axis_words(const cmodel::Config& config, const scene::Kernel& kernel, const Footprint& f) {
  const Target word = target(Site::Axis, config);
  std::vector<std::uint32_t> words;
  for (int m = 0; m < f.grid; ++m) {
    for (int i = 0; i < f.padded; ++i) {
      words.push_back(i >= f.extent ? 0 : axis_word(kernel, f.distance(m, i), f.rim, word));
    }
  }
  return words;
}

/// Window phases whose footprints are stored.
std::vector<int> stored(const cmodel::Config& config, std::uint32_t rho) {
  std::vector<int> phases;
  for (int m = 0; m < config.phases; ++m) {
    const cmodel::StoredAxis at = cmodel::stored_axis(config, rho, static_cast<std::uint32_t>(m));
    if (at.step > 0) phases.push_back(m);
  }
  return phases;
}

/// The factor 1 + m t(u,v) by which a picture scales a footprint; 1 without a picture.
class Detail {
 public:
  Detail(const scene::Kernel& kernel, const Footprint& f, const SetPicture& picture)
      : to_kernel_(kernel.radius() / f.rim) {
    if (picture.textures == nullptr || picture.textures->phases().empty()) return;
    phase_ = &picture.textures->phases()[picture.number];
    amplitude_ = picture.textures->amplitude();
  }
  /// `dx`, `dy`: 1/K pixel
  double operator()(double dx, double dy) const {
    return phase_ == nullptr ? 1.0 : 1.0 + amplitude_ * (*phase_)(dx * to_kernel_, dy * to_kernel_);
  }

 private:
  const scene::TexturePhase* phase_ = nullptr;
  double amplitude_ = 0.0, to_kernel_;
};

std::vector<std::uint32_t> footprint_words(const cmodel::Config& config, const scene::Kernel& kernel,
                                           const Footprint& f, const Detail& detail) {
  const Target word = target(Site::Footprint, config);
  const bool all = config.index_symmetry == static_cast<int>(cmodel::IndexSymmetry::Off);
  const auto phases = stored(config, static_cast<std::uint32_t>(f.rho));
  std::vector<std::uint32_t> words;
  words.reserve(static_cast<std::size_t>(cmodel::set_words(config, static_cast<std::uint32_t>(f.rho))));
  for (const int my : phases) {
    for (const int mx : phases) {
      if (!all && mx > my) break;
      for (int j = 0; j < f.padded; ++j) {
        for (int i = 0; i < f.padded; ++i) {
          const double dx = f.distance(mx, i), dy = f.distance(my, j);
          const bool outside = i >= f.extent || j >= f.extent;
          words.push_back(outside ? 0 : footprint_word(kernel, dx * dx + dy * dy, f.rim, word, detail(dx, dy)));
        }
      }
    }
  }
  return words;
}

}  // namespace

std::uint32_t axis_word(const scene::Kernel& kernel, double distance, double rim, const Target& word) {
  const bool outside = std::abs(distance) >= rim;
  return quantise_to<std::uint32_t>(outside ? 0.0 : gaussian(kernel, distance * distance / (rim * rim)), word);
}

std::uint32_t footprint_word(const scene::Kernel& kernel, double squared, double rim, const Target& word,
                             double detail) {
  const bool outside = squared >= rim * rim;
  return quantise_to<std::uint32_t>(outside ? 0.0 : gaussian(kernel, squared / (rim * rim)) * detail, word);
}

Scale scale_of(double v, const cmodel::Config& config) {
  const int h = std::clamp(23 - std::ilogb(v), 0, static_cast<int>(cmodel::kLargestShift));
  return {.c = quantise_to<std::uint32_t>(std::ldexp(v, h), target(Site::Scale, config)),
          .h = static_cast<std::uint32_t>(h)};
}

cmodel::LoadTable set_table(const cmodel::Config& config, const scene::Kernel& kernel, std::uint32_t set, double radius,
                            std::uint32_t base, const SetPicture& picture) {
  using cmodel::IndexKind;
  const std::uint32_t rho = support_radius(radius, config);
  const Footprint f(config, radius, rho);
  cmodel::LoadTable table{.table = cmodel::Table::Rlut, .radius = {.set = set, .rho = rho, .base = base}, .words = {}};
  const double entries = config.radial_entries;
  switch (config.index()) {
    case IndexKind::Linear: {
      const Scale scale = scale_of(entries / std::ldexp(f.rim, config.rlut_guard_bits), config);
      table.words = {scale.c, scale.h};
      break;
    }
    case IndexKind::Squared: {
      const Scale scale = scale_of(entries / (f.rim * f.rim), config);
      table.words = {scale.c, scale.h};
      break;
    }
    case IndexKind::SquaredElliptic: {
      const Scale scale = scale_of(entries / (f.rim * f.rim), config);
      table.words = {scale.c, 0, scale.c, scale.h};
      break;
    }
    case IndexKind::Blit2d:
      table.words = footprint_words(config, kernel, f, Detail(kernel, f, picture));
      break;
    case IndexKind::Separable:
      table.words = axis_words(config, kernel, f);
      break;
    case IndexKind::Rlut:
      return rlut_table(config, set, radius, base);
  }
  return table;
}

}  // namespace fastsplat::driver
