// SPDX-License-Identifier: Apache-2.0
// What a file of Gaussians costs: which Gaussian became which, and which attribute the error comes from.
#include "analysis/errors/file_errors.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "analysis/errors/matched_gaussians.hpp"
#include "golden/gaussians.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::analysis {
namespace {

using scene::GaussianCloud;

cmodel::Config config() {
  cmodel::Config config = fastsplat::test::named_config("ellipse");
  config.composite_every_sample = 1;
  config.freeze_below = 7;
  return config;
}

scene::GaussianScene scene_of(const GaussianCloud& cloud) {
  scene::GaussianDescription description;
  description.width = 90, description.height = 70;
  description.up = scene::UpAxis::Z;
  return scene::build_gaussian_scene(description, std::make_shared<GaussianCloud>(cloud));
}

/// The cloud in another order: number i goes to place order[i].
GaussianCloud permuted(const GaussianCloud& cloud, std::vector<std::uint32_t>& order) {
  fastsplat::test::Random random(5);
  order.resize(cloud.gaussians.size());
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t i = order.size(); i > 1; --i)
    std::swap(order[i - 1], order[static_cast<std::size_t>(random.between(0, static_cast<std::int64_t>(i) - 1))]);
  GaussianCloud out = cloud;
  const auto terms = static_cast<std::size_t>(scene::harmonic_count(cloud.degree));
  for (std::size_t i = 0; i < order.size(); ++i) {
    out.gaussians[order[i]] = cloud.gaussians[i];
    std::ranges::copy(cloud.harmonics_of(i), out.harmonics.begin() + static_cast<std::ptrdiff_t>(order[i] * terms));
  }
  return out;
}

double share(const FileErrors& errors, const std::string& name) {
  const auto found = std::ranges::find(errors.parts, name, &FileError::name);
  EXPECT_NE(found, errors.parts.end()) << name;
  return found == errors.parts.end() ? 0.0 : found->share;
}

double sum_of_shares(const FileErrors& errors) {
  return std::accumulate(errors.parts.begin(), errors.parts.end(), 0.0,
                         [](double sum, const FileError& part) { return sum + part.share; });
}

FileErrors errors_of(const GaussianCloud& original, const GaussianCloud& encoded) {
  return file_errors(scene_of(original), encoded, config(), 2, {});
}

TEST(FileErrors, GaussiansAreFoundAgain) {
  for (const char* name : {"cloud:2000", "shells:3000"}) {
    const GaussianCloud cloud = scene::make_synthetic_gaussians(name);
    std::vector<std::uint32_t> order;
    GaussianCloud rounded = permuted(cloud, order);
    for (scene::Gaussian& one : rounded.gaussians) {
      one.position = glm::round(one.position * 512.0F) / 512.0F;
      one.scale = glm::exp(glm::round(glm::log(one.scale) * 16.0F) / 16.0F);
      one.opacity = std::round(one.opacity * 255.0F) / 255.0F;
    }
    std::size_t right = 0;
    const auto matches = matched_gaussians(cloud, rounded);
    std::vector<char> taken(order.size(), 0);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      ASSERT_TRUE(matches[i]);
      EXPECT_EQ(taken[*matches[i]]++, 0) << "twice";
      right += *matches[i] == order[i] ? 1U : 0U;
    }
    std::printf("[figure] %s, rounded and permuted: %zu of %zu found again\n", name, right, order.size());
    EXPECT_EQ(right, order.size());
    // Many at one place: the others decide.
    for (scene::Gaussian& one : rounded.gaussians) one.position = glm::round(one.position * 8.0F) / 8.0F;
    std::size_t found = 0, lost = 0;
    const auto coarse = matched_gaussians(cloud, rounded);
    for (std::size_t i = 0; i < coarse.size(); ++i)
      found += coarse[i] == order[i] ? 1U : 0U, lost += coarse[i] ? 0U : 1U;
    std::printf("[figure] %s, many at one place: %zu found again, %zu without a match\n", name, found, lost);
    EXPECT_GT(found, order.size() * 3 / 4);
    // In the same order nothing is searched, however alike neighbours are.
    GaussianCloud alike = cloud;
    for (scene::Gaussian& one : alike.gaussians) one.scale = glm::vec3(0.02F), one.opacity = 0.5F;
    const auto same = matched_gaussians(alike, alike);
    for (std::size_t i = 0; i < same.size(); ++i) ASSERT_EQ(same[i], i);
  }
}

TEST(FileErrors, TheSameSceneInAnotherOrderCostsNothing) {
  const GaussianCloud cloud = scene::make_synthetic_gaussians("shells:500");
  std::vector<std::uint32_t> order;
  const FileErrors errors = errors_of(cloud, permuted(cloud, order));
  EXPECT_EQ(errors.matched, 500U);
  EXPECT_EQ(errors.file.rms, 0.0);
  EXPECT_GT(errors.device.rms, 0.0);
  double device = 0.0;
  for (const FileError& part : errors.parts) {
    if (part.of_device) {
      device += part.share;
    } else {
      EXPECT_EQ(part.share, 0.0) << part.name;
    }
  }
  EXPECT_NEAR(device, 1.0, 1e-3);  // golden's picture has floats
}

TEST(FileErrors, ManyGaussiansInOnePlaceAreFoundAgain) {
  GaussianCloud cloud = scene::make_synthetic_gaussians("shells:200");
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) cloud.gaussians[i].position = glm::vec3(i / 40);
  const auto matches = matched_gaussians(cloud, cloud);
  std::size_t own = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) own += matches[i] == i ? 1 : 0;
  std::printf("[figure] found, 40 in each place = %zu (limit 200)\n", own);
  EXPECT_EQ(own, 200U);
}

// Pruned Gaussians take no neighbour's partner.
TEST(FileErrors, PrunedGaussiansAreLost) {
  const GaussianCloud cloud = scene::make_synthetic_gaussians("cloud:1000");
  GaussianCloud pruned = cloud;
  pruned.gaussians.clear(), pruned.harmonics.clear();
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    if (i % 20 == 7) continue;
    pruned.gaussians.push_back(cloud.gaussians[i]);
    const auto own = cloud.harmonics_of(i);
    pruned.harmonics.insert(pruned.harmonics.end(), own.begin(), own.end());
  }
  const auto matches = matched_gaussians(cloud, pruned);
  for (std::size_t i = 0; i < matches.size(); ++i) EXPECT_EQ(matches[i].has_value(), i % 20 != 7) << i;
  const FileErrors errors = errors_of(cloud, pruned);
  std::printf("[figure] share of lost Gaussians = %.4f\n", share(errors, "lost, added"));
  EXPECT_EQ(errors.matched, 950U);
  EXPECT_GT(share(errors, "lost, added"), 0.99);
}

TEST(FileErrors, TheAttributeThatChangedHasTheShare) {
  const GaussianCloud cloud = scene::make_synthetic_gaussians("shells:500");
  using Change = void (*)(GaussianCloud&);
  const std::vector<std::pair<std::string, Change>> changes{
      {"position",
       [](GaussianCloud& c) {
         for (auto& one : c.gaussians) one.position = glm::round(one.position * 100.0F) / 100.0F;
       }},
      {"rotation",
       [](GaussianCloud& c) {
         for (auto& one : c.gaussians) one.rotation = glm::normalize(glm::round(one.rotation * 6.0F));
       }},
      {"scale",
       [](GaussianCloud& c) {
         for (auto& one : c.gaussians) one.scale *= 1.2F;
       }},
      {"opacity",
       [](GaussianCloud& c) {
         for (auto& one : c.gaussians) one.opacity *= 0.9F;
       }},
      {"colour",
       [](GaussianCloud& c) {
         for (std::size_t i = 0; i < c.harmonics.size(); i += 16) c.harmonics[i] *= 0.9F;
       }},
      {"harmonics 2",
       [](GaussianCloud& c) {
         for (std::size_t i = 4; i < c.harmonics.size(); i += 16) c.harmonics[i] += 0.1F;
       }},
      {"lost, added", [](GaussianCloud& c) { c.gaussians.resize(450), c.harmonics.resize(std::size_t{450} * 16); }},
  };
  for (const auto& [name, change] : changes) {
    GaussianCloud other = cloud;
    change(other);
    std::vector<std::uint32_t> order;
    const FileErrors errors = errors_of(cloud, permuted(other, order));
    std::printf("[figure] %s changed: its share %.4f, all shares %.6f, file %.2f LSB8, device %.3f LSB8\n",
                name.c_str(), share(errors, name), sum_of_shares(errors), errors.file.rms * 255.0,
                errors.device.rms * 255.0);
    EXPECT_NEAR(sum_of_shares(errors), 1.0, 1e-3);
    EXPECT_GT(errors.file.rms, 5.0 * errors.device.rms);
    EXPECT_GT(share(errors, name), 0.95) << name;
    for (const FileError& part : errors.parts) {
      if (part.of_device) continue;
      if (part.name == name) {
        EXPECT_GT(part.only.rms, 0.0);
      } else {
        EXPECT_LT(part.only.rms, 0.02 * errors.file.rms) << part.name;
      }
    }
  }
}

// A format without harmonics: what they did is lost, by degree.
TEST(FileErrors, LostHarmonicsAreOfTheirDegrees) {
  const GaussianCloud cloud = scene::make_synthetic_gaussians("shells:500");
  GaussianCloud flat = cloud;
  flat.degree = 0;
  flat.harmonics.clear();
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) flat.harmonics.push_back(cloud.harmonics_of(i)[0]);
  const FileErrors errors = errors_of(cloud, flat);
  double harmonics = 0.0;
  for (const int degree : {1, 2, 3}) harmonics += share(errors, "harmonics " + std::to_string(degree));
  std::printf("[figure] share of harmonics = %.4f\n", harmonics);
  EXPECT_GT(harmonics, 0.95);
  const std::string text = to_text(errors, 8);
  for (const char* word : {"500 matched", "= file", "= device", "both", "100.0 %"})
    EXPECT_NE(text.find(word), std::string::npos) << text;
  // Added ones are of their degrees, too.
  double added = 0.0;
  const FileErrors back = errors_of(flat, cloud);
  for (const int degree : {1, 2, 3}) added += share(back, "harmonics " + std::to_string(degree));
  EXPECT_GT(added, 0.95);
  // Degree 0 has no rows of harmonics.
  EXPECT_EQ(std::ranges::count_if(errors_of(flat, flat).parts,
                                  [](const FileError& part) { return part.name.starts_with("harmonics"); }),
            0);
}

}  // namespace
}  // namespace fastsplat::analysis
