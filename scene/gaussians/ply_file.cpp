// SPDX-License-Identifier: Apache-2.0
// PLY as trainers of 3-D Gaussians write it (Kerbl et al. 2023, save_ply of their code).
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/gaussian_scene.hpp"
#include "scene/gaussians/ply_columns.hpp"
#include "scene/gaussians/ply_hints.hpp"
#include "scene/gaussians/ply_packed.hpp"
#include "scene/gaussians/ply_rows.hpp"
#include "scene/gaussians/splat_file.hpp"

namespace fastsplat::scene {
namespace {

[[noreturn]] void refuse_scene(const std::string& where, const std::string& what, const std::string& expected,
                               const std::string& got, const std::string& fix) {
  throw_input({.where = where, .what = what, .expected = expected, .got = got, .fix = fix});
}

void read_vertices(const PlyElement& element, PlyRows& rows, const std::string& where, GaussianCloud& to) {
  PlyColumns columns(element, where);
  rows.require(element);
  to.degree = columns.degree();
  const auto count = static_cast<std::size_t>(element.count);
  to.gaussians.reserve(count);
  to.harmonics.reserve(count * static_cast<std::size_t>(harmonic_count(to.degree)));
  GaussianRows drawn(to, where);
  std::vector<double> row(element.properties.size());
  for (std::size_t i = 0; i < count; ++i) {
    rows.read(element, i, row);
    columns.read(row, drawn);
  }
  drawn.end();
  const std::vector<std::string> remarks = columns.remarks();
  to.remarks.insert(to.remarks.end(), remarks.begin(), remarks.end());
}

/// The colour space that SHARP writes after its Gaussians: 0 is sRGB, 1 linear light.
void read_colour_space(const PlyElement& element, PlyRows& rows, GaussianCloud& to) {
  rows.require(element);
  std::vector<double> row(element.properties.size());
  if (row.empty() || element.count == 0) return;
  for (std::uint64_t i = 0; i < element.count; ++i) rows.read(element, i, row);
  to.linear = row[0] == 1.0;
  if (row[0] != 0.0 && row[0] != 1.0)
    to.remarks.push_back(fmt::format("unknown colour space {:g}: colours are read as sRGB", row[0]));
}

/// Reads the vertices and skips other elements. Returns false at a list, whose length is only in its data.
bool read_elements(const PlyHeader& header, PlyRows& rows, const std::string& where, GaussianCloud& to) {
  bool read = false, moves = false;
  for (const PlyElement& element : header.elements) {
    if (element.has_list && !read)
      refuse_scene(where, "the element " + element.name + " holds a list of variable length", "numbers only", {},
                   "write the file without this element");
    if (element.has_list) return false;
    if (element.name == "vertex") {
      read_vertices(element, rows, where, to);
      read = true;
    } else if (element.name == "color_space") {
      read_colour_space(element, rows, to);
    } else {
      if (element.name.starts_with("delta_vertex_") && !std::exchange(moves, true))
        to.remarks.emplace_back("the Gaussians move (delta_vertex_): their first positions are drawn");
      rows.skip(element);
    }
  }
  return true;
}

/// The properties in the order in which trainers write them.
std::vector<std::string> written_names(int degree) {
  std::vector<std::string> names{"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"};
  for (int i = 0; i < 3 * (harmonic_count(degree) - 1); ++i) names.push_back(fmt::format("f_rest_{}", i));
  for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
    names.emplace_back(name);
  return names;
}

std::vector<float> written_row(const Gaussian& one, std::span<const glm::vec3> harmonics) {
  constexpr double kLeastScale = 1e-10, kLeastShare = 1e-6;
  std::vector<float> row{one.position.x, one.position.y, one.position.z, 0.0F, 0.0F, 0.0F};
  for (int c = 0; c < 3; ++c) row.push_back(harmonics[0][c]);
  for (int c = 0; c < 3; ++c) {
    for (const glm::vec3& harmonic : harmonics.subspan(1)) row.push_back(harmonic[c]);
  }
  const double opacity = std::clamp(static_cast<double>(one.opacity), kLeastShare, 1.0 - kLeastShare);
  row.push_back(static_cast<float>(std::log(opacity / (1.0 - opacity))));
  for (int i = 0; i < 3; ++i)
    row.push_back(static_cast<float>(std::log(std::max(static_cast<double>(one.scale[i]), kLeastScale))));
  for (int i = 0; i < 4; ++i) row.push_back(one.rotation[i]);
  return row;
}

}  // namespace

GaussianCloud read_gaussian_ply(const std::filesystem::path& path) {
  const std::string where = path.string(), text = read_text_file(path, kMostGaussianBytes);
  const PlyHeader header = read_ply_header(text, where);
  const PlyElement* const vertices = header.find("vertex");
  if (vertices == nullptr)
    refuse_scene(where, "the header has no element vertex", "element vertex COUNT", {},
                 "check that this is the right file");
  const PlyHints hints = hints_of(header.comments);
  GaussianCloud cloud{.name = path.filename().string(), .source = where};
  cloud.up = hints.up, cloud.antialiased = hints.antialiased, cloud.linear = hints.linear;
  cloud.remarks = hints.remarks;
  PlyRows rows(header, text, where);
  if (vertices->count == 0)
    refuse_scene(where, "the file holds no Gaussians", "element vertex COUNT with at least 1", "0",
                 "check that this is the right file");
  bool whole = true;
  if (is_packed(header)) {
    read_packed(header, rows, where, cloud);
  } else {
    whole = read_elements(header, rows, where, cloud);
  }
  const std::size_t left = whole ? rows.require_end() : 0;
  if (left >= vertices->row_bytes())
    cloud.remarks.push_back(fmt::format("{} empty bytes after the last row were ignored", left));
  if (hints.degree && *hints.degree != cloud.degree)
    cloud.remarks.push_back(
        fmt::format("the header declares SH degree {}, but the properties have degree {}, which is drawn",
                    *hints.degree, cloud.degree));
  return cloud;
}

void save_gaussians(const GaussianCloud& cloud, const std::filesystem::path& path, PlyText text) {
  if (path.extension() == ".splat") return write_text_file(path, splat_bytes(cloud));
  const std::vector<std::string> names = written_names(cloud.degree);
  std::string out = fmt::format("ply\nformat {} 1.0\n", text == PlyText::Ascii ? "ascii" : "binary_little_endian");
  if (cloud.up) out += "comment Vertical Axis: " + up_axis_names()[static_cast<std::size_t>(*cloud.up)] + "\n";
  if (cloud.antialiased) out += "comment SplatRenderMode: mip\n";
  if (cloud.linear) out += "comment color_space: linear\n";
  out += fmt::format("element vertex {}\n", cloud.gaussians.size());
  for (const std::string& name : names) out += "property float " + name + "\n";
  out += "end_header\n";
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const std::vector<float> row = written_row(cloud.gaussians[i], cloud.harmonics_of(i));
    if (text == PlyText::Ascii) {
      out += fmt::format("{}\n", fmt::join(row, " "));
      continue;
    }
    for (const float value : row) {
      const auto word = std::bit_cast<std::uint32_t>(value);
      for (int byte = 0; byte < 4; ++byte) out.push_back(static_cast<char>((word >> (8 * byte)) & 0xFFU));
    }
  }
  write_text_file(path, out);
}

}  // namespace fastsplat::scene
