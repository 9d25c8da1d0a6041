// SPDX-License-Identifier: Apache-2.0
// As trainers write it (Kerbl et al. 2023, save_ply of their code).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/gaussians/byte_words.hpp"
#include "scene/gaussians/gaussian_scene.hpp"
#include "scene/gaussians/ply_file.hpp"

namespace fastsplat::scene {
namespace {

/// The properties in the order in which trainers write them.
std::vector<std::string> written_names(int degree) {
  std::vector<std::string> names{"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"};
  for (int i = 0; i < 3 * (harmonic_count(degree) - 1); ++i) names.push_back(fmt::format("f_rest_{}", i));
  for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
    names.emplace_back(name);
  return names;
}

std::vector<float> written_row(const Gaussian& one, std::span<const glm::vec3> harmonics) {
  constexpr double kLeastShare = 1e-6;
  std::vector<float> row{one.position.x, one.position.y, one.position.z, 0.0F, 0.0F, 0.0F};
  for (int c = 0; c < 3; ++c) row.push_back(harmonics[0][c]);
  for (int c = 0; c < 3; ++c) {
    for (const glm::vec3& harmonic : harmonics.subspan(1)) row.push_back(harmonic[c]);
  }
  const double opacity = std::clamp(static_cast<double>(one.opacity), kLeastShare, 1.0 - kLeastShare);
  row.push_back(static_cast<float>(std::log(opacity / (1.0 - opacity))));
  for (int i = 0; i < 3; ++i)
    row.push_back(static_cast<float>(kPlyLogScale.clamp(std::log(static_cast<double>(one.scale[i])))));
  for (int i = 0; i < 4; ++i) row.push_back(one.rotation[i]);
  return row;
}

}  // namespace

std::string ply_comments(const GaussianCloud& cloud) {
  std::string out;
  if (cloud.up) out += "comment Vertical Axis: " + up_axis_names()[static_cast<std::size_t>(*cloud.up)] + "\n";
  if (cloud.antialiased) out += "comment SplatRenderMode: mip\n";
  if (cloud.linear) out += "comment color_space: linear\n";
  return out;
}

std::string ply_bytes(const GaussianCloud& cloud, PlyText text) {
  const std::vector<std::string> names = written_names(cloud.degree);
  std::string out = fmt::format("ply\nformat {} 1.0\n", text == PlyText::Ascii ? "ascii" : "binary_little_endian");
  out += ply_comments(cloud);
  out += fmt::format("element vertex {}\n", cloud.gaussians.size());
  for (const std::string& name : names) out += "property float " + name + "\n";
  out += "end_header\n";
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const std::vector<float> row = written_row(cloud.gaussians[i], cloud.harmonics_of(i));
    if (text == PlyText::Ascii) {
      out += fmt::format("{}\n", fmt::join(row, " "));
      continue;
    }
    for (const float value : row) append_float(out, value);
  }
  return out;
}

}  // namespace fastsplat::scene
