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
#include "scene/gaussians/outdoor_gaussians.hpp"
#include "scene/gaussians/synthetic_parts.hpp"

namespace fastsplat::scene {
namespace {

constexpr int kMost = 10'000'000;

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
void shells(int count, std::uint64_t /*seed*/, GaussianCloud& cloud) {
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
                                 .rotation = glm::vec4(turn_to(normal)),
                                 .opacity = hole         ? 0.04F
                                            : shell == 2 ? 0.95F
                                                         : 0.8F});
      append_shell_colour(normal, shell, cloud.harmonics);
    }
  }
}

void cloud_of(int count, std::uint64_t seed, GaussianCloud& cloud) {
  Random random(seed);
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
  std::optional<std::uint64_t> default_seed;  ///< empty: nothing in it is random
  void (*make)(int, std::uint64_t, GaussianCloud&);
};
constexpr std::array<Entry, 3> kEntries{
    {{"shells", 2000, {}, shells}, {"cloud", 500, 63, cloud_of}, {"outdoor", 100'000, 1, append_outdoor}}};

const Entry* find(const std::string& name) {
  const std::string word = name.substr(0, name.find(':'));
  const auto* const found = std::ranges::find_if(kEntries, [&](const Entry& entry) { return word == entry.name; });
  return found == kEntries.end() ? nullptr : found;
}

struct Numbers {
  int count;
  std::optional<std::uint64_t> seed;
};

/// The numbers of "name", "name:count" or "name:count:seed".
Numbers numbers_of(const Entry& entry, const std::string& name) {
  const auto refuse = [&](const char* what, std::string expected, std::string_view got) {
    throw_input({.where = name,
                 .what = what,
                 .expected = std::move(expected),
                 .got = fmt::format("'{}'", got),
                 .fix = fmt::format("for example {}:{}", entry.name, entry.default_count)});
  };
  Numbers out{entry.default_count, entry.default_seed};
  const auto colon = name.find(':');
  if (colon == std::string::npos) return out;
  std::string_view text = std::string_view(name).substr(colon + 1);
  if (const auto second = text.find(':'); entry.default_seed && second != std::string_view::npos) {
    const std::string_view word = text.substr(second + 1);
    out.seed = integer_from<std::uint64_t>(word);
    if (!out.seed) refuse("the seed is not a number", "0 or more", word);
    text = text.substr(0, second);
  }
  const auto count = integer_from<int>(text);
  if (!count || *count < 1 || *count > kMost)
    refuse("the number of Gaussians is out of range", fmt::format("1..{}", kMost), text);
  out.count = *count;
  return out;
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
  const auto [count, seed] = numbers_of(*entry, name);
  GaussianCloud cloud{.name = fmt::format("{}:{}", entry->name, count),
                      .source = fmt::format("built-in {}, {} Gaussians", entry->name, count),
                      .up = UpAxis::Z};
  if (seed && seed != entry->default_seed) {
    cloud.name += fmt::format(":{}", *seed);
    cloud.source += fmt::format(", seed {}", *seed);
  }
  entry->make(count, seed.value_or(0), cloud);
  return cloud;
}

}  // namespace fastsplat::scene
