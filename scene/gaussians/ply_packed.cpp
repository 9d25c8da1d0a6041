// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/ply_packed.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>

#include "base/error.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/smallest_three.hpp"

namespace fastsplat::scene {
namespace {

[[noreturn]] void refuse_packed(const std::string& where, const std::string& what, const std::string& expected,
                                const std::string& got) {
  throw_input({.where = where,
               .what = "invalid compressed PLY: " + what,
               .expected = expected,
               .got = got,
               .fix = "write it again or as an uncompressed .ply"});
}

/// Positions of the properties in a row.
template <std::size_t kCount>
std::array<std::size_t, kCount> places(const PlyElement& element, const std::array<const char*, kCount>& names,
                                       const std::string& where) {
  std::array<std::size_t, kCount> out{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const auto found = element.find(names[i]);
    if (!found) refuse_packed(where, fmt::format("the element {} lacks a property", element.name), names[i], "none");
    out[i] = *found;
  }
  return out;
}

/// Bounds of the Gaussians of a chunk.
struct Bounds {
  glm::dvec3 low{0.0}, high{1.0};
  glm::dvec3 between(const glm::dvec3& share) const { return low * (1.0 - share) + high * share; }
};
struct Chunk {
  Bounds position, scale, colour;
};

std::vector<Chunk> chunks_of(const PlyElement& element, PlyRows& rows, const std::string& where) {
  constexpr std::array kNeeded{"min_x",       "min_y",       "min_z",       "max_x",
                               "max_y",       "max_z",       "min_scale_x", "min_scale_y",
                               "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z"};
  constexpr std::array kColourBounds{"min_r", "min_g", "min_b", "max_r", "max_g", "max_b"};
  const auto at = places(element, kNeeded, where);
  const bool coloured = element.find("min_r").has_value();  // older files: colours lie between 0 and 1
  const auto colour_at = coloured ? places(element, kColourBounds, where) : std::array<std::size_t, 6>{};
  rows.require(element);
  std::vector<Chunk> out(element.count);
  std::vector<double> row(element.properties.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    rows.read(element, i, row);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<int>(axis);
      out[i].position.low[a] = row[at[axis]], out[i].position.high[a] = row[at[3 + axis]];
      out[i].scale.low[a] = row[at[6 + axis]], out[i].scale.high[a] = row[at[9 + axis]];
      if (coloured) out[i].colour.low[a] = row[colour_at[axis]], out[i].colour.high[a] = row[colour_at[3 + axis]];
    }
  }
  return out;
}

/// `bits` bits of a word as a fraction of 0..1.
double share_of(std::uint32_t word, unsigned shift, unsigned bits) {
  const std::uint32_t most = (1U << bits) - 1U;
  return static_cast<double>((word >> shift) & most) / most;
}
glm::dvec3 shares_11_10_11(std::uint32_t word) {
  return {share_of(word, 21, 11), share_of(word, 11, 10), share_of(word, 0, 11)};
}

/// Three components of w, x, y, z within +-1/sqrt(2), in 10 bits each; the top two bits select the omitted one.
glm::dvec4 rotation_of_word(std::uint32_t word) {
  SmallestThree code{.largest = static_cast<int>(word >> 30U)};
  for (unsigned i = 0; i < 3; ++i) code.others[i] = (share_of(word, 20 - 10 * i, 10) - 0.5) * std::numbers::sqrt2;
  return rotation_of(code);
}

int degree_of(const PlyElement* sh, const std::string& where) {
  if (sh == nullptr) return 0;
  for (int degree = 1; degree <= kMostDegree; ++degree)
    if (sh->properties.size() == 3U * (harmonic_count(degree) - 1U)) return degree;
  refuse_packed(where, "the number of properties of element sh matches no degree", "9, 24 or 45",
                fmt::format("{}", sh->properties.size()));
}

}  // namespace

bool is_packed(const PlyHeader& header) {
  const PlyElement* const vertices = header.find("vertex");
  return vertices != nullptr && vertices->find("packed_position");
}

void read_packed(const PlyHeader& header, PlyRows& rows, const std::string& where, GaussianCloud& to) {
  const std::size_t size = header.elements.size();
  const bool ordered = size >= 2 && size <= 3 && header.elements[0].name == "chunk" &&
                       header.elements[1].name == "vertex" && (size == 2 || header.elements[2].name == "sh");
  if (!ordered) refuse_packed(where, "wrong elements", "chunk, vertex and sh, in this order", "others");
  const PlyElement& vertices = header.elements[1];
  const PlyElement* const sh = size == 3 ? &header.elements[2] : nullptr;
  for (const PlyElement& element : header.elements)
    if (element.has_list) refuse_packed(where, "an element holds a list", "numbers only", element.name);
  constexpr std::array kWords{"packed_position", "packed_rotation", "packed_scale", "packed_color"};
  const auto at = places(vertices, kWords, where);
  for (const std::size_t i : at)
    if (vertices.properties[i].type != PlyType::UInt32)
      refuse_packed(where, "a packed word has the wrong type", "uint", vertices.properties[i].name);
  to.degree = degree_of(sh, where);
  if (sh != nullptr && sh->count != vertices.count)
    refuse_packed(where, "the number of sh rows differs from the number of Gaussians",
                  fmt::format("{} rows", vertices.count), fmt::format("{}", sh->count));
  const std::uint64_t chunks_wanted = vertices.count / kPackedChunk + (vertices.count % kPackedChunk != 0 ? 1 : 0);
  if (header.elements[0].count != chunks_wanted)
    refuse_packed(where, "wrong number of chunks of 256 Gaussians", fmt::format("{} chunks", chunks_wanted),
                  fmt::format("{}", header.elements[0].count));

  const std::vector<Chunk> chunks = chunks_of(header.elements[0], rows, where);
  rows.require(vertices);
  const auto count = static_cast<std::size_t>(vertices.count);
  std::vector<Gaussian> gaussians(count);
  std::vector<glm::dvec4> rotations(count);
  std::vector<glm::dvec3> constants(count);
  std::vector<double> row(vertices.properties.size());
  for (std::size_t i = 0; i < count; ++i) {
    rows.read(vertices, i, row);
    const auto word = [&](std::size_t which) { return static_cast<std::uint32_t>(row[at[which]]); };
    const Chunk& chunk = chunks[i / kPackedChunk];
    const std::uint32_t colour = word(3);
    const glm::dvec3 rgb{share_of(colour, 24, 8), share_of(colour, 16, 8), share_of(colour, 8, 8)};
    gaussians[i] = {.position = chunk.position.between(shares_11_10_11(word(0))),
                    .scale = glm::exp(chunk.scale.between(shares_11_10_11(word(2)))),
                    .opacity = static_cast<float>(share_of(colour, 0, 8))};
    rotations[i] = rotation_of_word(word(1));
    constants[i] = (chunk.colour.between(rgb) - 0.5) / kConstantHarmonic;
  }
  if (sh != nullptr) rows.require(*sh);
  GaussianRows drawn(to, where);
  const auto each = static_cast<std::size_t>(harmonic_count(to.degree));
  std::vector<glm::vec3> harmonics(each);
  row.resize(3 * (each - 1));
  for (std::size_t i = 0; i < count; ++i) {
    harmonics[0] = constants[i];
    if (sh != nullptr) rows.read(*sh, i, row);
    for (std::size_t k = 1; k < each; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        harmonics[k][static_cast<int>(c)] = static_cast<float>(packed_harmonic(row[c * (each - 1) + k - 1]));
    drawn.add(gaussians[i], rotations[i], harmonics);
  }
  drawn.end();
}

}  // namespace fastsplat::scene
