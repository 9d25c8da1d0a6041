// SPDX-License-Identifier: Apache-2.0
// The steps of a pixel from sheets of densities to sums of colours: transfer, slope, normal, facing, phong, blend,
// shaded, colour (docs/numerics.md, section 6.2; docs/errors.md, section 1, "Densities"). Numbers are values: a word of
// f fraction bits is a multiple of 2^-f. If all earlier steps are the device's, values are its words.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "analysis/pipeline/real_narrowing.hpp"
#include "analysis/pipeline/step.hpp"
#include "cmodel/numbers/config.hpp"
#include "golden/frame_sweep.hpp"
#include "golden/post_classified.hpp"
#include "golden/sheet_geometry.hpp"
#include "scene/scene.hpp"
#include "scene/sheet_plan.hpp"
#include "scene/transfer_function.hpp"

namespace fastsplat::stages {

/// A pixel of a sheet with its differences. Densities are fractions of the volume's range, 0 at its least value.
struct DensityPixel {
  double density = 0.0;
  /// Right - left, below - above, behind - before; at the picture's edge twice the one-sided difference.
  std::array<double, 3> across{};
  int x = 0, y = 0;  ///< of the image
  int sheet = 0;
};

/// The columns or rows beside one of `size`, and the factor of their difference: at the picture's edge the pixel itself
/// stands for its neighbour, and the difference counts double (N-6.2-9).
struct Beside {
  int before, behind;
  double factor;
};
inline Beside beside(int at, int size) {
  const int before = std::max(at - 1, 0), behind = std::min(at + 1, size - 1);
  return {before, behind, before == at || behind == at ? 2.0 : 1.0};
}

class DensitySteps {
 public:
  /// Keeps references to the scene's parts.
  DensitySteps(const scene::Scene& scene, const cmodel::Config& config, const scene::SlabGrid& slabs);
  DensitySteps(const DensitySteps&) = delete;  // golden's stage keeps a reference to a member
  DensitySteps& operator=(const DensitySteps&) = delete;

  /// R, G, B (premultiplied) and optical depth: the values of a colour sheet there.
  golden::Sums operator()(const DensityPixel& pixel, const Mixture& mixture) const;

  /// Golden itself, float by float: for frames with all steps real and sums in golden's units. Writes pixels begin,
  /// begin+1, ... of row y.
  void golden_row(const golden::SheetWindow& window, int y, int begin, std::span<golden::Sums> pixels) const {
    classified_.row(window, y, begin, pixels);
  }
  /// The most that golden's floats are off the real steps, in a colour's sum over its optical depth.
  double golden_error() const;
  /// A density in golden's units as a fraction of the range.
  double part_of_range(double golden_sum) const { return golden_sum * per_golden_; }

 private:
  friend class DensityRanges;
  using Vector = std::array<double, 3>;  ///< right, down, ahead

  /// A table of linear segments: its words, as values.
  struct Lines {
    std::vector<double> entries;
    std::size_t channels = 1;
    std::size_t segments() const { return entries.size() / channels - 1; }
    /// The value `position` segments from the beginning, clamped to the ends; the fall from the entry before is
    /// rounded.
    double at(double position, const RealNarrowing& fall, std::size_t channel = 0) const;
  };
  struct Visible {
    Vector colour{};
    double tau = 0.0;  ///< 0: invisible
  };
  /// The factor that normalises a gradient, and the gradient's length.
  struct Normal {
    double inverse = 0.0, length = 0.0;
  };
  /// Scales of a sheet's gradients, on either side.
  struct Scales {
    double across = 0.0, along = 0.0;  ///< the larger one is 1
    double per_floor = 0.0;            ///< 1 over the gradient floor, in units of these gradients
  };
  struct Phong {
    double ambient = 0.0, diffuse = 0.0, specular = 0.0;
  };

  void read_light(std::span<const std::uint32_t> words);
  void read_sheets(std::span<const std::uint32_t> words, const scene::SlabGrid& slabs);

  Visible transfer(double density, const Mixture& mixture) const;
  Vector slope(const DensityPixel& pixel, const Mixture& mixture) const;
  /// nullopt if the gradient is 0.
  std::optional<Normal> normal(const Vector& slope, const Mixture& mixture) const;
  /// |n . V|, V the light or the half vector: `real` or `words`, by the side of step facing.
  double facing(const Vector& slope, const Normal& normal, const Vector& real, const Vector& words,
                const Mixture& mixture) const;
  /// Share of shading.
  double blend(double length, int sheet, const Mixture& mixture) const;
  double glint(double facing, const Mixture& mixture) const;

  const scene::Scene& scene_;
  golden::SheetGeometry geometry_;
  scene::Classifier classify_;
  golden::PostClassified classified_;
  double base_, range_, depth_;  ///< the volume's least value; its range; a slab's depth times opacity_scale
  double per_golden_;
  Lines classify_lines_, root_lines_, glint_lines_;
  RealNarrowing colour_fall_, tau_fall_, root_fall_, glint_fall_;
  RealNarrowing across_, along_, tilt_, length_, facing_, matt_, share_, lit_, product_;
  Vector light_{}, half_{}, light_words_{}, half_words_{};
  Phong phong_, phong_words_;
  std::array<double, 4> tilts_{};  ///< TX, DX, TY, DY
  std::vector<Scales> real_, words_;
};

}  // namespace fastsplat::stages
