// SPDX-License-Identifier: Apache-2.0
// A scene of 3-D Gaussians, as trainers of radiance fields make them (docs/techniques/gaussians.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fastsplat::scene {

inline constexpr int kMostDegree = 3;
/// Spherical harmonics of a degree and all below: 1, 4, 9, 16.
constexpr int harmonic_count(int degree) { return (degree + 1) * (degree + 1); }

/// One Gaussian, without its colour. Lengths in the file's own unit, along the file's own axes.
struct Gaussian {
  glm::vec3 position{0.0F};
  glm::vec3 scale{1.0F};                       ///< standard deviations along its own axes, linear, not negative
  glm::vec4 rotation{1.0F, 0.0F, 0.0F, 0.0F};  ///< w, x, y, z; unit: turns its axes to the file's
  float opacity = 0.0F;                        ///< 0..1

  bool operator==(const Gaussian&) const = default;
};

/// Which of the file's axes points up.
enum class UpAxis { X, Y, Z, MinusX, MinusY, MinusZ };

/// Gaussians of a file that cannot be drawn, by cause.
struct DroppedGaussians {
  std::string cause;      ///< "scale_1 is not finite", in the names of a PLY's properties
  std::size_t count = 0;  ///< Gaussians with this cause
  std::size_t first = 0;  ///< the first of them, counted from 0 in the file

  bool operator==(const DroppedGaussians&) const = default;
};

struct GaussianCloud {
  std::string name;    ///< "shells:2000", or the file's name without its folder
  std::string source;  ///< origin, for metadata
  int degree = 0;      ///< of the spherical harmonics, 0..3
  std::vector<Gaussian> gaussians{};
  std::vector<glm::vec3> harmonics{};  ///< RGB, harmonic_count(degree) a Gaussian, its constant first
  std::optional<UpAxis> up{};          ///< as declared by the file
  bool antialiased = false;            ///< trained so that the low-pass dims a footprint as much as it widens it
  bool linear = false;                 ///< colours are linear light, not encoded as sRGB
  bool by_distance = false;            ///< the file declares the order of distances from the eye
  bool cropped = false;                ///< by crop()
  std::vector<std::uint32_t> numbers{};     ///< in the file, from 0, if some of its Gaussians were dropped or cropped
  std::vector<DroppedGaussians> dropped{};  ///< by the first of each cause
  std::vector<std::string> remarks{};       ///< dropped, assumed or unsupported content, a sentence each

  std::uint32_t number_of(std::size_t i) const { return numbers.empty() ? static_cast<std::uint32_t>(i) : numbers[i]; }
  std::span<const glm::vec3> harmonics_of(std::size_t i) const {
    const auto count = static_cast<std::size_t>(harmonic_count(degree));
    return std::span(harmonics).subspan(i * count, count);
  }
};

/// R diag(scale^2) R^T.
glm::dmat3 covariance(const Gaussian& gaussian);
/// The columns are its own axes.
glm::dmat3 axes_of(const Gaussian& gaussian);

/// FNV-1a over every number and everything that changes its meaning: equal for files of the same scene.
std::uint64_t content_hash(const GaussianCloud& cloud);

}  // namespace fastsplat::scene
