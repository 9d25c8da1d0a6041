// SPDX-License-Identifier: Apache-2.0
#include "cli/gaussian_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "base/hash_text.hpp"
#include "base/printable.hpp"
#include "cli/output.hpp"
#include "scene/gaussians/gaussian_scene.hpp"
#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;

/// Least, median and largest of some numbers, which it reorders.
struct Spread {
  explicit Spread(std::vector<float> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    median = *middle;
    low = *std::ranges::min_element(values);
    high = *std::ranges::max_element(values);
  }
  float low = 0.0F, median = 0.0F, high = 0.0F;
};
Json json_of(const Spread& spread) { return {{"low", spread.low}, {"median", spread.median}, {"high", spread.high}}; }
std::string text_of(const Spread& spread) {
  // Turns -0 into 0.
  return fmt::format("{:.4g} to {:.4g}, median {:.4g}", spread.low + 0.0F, spread.high + 0.0F, spread.median + 0.0F);
}

/// One number of each Gaussian.
template <class Number>
Spread spread_of(const scene::GaussianCloud& cloud, const Number& number) {
  std::vector<float> values(cloud.gaussians.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(number(i));
  return Spread(std::move(values));
}
Spread positions(const scene::GaussianCloud& cloud, int axis) {
  return spread_of(cloud, [&](std::size_t i) { return cloud.gaussians[i].position[axis]; });
}
Spread scales(const scene::GaussianCloud& cloud, bool largest) {
  return spread_of(cloud, [&](std::size_t i) {
    const glm::vec3& scale = cloud.gaussians[i].scale;
    return largest ? std::max({scale.x, scale.y, scale.z}) : std::min({scale.x, scale.y, scale.z});
  });
}
Spread opacities(const scene::GaussianCloud& cloud) {
  return spread_of(cloud, [&](std::size_t i) { return cloud.gaussians[i].opacity; });
}
/// Colours of the constant harmonic alone.
Spread colours(const scene::GaussianCloud& cloud, int channel) {
  return spread_of(cloud, [&](std::size_t i) {
    return 0.5 + scene::kConstantHarmonic * static_cast<double>(cloud.harmonics_of(i)[0][channel]);
  });
}
/// The largest coefficient of each degree above 0.
std::vector<double> harmonic_sizes(const scene::GaussianCloud& cloud) {
  std::vector<double> sizes(static_cast<std::size_t>(cloud.degree), 0.0);
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const auto harmonics = cloud.harmonics_of(i);
    for (std::size_t k = 1; k < harmonics.size(); ++k) {
      double& most = sizes[k < 4 ? 0 : k < 9 ? 1 : 2];
      for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(static_cast<double>(harmonics[k][c])));
    }
  }
  return sizes;
}

std::string up_of(const scene::GaussianCloud& cloud) {
  return cloud.up ? scene::up_axis_names()[static_cast<std::size_t>(*cloud.up)] : "";
}

constexpr std::array kChannels{"red", "green", "blue"};

}  // namespace

std::string gaussian_text(const scene::GaussianCloud& cloud) {
  std::string text =
      fmt::format("scene      {}\nsource     {}\nGaussians  {}, harmonics to degree {}\n", printable(cloud.name),
                  printable(cloud.source), grouped(cloud.gaussians.size()), cloud.degree);
  for (int axis = 0; axis < 3; ++axis)
    text += fmt::format("{:<11}{}\n", std::string(1, "xyz"[axis]), text_of(positions(cloud, axis)));
  text += fmt::format("widest     {}\nnarrowest  {}\n", text_of(scales(cloud, true)), text_of(scales(cloud, false)));
  text += fmt::format("opacity    {}\n", text_of(opacities(cloud)));
  for (int c = 0; c < 3; ++c)
    text += fmt::format("{:<11}{}\n", kChannels[static_cast<std::size_t>(c)], text_of(colours(cloud, c)));
  const auto sizes = harmonic_sizes(cloud);
  for (std::size_t degree = 1; degree <= sizes.size(); ++degree)
    text += fmt::format("degree {}   coefficients to {:.4g}\n", degree, sizes[degree - 1]);
  text += fmt::format("declares   up {}{}{}{}\n", cloud.up ? up_of(cloud) : "not given",
                      cloud.antialiased ? ", trained anti-aliased" : "", cloud.linear ? ", linear colours" : "",
                      cloud.by_distance ? ", order of distances" : "");
  for (const scene::DroppedGaussians& some : cloud.dropped)
    text +=
        fmt::format("dropped    {}: {}, first Gaussian {}\n", grouped(some.count), printable(some.cause), some.first);
  return text;
}

nlohmann::ordered_json gaussian_json(const scene::GaussianCloud& cloud) {
  Json json{{"name", cloud.name},
            {"source", cloud.source},
            {"count", cloud.gaussians.size()},
            {"degree", cloud.degree},
            {"content_hash", hash_text(scene::content_hash(cloud))}};
  for (int axis = 0; axis < 3; ++axis) json["position"][std::string(1, "xyz"[axis])] = json_of(positions(cloud, axis));
  json["widest"] = json_of(scales(cloud, true));
  json["narrowest"] = json_of(scales(cloud, false));
  json["opacity"] = json_of(opacities(cloud));
  for (int c = 0; c < 3; ++c) json["colour"][kChannels[static_cast<std::size_t>(c)]] = json_of(colours(cloud, c));
  json["largest_harmonic"] = harmonic_sizes(cloud);
  json["up"] = cloud.up ? Json(up_of(cloud)) : Json(nullptr);
  json["antialiased"] = cloud.antialiased;
  json["by_distance"] = cloud.by_distance;
  json["linear"] = cloud.linear;
  json["dropped"] = Json::array();
  for (const scene::DroppedGaussians& some : cloud.dropped)
    json["dropped"].push_back({{"cause", some.cause}, {"count", some.count}, {"first", some.first}});
  json["remarks"] = cloud.remarks;
  return json;
}

}  // namespace fastsplat::cli
