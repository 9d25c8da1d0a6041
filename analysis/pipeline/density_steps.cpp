// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/density_steps.hpp"

#include <algorithm>
#include <cmath>

#include "cmodel/classify/classify_tables.hpp"
#include "driver/tables/density_tables.hpp"
#include "scene/shading.hpp"

namespace fastsplat::stages {
namespace {

namespace words = cmodel::classify;

/// Rounds to nearest, halves up, and saturates, as section 6.2 always does.
RealNarrowing nearest(const cmodel::Format& to) {
  return RealNarrowing({cmodel::Rounding::RND, cmodel::Overflow::SAT, to.frac_bits, to});
}
/// Narrows the fall from a table entry with `frac_bits` fraction bits.
RealNarrowing fall(int frac_bits) { return nearest(cmodel::signed_format(8, frac_bits)); }

double value_of(std::uint32_t word, int frac_bits) {
  return std::ldexp(static_cast<double>(static_cast<std::int32_t>(word)), -frac_bits);
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b, const RoundToFloat& narrow) {
  return narrow(narrow(narrow(a[0] * b[0]) + narrow(a[1] * b[1])) + narrow(a[2] * b[2]));
}

}  // namespace

DensitySteps::DensitySteps(const scene::Scene& scene, const cmodel::Config& config, const scene::SlabGrid& slabs)
    : scene_(scene),
      geometry_(scene),
      classify_(scene.transfer_function, *scene.volume),
      classified_(scene, geometry_, scene.volume->min, {}),
      base_(scene.volume->min),
      range_(static_cast<double>(scene.volume->max) - base_),
      depth_(scene.description.opacity_scale * scene.description.slab_width),
      per_golden_(1.0 / (range_ * scene.description.slab_width)),
      colour_fall_(fall(words::kColour)),
      tau_fall_(fall(config.sheet_frac_bits)),
      root_fall_(fall(words::kRoot)),
      glint_fall_(fall(words::kPhong)),
      across_(nearest(cmodel::signed_format(4, words::kSlope))),
      along_(across_),
      tilt_(nearest(cmodel::signed_format(4, words::kScale))),
      length_(nearest(cmodel::unsigned_format(5, words::kLength))),
      facing_(nearest(cmodel::unit_format(words::kLight))),
      matt_(nearest(cmodel::unsigned_format(5, words::kPhong))),
      share_(nearest(cmodel::unit_format(words::kShare))),
      lit_(nearest(cmodel::unit_format(words::kLit))),
      product_(nearest(config.sheet_format())) {
  for (const cmodel::LoadTable& table : driver::density_tables(config, scene, slabs)) {
    switch (table.table) {
      case cmodel::Table::Classify:
        classify_lines_.channels = 4;
        for (std::size_t i = 0; i < table.words.size(); ++i)
          classify_lines_.entries.push_back(
              value_of(table.words[i], i % 4 == 3 ? config.sheet_frac_bits : words::kColour));
        break;
      case cmodel::Table::Root:
        for (const std::uint32_t word : table.words) root_lines_.entries.push_back(value_of(word, words::kRoot));
        break;
      case cmodel::Table::Glint:
        for (const std::uint32_t word : table.words) glint_lines_.entries.push_back(value_of(word, words::kPhong));
        break;
      case cmodel::Table::Lighting:
        read_light(table.words);
        break;
      default:
        read_sheets(table.words, slabs);
    }
  }
}

void DensitySteps::read_light(std::span<const std::uint32_t> table) {
  const scene::Camera& camera = scene_.camera;
  const scene::Shader shade(scene_.shading, camera, *scene_.volume);
  const auto in_view = [&](const glm::dvec3& v) {
    return Vector{glm::dot(v, camera.right()), glm::dot(v, camera.down()), glm::dot(v, camera.direction())};
  };
  light_ = in_view(glm::dvec3(shade.light()));
  half_ = in_view(glm::dvec3(shade.half()));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    light_words_[axis] = value_of(table[words::kVectors + axis], words::kLight);
    half_words_[axis] = value_of(table[words::kVectors + 3 + axis], words::kLight);
  }
  phong_ = {scene_.shading.ambient, scene_.shading.diffuse, scene_.shading.specular};
  const auto factor = [&](std::size_t at) { return value_of(table[at], words::kPhong); };
  phong_words_ = {factor(words::kAmbient), factor(words::kDiffuse), factor(words::kSpecular)};
  for (std::size_t i = 0; i < tilts_.size(); ++i) tilts_[i] = value_of(table[words::kTilts + i], words::kTilt);
}

void DensitySteps::read_sheets(std::span<const std::uint32_t> table, const scene::SlabGrid& slabs) {
  const double floor = driver::gradient_floor(scene_), along = 1.0 / (2.0 * slabs.width);
  for (int s = 0; s < slabs.count; ++s) {
    const double across = geometry_.pixels_per_unit(s) / 2.0, most = std::max(across, along);
    real_.push_back({across / most, along / most, floor > 0.0 ? most / floor : 0.0});
    const std::uint32_t *const both = &table[words::kSheetWords * static_cast<std::size_t>(s)], scales = both[0];
    words_.push_back({value_of(scales & 0xFFFFU, words::kScale), value_of(scales >> 16, words::kScale),
                      std::ldexp(static_cast<double>(both[1]), -words::kFloor)});
  }
}

// In units of 2^-24, a float's rounding: components of a gradient 1, its length 4. A share of shading has 2 (4 + 2) =
// 12, as lengths are up to twice the floor. A normal has 6, a cosine 10; the matt part has the cosine's times diffuse and
// 3 more. A power of the cosine has 10 shininess + 2. Mixing values that differ by at most 1.3 adds 6. Densities of both
// differ by a double's last bits, which moves a float of the material by one at most.
double DensitySteps::golden_error() const {
  const scene::Shading& shading = scene_.shading;
  return std::ldexp(
      12.0 * 1.3 + 10.0 * shading.diffuse + 3.0 + shading.specular * (10.0 * shading.shininess + 2.0) + 6.0 + 2.0, -24);
}

double DensitySteps::Lines::at(double position, const RealNarrowing& fall, std::size_t channel) const {
  const auto last = static_cast<double>(segments() - 1);
  const double from = std::clamp(std::floor(position), 0.0, last), rest = std::clamp(position - from, 0.0, 1.0);
  const std::size_t here = static_cast<std::size_t>(from) * channels + channel;
  return entries[here] - fall((entries[here] - entries[here + channels]) * rest);
}

DensitySteps::Visible DensitySteps::transfer(double density, const Mixture& mixture) const {
  Visible out;
  if (!mixture.device(Step::Transfer)) {
    const RoundToFloat& narrow = mixture.rounding(Step::Transfer);
    const scene::Material material = classify_.evaluate(base_ + range_ * density);
    for (int c = 0; c < 3; ++c)
      out.colour[static_cast<std::size_t>(c)] = narrow(static_cast<double>(material.colour[c]));
    out.tau = narrow(static_cast<double>(material.extinction) * depth_);
    return out;
  }
  const double position = density * static_cast<double>(classify_lines_.segments());
  for (std::size_t c = 0; c < 3; ++c) out.colour[c] = classify_lines_.at(position, colour_fall_, c);
  out.tau = classify_lines_.at(position, tau_fall_, 3);
  return out;
}

DensitySteps::Vector DensitySteps::slope(const DensityPixel& pixel, const Mixture& mixture) const {
  const bool device = mixture.device(Step::Slope);
  const RoundToFloat& narrow = mixture.rounding(Step::Slope);
  const Scales& scales = (device ? words_ : real_)[static_cast<std::size_t>(pixel.sheet)];
  const double right = narrow(narrow(pixel.across[0]) * narrow(scales.across)),
               down = narrow(narrow(pixel.across[1]) * narrow(scales.across)),
               along = narrow(narrow(pixel.across[2]) * narrow(scales.along));
  // Along the pixel's own ray, not along the view axis.
  if (!device) {
    const glm::dvec2 tilt = geometry_.tilt(pixel.x, pixel.y);
    return {right, down, narrow(narrow(along - narrow(narrow(tilt.x) * right)) - narrow(narrow(tilt.y) * down))};
  }
  const double tx = tilt_(tilts_[0] + pixel.x * tilts_[1]), ty = tilt_(tilts_[2] + pixel.y * tilts_[3]);
  const double gx = across_(right), gy = across_(down);
  return {gx, gy, along_(along - tx * gx - ty * gy)};
}

std::optional<DensitySteps::Normal> DensitySteps::normal(const Vector& slope, const Mixture& mixture) const {
  const RoundToFloat& narrow = mixture.rounding(Step::Normal);
  const double square = dot(slope, slope, narrow);
  if (!(square > 0.0)) return std::nullopt;
  if (!mixture.device(Step::Normal)) {
    const double length = narrow(std::sqrt(square));
    return Normal{narrow(1.0 / length), length};
  }
  const int even = std::ilogb(square) & ~1;
  const double m = std::ldexp(std::floor(std::ldexp(square, words::kSlope - even)), -words::kSlope);  // 1..4
  const double root = root_lines_.at(std::ldexp(m - 1.0, words::kRootBits), root_fall_);
  return Normal{std::ldexp(root, -even / 2), length_(std::ldexp(m * root, even / 2))};
}

double DensitySteps::facing(const Vector& slope, const Normal& normal, const Vector& real, const Vector& words,
                            const Mixture& mixture) const {
  const bool device = mixture.device(Step::Facing);
  const RoundToFloat& narrow = mixture.rounding(Step::Facing);
  Vector to = device ? words : real;
  for (double& part : to) part = narrow(part);
  const double along = std::abs(dot(slope, to, narrow)) * normal.inverse;
  return device ? facing_(along) : narrow(along);
}

double DensitySteps::blend(double length, int sheet, const Mixture& mixture) const {
  const auto s = static_cast<std::size_t>(sheet);
  if (mixture.device(Step::Blend)) return share_(length * words_[s].per_floor - 1.0);
  if (real_[s].per_floor == 0.0) return 1.0;
  const RoundToFloat& narrow = mixture.rounding(Step::Blend);
  return std::clamp(narrow(narrow(length * narrow(real_[s].per_floor)) - 1.0), 0.0, 1.0);
}

double DensitySteps::glint(double facing, const Mixture& mixture) const {
  const RoundToFloat& narrow = mixture.rounding(Step::Phong);
  if (!mixture.device(Step::Phong))
    return narrow(narrow(phong_.specular) * narrow(std::pow(facing, scene_.shading.shininess)));
  return phong_words_.specular * glint_lines_.at(std::ldexp(facing, words::kGlintBits), glint_fall_);
}

golden::Sums DensitySteps::operator()(const DensityPixel& pixel, const Mixture& mixture) const {
  const Visible seen = transfer(pixel.density, mixture);
  if (!(seen.tau > 0.0)) return {};
  double share = 0.0, matt = 0.0, shine = 0.0;
  if (scene_.shading.on) {  // else the device's words of the floor are 0, and so is its share
    const Vector g = slope(pixel, mixture);
    const std::optional<Normal> n = normal(g, mixture);
    if (n) share = blend(n->length, pixel.sheet, mixture);
    if (share > 0.0) {
      const RoundToFloat& narrow = mixture.rounding(Step::Phong);
      const double to_light = facing(g, *n, light_, light_words_, mixture);
      matt = mixture.device(Step::Phong) ? matt_(phong_words_.ambient + phong_words_.diffuse * to_light)
                                         : narrow(narrow(phong_.ambient) + narrow(narrow(phong_.diffuse) * to_light));
      shine = glint(facing(g, *n, half_, half_words_, mixture), mixture);
    }
  }
  golden::Sums out{0.0, 0.0, 0.0, seen.tau};
  const RoundToFloat& narrow = mixture.rounding(Step::Shaded);
  for (std::size_t c = 0; c < 3; ++c) {
    const double plain = seen.colour[c], change = narrow(share * narrow(narrow(narrow(plain * matt) + shine) - plain)),
                 mixed = narrow(plain + change);
    const double lit = mixture.device(Step::Shaded) ? lit_(mixed) : std::clamp(mixed, 0.0, 1.0);
    out[c] = mixture.device(Step::Colour) ? product_(lit * seen.tau) : mixture.rounding(Step::Colour)(lit * seen.tau);
  }
  return out;
}

}  // namespace fastsplat::stages
