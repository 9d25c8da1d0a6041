// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/synthetic_gaussians.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/suggest.hpp"
#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {
namespace {

constexpr int kMost = 10'000'000;

/// splitmix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double unit() { return std::ldexp(static_cast<double>(next() >> 11U), -53); }
  double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15U);
    z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31U);
  }
  std::uint64_t state_;
};

/// Quaternion (w, x, y, z) of the shortest rotation that takes z to `direction`.
glm::vec4 turn_to(const glm::dvec3& direction) {
  const glm::dvec4 q(1.0 + direction.z, -direction.y, direction.x, 0.0);
  const double length = glm::length(q);
  return length < 1e-9 ? glm::vec4(0.0F, 1.0F, 0.0F, 0.0F) : glm::vec4(q / length);
}

/// Constant coefficient for a mean colour of 0..1.
glm::vec3 constant_of(const glm::dvec3& colour) { return (colour - glm::dvec3(0.5)) / kConstantHarmonic; }

/// Colours from the normal; each is brighter along its normal, so that harmonics of every degree are nonzero.
void append_shell_colour(const glm::dvec3& normal, int shell, std::vector<glm::vec3>& to) {
  constexpr std::array<std::array<double, 3>, 3> kTints{{{0.95, 0.35, 0.2}, {0.3, 0.75, 0.4}, {0.3, 0.45, 0.95}}};
  const auto& tint = kTints[static_cast<std::size_t>(shell)];
  const glm::dvec3 base = glm::dvec3(tint[0], tint[1], tint[2]) * (0.75 + 0.25 * normal.z);
  const auto harmonics = harmonics_at(-normal);
  to.push_back(constant_of(base));
  for (std::size_t i = 1; i < harmonics.size(); ++i) {
    const double share = i < 4 ? 0.10 : i < 9 ? 0.06 : 0.04;
    to.emplace_back(glm::dvec3(share * harmonics[i]));
  }
}

/// Fibonacci's spiral on three spheres: Gaussians flat on the sphere and twice as long as wide.
void shells(int count, GaussianCloud& cloud) {
  constexpr std::array<double, 3> kRadii{1.0, 0.72, 0.45};
  constexpr double kAll = 1.0 + 0.72 * 0.72 + 0.45 * 0.45;
  cloud.degree = 3;
  for (int shell = 0; shell < 3; ++shell) {
    const double radius = kRadii[static_cast<std::size_t>(shell)];
    const int left = count - static_cast<int>(cloud.gaussians.size());
    const int share = static_cast<int>(count * radius * radius / kAll) + (shell == 0 ? 1 : 0);
    const int many = shell == 2 ? left : std::min(share, left);
    const double apart = radius * std::sqrt(4.0 * std::numbers::pi / std::max(many, 1));
    for (int i = 0; i < many; ++i) {
      const double z = 1.0 - (2.0 * i + 1.0) / many, ring = std::sqrt(std::max(0.0, 1.0 - z * z));
      const double angle = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
      const glm::dvec3 normal(ring * std::cos(angle), ring * std::sin(angle), z);
      const double pattern =
          std::sin(5.0 * normal.x + 1.3 * shell) * std::sin(5.0 * normal.y) * std::sin(5.0 * normal.z);
      const bool hole = shell < 2 && pattern > 0.03;
      cloud.gaussians.push_back({.position = radius * normal,
                                 .scale = glm::vec3(0.6 * apart, 0.35 * apart, 0.06 * apart),
                                 .rotation = turn_to(normal),
                                 .opacity = hole         ? 0.04F
                                            : shell == 2 ? 0.95F
                                                         : 0.8F});
      append_shell_colour(normal, shell, cloud.harmonics);
    }
  }
}

void cloud_of(int count, GaussianCloud& cloud) {
  Random random(63);
  cloud.degree = 1;
  for (int i = 0; i < count; ++i) {
    const auto part = [&] {
      double sum = 0.0;
      for (int k = 0; k < 3; ++k) sum += random.unit();
      return sum - 1.5;
    };
    Gaussian one;
    for (int axis = 0; axis < 3; ++axis) {
      one.position[axis] = static_cast<float>(part());
      one.scale[axis] = static_cast<float>(0.3 * std::exp(random.between(-4.0, 0.0)) / std::cbrt(1.0 + count / 500.0));
    }
    glm::dvec4 rotation;
    for (int k = 0; k < 4; ++k) rotation[k] = random.between(-1.0, 1.0);
    one.rotation = glm::length(rotation) > 1e-3 ? glm::normalize(rotation) : glm::dvec4(1.0, 0.0, 0.0, 0.0);
    one.opacity = static_cast<float>(random.between(0.05, 1.0));
    cloud.gaussians.push_back(one);
    cloud.harmonics.push_back(
        constant_of({random.between(0.1, 0.9), random.between(0.1, 0.9), random.between(0.1, 0.9)}));
    for (int k = 1; k < 4; ++k) {
      // Blue first: the order in which the recorded hashes were computed.
      glm::dvec3 one_of_degree;
      for (int c = 2; c >= 0; --c) one_of_degree[c] = random.between(-0.1, 0.1);
      cloud.harmonics.emplace_back(one_of_degree);
    }
  }
}

struct Entry {
  const char* name;
  int default_count;
  void (*make)(int, GaussianCloud&);
};
constexpr std::array<Entry, 2> kEntries{{{"shells", 2000, shells}, {"cloud", 500, cloud_of}}};

const Entry* find(const std::string& name) {
  const std::string word = name.substr(0, name.find(':'));
  const auto* const found = std::ranges::find_if(kEntries, [&](const Entry& entry) { return word == entry.name; });
  return found == kEntries.end() ? nullptr : found;
}

}  // namespace

bool is_synthetic_gaussians(const std::string& name) { return find(name) != nullptr; }

std::vector<std::string> synthetic_gaussian_names() {
  std::vector<std::string> names;
  for (const Entry& entry : kEntries) names.emplace_back(entry.name);
  return names;
}

GaussianCloud make_synthetic_gaussians(const std::string& name) {
  const Entry* const entry = find(name);
  if (entry == nullptr) {
    throw_input({.where = {},
                 .what = "unknown built-in scene of Gaussians '" + name + "'",
                 .expected = {},
                 .got = {},
                 .fix = suggestion(name, synthetic_gaussian_names())});
  }
  const auto colon = name.find(':');
  const auto count = colon == std::string::npos ? std::optional(entry->default_count)
                                                : integer_from<int>(std::string_view(name).substr(colon + 1));
  if (!count || *count < 1 || *count > kMost) {
    throw_input({.where = name,
                 .what = "the number of Gaussians is out of range",
                 .expected = fmt::format("1..{}", kMost),
                 .got = "'" + name.substr(colon + 1) + "'",
                 .fix = fmt::format("for example {}:{}", entry->name, entry->default_count)});
  }
  GaussianCloud cloud{.name = fmt::format("{}:{}", entry->name, *count),
                      .source = fmt::format("built-in {}, {} Gaussians", entry->name, *count),
                      .up = UpAxis::Z};
  entry->make(*count, cloud);
  return cloud;
}

}  // namespace fastsplat::scene
