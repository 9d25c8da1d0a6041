// PLY as trainers of 3-D Gaussians write it (Kerbl et al. 2023, save_ply of their code).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fstream>
#include <optional>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/read_file.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/ply_header.hpp"
#include "scene/gaussians/ply_rows.hpp"
#include "scene/gaussians/splat_file.hpp"

namespace fastsplat::scene {
namespace {

/// Where in a row each number of a Gaussian stands.
struct Columns {
  std::array<std::size_t, 3> position{}, scale{}, constant{};
  std::array<std::size_t, 4> rotation{};
  std::size_t opacity = 0;
  std::vector<std::size_t> rest;  ///< f_rest_0 ..
  int degree = 0;
};

std::optional<std::size_t> find(const PlyElement& element, const std::string& name) {
  for (std::size_t i = 0; i < element.properties.size(); ++i) {
    if (element.properties[i].name == name) return i;
  }
  return std::nullopt;
}

std::size_t column(const PlyElement& element, const std::string& name, const std::string& where) {
  if (const auto found = find(element, name)) return *found;
  throw_input({.where = where,
               .what = "the property " + name + " is missing",
               .expected = "x y z, scale_0..2, rot_0..3, opacity, f_dc_0..2 of every vertex",
               .got = fmt::format("{} others", element.properties.size()),
               .fix = "write the trained Gaussians, not a point cloud or a mesh"});
}

Columns columns_of(const PlyElement& element, const std::string& where) {
  Columns out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.position[i] = column(element, std::string(1, static_cast<char>('x' + i)), where);
    out.scale[i] = column(element, fmt::format("scale_{}", i), where);
    out.constant[i] = column(element, fmt::format("f_dc_{}", i), where);
  }
  for (std::size_t i = 0; i < 4; ++i) out.rotation[i] = column(element, fmt::format("rot_{}", i), where);
  out.opacity = column(element, "opacity", where);
  std::size_t named = 0;
  for (const PlyProperty& property : element.properties) named += property.name.starts_with("f_rest_") ? 1 : 0;
  for (std::size_t i = 0; i < named; ++i) out.rest.push_back(column(element, fmt::format("f_rest_{}", i), where));
  while (out.degree < kMostDegree && named != 3U * (harmonic_count(out.degree) - 1U)) ++out.degree;
  if (named != 3U * (harmonic_count(out.degree) - 1U)) {
    throw_input({.where = where,
                 .what = "not as many f_rest_ as spherical harmonics of a degree have",
                 .expected = "0, 9, 24 or 45 of them",
                 .got = fmt::format("{}", named),
                 .fix = "harmonics above degree 3 are not known"});
  }
  return out;
}

/// The element of the Gaussians; those before it are passed over.
const PlyElement& vertices(const PlyHeader& header, PlyRows& rows, const std::string& where) {
  for (const PlyElement& element : header.elements) {
    if (element.has_list && (element.name == "vertex" || &element != &header.elements.back())) {
      throw_input({.where = where,
                   .what = "the element " + element.name + " holds a list, whose length only its data say",
                   .expected = "numbers only, as trainers write them",
                   .got = {},
                   .fix = "write the Gaussians without it"});
    }
    if (element.name == "vertex") return element;
    rows.skip(element);
  }
  throw_input({.where = where,
               .what = "the header has no element vertex",
               .expected = "element vertex COUNT",
               .got = {},
               .fix = "check that this is the file you meant"});
}

Gaussian gaussian_of(const Columns& at, std::span<const double> row, const std::string& here) {
  Gaussian out;
  glm::dvec4 rotation;
  for (std::size_t i = 0; i < 3; ++i) {
    out.position[static_cast<int>(i)] = static_cast<float>(row[at.position[i]]);
    out.scale[static_cast<int>(i)] = static_cast<float>(std::exp(row[at.scale[i]]));
  }
  for (std::size_t i = 0; i < 4; ++i) rotation[static_cast<int>(i)] = row[at.rotation[i]];
  out.rotation = unit_rotation(rotation, here);
  out.opacity = static_cast<float>(1.0 / (1.0 + std::exp(-row[at.opacity])));
  return out;
}

void append_harmonics(const Columns& at, std::span<const double> row, std::vector<glm::vec3>& to) {
  to.emplace_back(row[at.constant[0]], row[at.constant[1]], row[at.constant[2]]);
  const std::size_t each = at.rest.size() / 3;  // of a channel
  for (std::size_t i = 0; i < each; ++i)
    to.emplace_back(row[at.rest[i]], row[at.rest[each + i]], row[at.rest[2 * each + i]]);
}

/// The properties in the order that trainers write them.
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
  PlyRows rows(header, text, where);
  const PlyElement& element = vertices(header, rows, where);
  const Columns at = columns_of(element, where);
  if (element.count == 0) {
    throw_input({.where = where,
                 .what = "the file holds no Gaussian",
                 .expected = "element vertex COUNT with at least 1",
                 .got = "0",
                 .fix = "check that this is the file you meant"});
  }
  rows.require(element);

  GaussianCloud cloud{.name = path.filename().string(), .source = where, .degree = at.degree};
  const auto count = static_cast<std::size_t>(element.count);
  cloud.gaussians.reserve(count);
  cloud.harmonics.reserve(count * static_cast<std::size_t>(harmonic_count(at.degree)));
  std::vector<double> row(element.properties.size());
  for (std::size_t i = 0; i < count; ++i) {
    rows.read(element, i, row);
    const std::string here = fmt::format("{}, Gaussian {}", where, i);
    cloud.gaussians.push_back(gaussian_of(at, row, here));
    append_harmonics(at, row, cloud.harmonics);
    check_gaussian(cloud.gaussians.back(), cloud.harmonics_of(i), here);
  }
  if (&element == &header.elements.back()) rows.require_end();
  return cloud;
}

void save_gaussians(const GaussianCloud& cloud, const std::filesystem::path& path, PlyText text) {
  if (path.extension() == ".splat") return write_text_file(path, splat_bytes(cloud));
  const std::vector<std::string> names = written_names(cloud.degree);
  std::string out = fmt::format("ply\nformat {} 1.0\nelement vertex {}\n",
                                text == PlyText::Ascii ? "ascii" : "binary_little_endian", cloud.gaussians.size());
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
