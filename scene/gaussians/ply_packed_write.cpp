// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/gaussians/byte_words.hpp"
#include "scene/gaussians/harmonics.hpp"
#include "scene/gaussians/morton_order.hpp"
#include "scene/gaussians/ply_file.hpp"
#include "scene/gaussians/ply_packed.hpp"
#include "scene/gaussians/smallest_three.hpp"

namespace fastsplat::scene {
namespace {

/// Position, log scale and colour of a Gaussian, which chunks bound.
using Bounded = std::array<glm::dvec3, 3>;

Bounded bounded_of(const GaussianCloud& cloud, std::size_t i) {
  const Gaussian& one = cloud.gaussians[i];
  Bounded out{glm::dvec3(one.position), glm::log(glm::dvec3(one.scale)),
              0.5 + kConstantHarmonic * glm::dvec3(cloud.harmonics_of(i)[0])};
  for (int k = 0; k < 3; ++k) {
    out[1][k] = kPackedLogScale.clamp(out[1][k]);
    out[2][k] = kPackedColour.clamp(out[2][k]);
  }
  return out;
}

/// Bounds as the file has them.
struct PackedBounds {
  std::array<glm::vec3, 3> low{}, high{};

  /// Of the chunk that begins at `first`.
  PackedBounds(const GaussianCloud& cloud, const std::vector<std::size_t>& order, std::size_t first) {
    low.fill(glm::vec3(std::numeric_limits<float>::infinity()));
    high.fill(glm::vec3(-std::numeric_limits<float>::infinity()));
    for (std::size_t i = first; i < std::min(first + kPackedChunk, order.size()); ++i) {
      const Bounded values = bounded_of(cloud, order[i]);
      for (std::size_t k = 0; k < values.size(); ++k)
        low[k] = glm::min(low[k], glm::vec3(values[k])), high[k] = glm::max(high[k], glm::vec3(values[k]));
    }
  }
  std::uint32_t step(const Bounded& values, std::size_t k, int axis, unsigned bits) const {
    const auto least = static_cast<double>(low[k][axis]), size = static_cast<double>(high[k][axis]) - least;
    const double most = (1U << bits) - 1U;
    return size > 0.0 ? nearest_step((values[k][axis] - least) / size * most, most) : 0U;
  }
  std::uint32_t word_11_10_11(const Bounded& values, std::size_t k) const {
    return step(values, k, 0, 11) << 21U | step(values, k, 1, 10) << 11U | step(values, k, 2, 11);
  }
};

std::uint32_t word_of_rotation(const glm::dvec4& rotation) {
  const SmallestThree code = smallest_three_of(rotation);
  auto word = static_cast<std::uint32_t>(code.largest);
  for (const double value : code.others)
    word = word << 10U | nearest_step((value / std::numbers::sqrt2 + 0.5) * 1023.0, 1023.0);
  return word;
}

std::string header_of(const GaussianCloud& cloud, std::size_t chunks) {
  const std::size_t count = cloud.gaussians.size();
  std::string out = "ply\nformat binary_little_endian 1.0\n" + ply_comments(cloud);
  out += fmt::format("element chunk {}\n", chunks);
  for (const char* of : {"", "scale_"})
    for (const char* bound : {"min", "max"})
      for (const char axis : {'x', 'y', 'z'}) out += fmt::format("property float {}_{}{}\n", bound, of, axis);
  for (const char* bound : {"min", "max"})
    for (const char channel : {'r', 'g', 'b'}) out += fmt::format("property float {}_{}\n", bound, channel);
  out += fmt::format("element vertex {}\n", count);
  for (const char* word : {"position", "rotation", "scale", "color"})
    out += fmt::format("property uint packed_{}\n", word);
  if (cloud.degree > 0) out += fmt::format("element sh {}\n", count);
  for (int i = 0; i < 3 * (harmonic_count(cloud.degree) - 1); ++i) out += fmt::format("property uchar f_rest_{}\n", i);
  return out + "end_header\n";
}

}  // namespace

std::string packed_ply_bytes(const GaussianCloud& cloud) {
  const std::vector<std::size_t> order = morton_order(cloud);
  std::string bounds, words, rest;
  std::size_t chunks = 0;
  for (std::size_t first = 0; first < order.size(); first += kPackedChunk, ++chunks) {
    const std::size_t end = std::min(first + kPackedChunk, order.size());
    const PackedBounds chunk(cloud, order, first);
    for (std::size_t k = 0; k < 3; ++k)
      for (const glm::vec3& bound : {chunk.low[k], chunk.high[k]})
        for (int axis = 0; axis < 3; ++axis) append_float(bounds, bound[axis]);
    for (std::size_t i = first; i < end; ++i) {
      const Bounded values = bounded_of(cloud, order[i]);
      const Gaussian& one = cloud.gaussians[order[i]];
      const auto harmonics = cloud.harmonics_of(order[i]);
      append_word(words, chunk.word_11_10_11(values, 0));
      append_word(words, word_of_rotation(glm::dvec4(one.rotation)));
      append_word(words, chunk.word_11_10_11(values, 1));
      std::uint32_t colour = 0;
      for (int c = 0; c < 3; ++c) colour = colour << 8U | chunk.step(values, 2, c, 8);
      append_word(words, colour << 8U | nearest_step(255.0 * static_cast<double>(one.opacity), 255.0));
      for (int c = 0; c < 3; ++c)
        for (const glm::vec3& harmonic : harmonics.subspan(1))
          append_byte(rest, packed_byte_of_harmonic(static_cast<double>(harmonic[c])));
    }
  }
  return header_of(cloud, chunks) + bounds + words + rest;
}

std::vector<double> packed_ply_rounding(const GaussianCloud& cloud) {
  constexpr std::array kBits{11U, 10U, 11U};
  const std::vector<std::size_t> order = morton_order(cloud);
  std::vector<double> out(order.size());
  for (std::size_t first = 0; first < order.size(); first += kPackedChunk) {
    const PackedBounds chunk(cloud, order, first);
    const glm::dvec3 low(chunk.low[0]), size = glm::dvec3(chunk.high[0]) - low;
    for (std::size_t i = first; i < std::min(first + kPackedChunk, order.size()); ++i) {
      const Bounded values = bounded_of(cloud, order[i]);
      glm::dvec3 written;
      for (int axis = 0; axis < 3; ++axis) {
        const unsigned bits = kBits[static_cast<std::size_t>(axis)];
        written[axis] = low[axis] + size[axis] * chunk.step(values, 0, axis, bits) / ((1U << bits) - 1U);
      }
      out[order[i]] = glm::distance(values[0], written);
    }
  }
  return out;
}

}  // namespace fastsplat::scene
