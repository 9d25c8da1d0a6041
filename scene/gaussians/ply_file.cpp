// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/ply_file.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/error.hpp"
#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/ply_columns.hpp"
#include "scene/gaussians/ply_hints.hpp"
#include "scene/gaussians/ply_packed.hpp"
#include "scene/gaussians/ply_rows.hpp"

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

}  // namespace

bool is_ply(std::string_view head) { return head.starts_with("ply\n") || head.starts_with("ply\r"); }

void read_ply(const std::string& text, GaussianCloud& cloud) {
  const std::string where = cloud.source;
  const PlyHeader header = read_ply_header(text, where);
  const PlyElement* const vertices = header.find("vertex");
  if (vertices == nullptr)
    refuse_scene(where, "the header has no element vertex", "element vertex COUNT", {},
                 "check that this is the right file");
  const PlyHints hints = hints_of(header.comments);
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
}

}  // namespace fastsplat::scene
