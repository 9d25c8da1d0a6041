// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/ply_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {
namespace {

constexpr std::array kRgb{"red", "green", "blue"};

bool any_named(const PlyElement& vertices, std::string_view start) {
  return std::ranges::any_of(vertices.properties, [&](const auto& one) { return one.name.starts_with(start); });
}

/// At most eight names, the start of long ones, and the number of others.
std::string listed(std::vector<std::string> names) {
  constexpr std::size_t kShown = 8, kLongest = 40;
  for (std::string& name : names)
    if (name.size() > kLongest) name = name.substr(0, kLongest) + "...";
  if (names.size() <= kShown) return fmt::format("{}", fmt::join(names, " "));
  return fmt::format("{} and {} others", fmt::join(names.begin(), names.begin() + kShown, " "), names.size() - kShown);
}

/// Refuses vertices that have all properties of a Gaussian but are something else.
void refuse_other_kinds(const PlyElement& vertices, const std::string& where) {
  const auto refuse = [&](const char* what, const char* got, const char* fix) {
    throw_input(
        {.where = where, .what = what, .expected = "Gaussians with positions in the scene", .got = got, .fix = fix});
  };
  if (any_named(vertices, "f_anchor_feat"))
    refuse("the vertices are anchors of Scaffold-GS", "f_anchor_feat_0", "export the Gaussians generated from them");
  if (any_named(vertices, "binding"))
    refuse("the Gaussians are bound to a mesh", "the property binding", "export them with positions in the scene");
}

}  // namespace

PlyColumns::PlyColumns(const PlyElement& vertices, std::string where) : where_(std::move(where)) {
  refuse_other_kinds(vertices, where_);
  for (std::size_t i = 0; i < 3; ++i) position_[i] = column(vertices, std::string(1, static_cast<char>('x' + i)));
  for (std::size_t i = 0; i < 4; ++i) rotation_[i] = column(vertices, fmt::format("rot_{}", i));
  opacity_ = column(vertices, "opacity");
  find_colour(vertices);
  find_rest(vertices);
  for (std::size_t i = 0; i < 2; ++i) scale_[i] = column(vertices, fmt::format("scale_{}", i));
  scale_[2] = vertices.find("scale_2");
  if (!scale_[2]) remarks_.emplace_back("the Gaussians have two scales: they are drawn as discs, 1e-6 thick");
  filter_ = vertices.find("filter_3D");
  if (!filter_) filter_ = vertices.find("filter_3d");
  find_unused(vertices);
}

std::size_t PlyColumns::column(const PlyElement& vertices, const std::string& name) const {
  if (const auto found = vertices.find(name)) return *found;
  std::vector<std::string> names;
  for (const PlyProperty& property : vertices.properties) names.push_back(property.name);
  const bool trained = any_named(vertices, "scale") || any_named(vertices, "rot") || any_named(vertices, "f_dc");
  throw_input({.where = where_,
               .what = "the property " + name + " is missing",
               .expected = "x y z, scale_0..2, rot_0..3, opacity, f_dc_0..2 or red green blue of every vertex",
               .got = listed(names),
               .fix = trained ? "export the trained Gaussians with all of these"
                              : "this is a point cloud or a mesh: train 3-D Gaussians from it"});
}

void PlyColumns::find_colour(const PlyElement& vertices) {
  const bool rgb = !vertices.find("f_dc_0") && vertices.find("red");
  for (std::size_t i = 0; i < 3; ++i) constant_[i] = column(vertices, rgb ? kRgb[i] : fmt::format("f_dc_{}", i));
  for (std::size_t i = 0; rgb && i < 3; ++i) white_[i] = white_of(vertices.properties[constant_[i]]);
}

double PlyColumns::white_of(const PlyProperty& property) const {
  switch (property.type) {
    case PlyType::UInt8:
      return 255.0;
    case PlyType::UInt16:
      return 65535.0;
    case PlyType::Float32:
    case PlyType::Float64:
      return 1.0;
    default:
      throw_input({.where = where_,
                   .what = "unsupported type of the property " + property.name,
                   .expected = "uchar, ushort, float or double",
                   .got = "another integer type",
                   .fix = "write the colours as uchar, or as f_dc_0..2"});
  }
}

void PlyColumns::find_rest(const PlyElement& vertices) {
  std::size_t named = 0;
  for (const PlyProperty& property : vertices.properties) named += property.name.starts_with("f_rest_") ? 1 : 0;
  for (std::size_t i = 0; i < named; ++i) rest_.push_back(column(vertices, fmt::format("f_rest_{}", i)));
  while (degree_ < kMostDegree && named != 3U * (harmonic_count(degree_) - 1U)) ++degree_;
  if (named == 3U * (harmonic_count(degree_) - 1U)) return;
  throw_input({.where = where_,
               .what = "the number of f_rest_ properties matches no degree of spherical harmonics",
               .expected = "0, 9, 24 or 45",
               .got = fmt::format("{}", named),
               .fix = "reduce the harmonics to degree 3 or less"});
}

void PlyColumns::find_unused(const PlyElement& vertices) {
  std::vector<bool> used(vertices.properties.size());
  const auto use = [&used](const auto& columns) {
    for (const std::size_t i : columns) used[i] = true;
  };
  use(position_), use(constant_), use(rotation_), use(rest_);
  used[opacity_] = true;
  for (const auto& i : {scale_[0], scale_[1], scale_[2], filter_})
    if (i) used[*i] = true;
  // Normals do not describe a Gaussian; colours beside harmonics repeat them, rounded.
  for (const char* harmless : {"nx", "ny", "nz", "red", "green", "blue"})
    if (const auto i = vertices.find(harmless)) used[*i] = true;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i]) names.push_back(vertices.properties[i].name);
  if (!names.empty()) remarks_.push_back("these properties are unknown and were not used: " + listed(names));
}

std::vector<std::string> PlyColumns::remarks() const {
  std::vector<std::string> all = remarks_;
  if (!encoded_)
    all.emplace_back(
        "all scales are above 0 and all opacities within 0..1; they were read as logarithms and logits: check that "
        "this is right");
  return all;
}

void PlyColumns::read(std::span<const double> row, GaussianRows& to) {
  constexpr double kDisc = 1e-6;  // thickness given to 2-D Gaussians
  Gaussian one;
  glm::dvec4 rotation;
  double opacity = 1.0 / (1.0 + std::exp(-row[opacity_]));
  encoded_ = encoded_ || row[*scale_[0]] <= 0.0 || row[opacity_] < 0.0 || row[opacity_] > 1.0;
  const double filter = filter_ ? row[*filter_] : 0.0;
  if (!std::isfinite(filter)) return to.drop("filter_3D is not finite");
  if (filter < 0.0) return to.drop("filter_3D is below 0");
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    one.position[i] = static_cast<float>(row[position_[at]]);
    double scale = scale_[at] ? std::exp(row[*scale_[at]]) : kDisc;
    if (filter != 0.0) {
      // Smoothed by a Gaussian of this deviation, and dimmed in proportion.
      const double smoothed = std::hypot(scale, filter);
      opacity *= scale / smoothed;
      scale = smoothed;
    }
    one.scale[i] = static_cast<float>(scale);
  }
  one.opacity = static_cast<float>(opacity);
  for (std::size_t i = 0; i < 4; ++i) rotation[static_cast<int>(i)] = row[rotation_[i]];

  harmonics_.clear();
  glm::dvec3 constant(row[constant_[0]], row[constant_[1]], row[constant_[2]]);
  if (white_[0] != 0.0) {
    for (int c = 0; c < 3; ++c) {
      const double white = white_[static_cast<std::size_t>(c)];
      if (constant[c] >= 0.0 && constant[c] <= white) {
        constant[c] = (constant[c] / white - 0.5) / kConstantHarmonic;
        continue;
      }
      if (!std::isfinite(constant[c])) break;  // dropped with its row
      throw_input({.where = where_,
                   .what = fmt::format("the property {} is out of range", kRgb[static_cast<std::size_t>(c)]),
                   .expected = fmt::format("0..{:g} of its type", white),
                   .got = fmt::format("{:g}", constant[c]),
                   .fix = "write colours of 0..255 as uchar"});
    }
  }
  harmonics_.emplace_back(constant);
  const std::size_t each = rest_.size() / 3;  // per channel
  for (std::size_t i = 0; i < each; ++i)
    harmonics_.emplace_back(row[rest_[i]], row[rest_[each + i]], row[rest_[2 * each + i]]);
  to.add(one, rotation, harmonics_);
}

}  // namespace fastsplat::scene
