// SPDX-License-Identifier: Apache-2.0
// The proved worst case where every sample is composited, of ellipses, of 3-D Gaussians, of colours above 1 and of
// densities.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "analysis/errors/bound.hpp"
#include "base/error.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/errors/bound_helper.hpp"
#include "tests/pipeline/mixtures_helper.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::IndexKind, stages::Chain, stages::Mixture, stages::Step, test::BoundTotals, test::hold;

constexpr std::size_t kFrames = 300;  ///< bounds of 100 random configurations, three levels each

double real_between(test::Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.between(0, 1 << 20)) / (1 << 20);
}

/// Every sample composited by itself.
scene::SceneDescription sampled(scene::SceneDescription scene) {
  scene.method = scene::Method::Westover;
  scene.slab_width = scene::SceneDescription{}.slab_width;
  scene.xray_exposure = 0.0;
  scene.xray_sheets = 1;
  return scene;
}
cmodel::Config sampling(cmodel::Config config) {
  config.composite_every_sample = 1;
  config.composite_lanes = 0;
  return config;
}

/// Shapes of one or several techniques.
scene::SceneDescription shaped(scene::SceneDescription scene, test::Random& random) {
  const bool perspective = scene.camera.projection == scene::Projection::Perspective;
  if (perspective && random.once_in(2)) scene.footprint.shape = scene::FootprintShape::Ellipse;
  if (random.once_in(2)) {
    scene.footprint.antialias = true;
    if (!perspective) scene.camera.zoom = real_between(random, 0.15, 0.6);
  }
  if (random.once_in(3)) scene.motion.translate = {real_between(random, 0.0, 3.0), 1.0, real_between(random, 0.0, 1.0)};
  if (random.once_in(4)) scene.motion.orbit = real_between(random, 1.0, 8.0);
  if (perspective && random.once_in(3)) {
    scene.lens.depth_of_field = scene::DepthOfField::Splats;
    scene.lens.aperture = real_between(random, 0.1, 1.5);
  }
  if (!perspective && random.once_in(5)) {  // thinner than the driver draws, which then makes it fainter
    scene.footprint.antialias = false;
    scene.camera.zoom = real_between(random, 0.06, 0.12);
    scene.motion.translate = {6.0, 1.0, 0.0};
  }
  return scene;
}

/// Bounds of random frames until there are enough of them; frames that a configuration cannot hold do not count.
template <class Frame>
BoundTotals at_random(std::uint64_t seed, const char* what, Frame frame) {
  test::Random random(test::seed_or(seed));
  BoundTotals totals;
  while (totals.frames < kFrames) {
    try {
      frame(random, totals);
    } catch (const UserError&) {
      continue;
    }
  }
  totals.print(what);
  return totals;
}

TEST(BoundOfEverySample, HoldsAtRandom) {
  at_random(3200, "every sample", [](test::Random& random, BoundTotals& totals) {
    const cmodel::Config config = sampling(test::random_config(random));
    const scene::Scene scene = scene::build_scene(sampled(stages::test::random_scene(random)));
    hold(Chain(scene, config), totals);
  });
}

TEST(BoundOfEverySample, HoldsOfNamedConfigurationsAndKindsOfIndex) {
  BoundTotals totals;
  for (const std::string& name : test::config_names()) {
    for (auto description : stages::test::small_scenes()) {
      const scene::Scene scene = scene::build_scene(sampled(description));
      cmodel::Config config = sampling(test::named_config(name));
      hold(Chain(scene, config), totals);
      for (const int kind : {0, 1, 2, 3, 5}) {
        config.index_kind = kind;
        if (!cmodel::first_violation(config)) hold(Chain(scene, config), totals, Known::Geometry);
      }
    }
  }
  totals.print("every sample, named configurations");
  EXPECT_GT(totals.worst, 0.5);
}

TEST(BoundOfEllipses, HoldsAtRandom) {
  std::size_t ellipses = 0;
  at_random(3201, "ellipses in sheets", [&](test::Random& random, BoundTotals& totals) {
    const cmodel::Config config = test::random_ellipse_config(random);
    const scene::Scene scene = scene::build_scene(shaped(stages::test::random_scene(random), random));
    const Chain chain(scene, config);
    hold(chain, totals);
    ellipses += chain.shaped() ? 1 : 0;
  });
  std::printf("[figure] frames with shapes: %zu (limit >= 70)\n", ellipses);
  EXPECT_GE(ellipses, 70u);
}

TEST(BoundOfEllipses, HoldsAtRandomWithEverySample) {
  at_random(3202, "ellipses, every sample", [](test::Random& random, BoundTotals& totals) {
    const cmodel::Config config = sampling(test::random_ellipse_config(random));
    const scene::Scene scene = scene::build_scene(sampled(shaped(stages::test::random_scene(random), random)));
    hold(Chain(scene, config), totals);
  });
}

TEST(BoundOfEllipses, HoldsForEveryKindOfIndexWhereItsGeometryIsKnown) {
  at_random(3203, "ellipses, other kinds of index", [](test::Random& random, BoundTotals& totals) {
    const auto kind = static_cast<IndexKind>(random.one_of({1, 2, 3, 5}));
    const cmodel::Config config = test::random_ellipse_config(random, kind);
    const scene::Scene scene = scene::build_scene(shaped(stages::test::random_scene(random), random));
    hold(Chain(scene, config), totals, Known::Geometry);
  });
}

/// `faint`: and large, so that many are seen behind each other.
scene::GaussianScene random_gaussians(test::Random& random, float brightness, bool faint = false) {
  scene::GaussianDescription description;
  description.camera.projection = random.once_in(2) ? scene::Projection::Perspective : scene::Projection::Orthographic;
  description.camera.azimuth = real_between(random, 0.0, 360.0);
  description.camera.elevation = real_between(random, -80.0, 80.0);
  description.camera.zoom = real_between(random, 0.5, 3.0);
  description.width = static_cast<int>(random.between(14, 30));
  description.height = static_cast<int>(random.between(14, 30));
  description.up = scene::UpAxis::Z;
  auto cloud = scene::make_synthetic_gaussians((random.once_in(2) ? "cloud:" : "shells:") +
                                               std::to_string(random.between(20, 150)));
  for (glm::vec3& harmonic : cloud.harmonics) harmonic *= brightness;
  for (auto& one : cloud.gaussians) {
    one.opacity *= faint ? 0.1F : 1.0F;
    one.scale *= faint ? 3.0F : 1.0F;
  }
  return scene::build_gaussian_scene(description, std::make_shared<scene::GaussianCloud>(std::move(cloud)));
}

TEST(BoundOfGaussians, HoldsAtRandom) {
  at_random(3204, "3-D Gaussians", [](test::Random& random, BoundTotals& totals) {
    const auto kind = static_cast<IndexKind>(random.one_of({1, 2, 3, 4, 4, 4, 5}));
    const cmodel::Config config = sampling(test::random_ellipse_config(random, kind));
    const scene::GaussianScene scene = random_gaussians(random, static_cast<float>(random.one_of({1, 1, 2, 12})));
    hold(Chain(scene, config), totals);
  });
}

cmodel::Config bright(cmodel::Config config, test::Random& random) {
  config.colour_int_bits = static_cast<int>(random.between(1, 4));
  config.colour_frac_bits = std::min(config.colour_frac_bits, 16 - config.colour_int_bits);
  return config;
}

TEST(BoundOfBrightColours, HoldsAtRandomOfGaussians) {
  double brightest = 0.0;
  at_random(3205, "colours above 1, 3-D Gaussians", [&](test::Random& random, BoundTotals& totals) {
    const cmodel::Config config = bright(sampling(test::random_ellipse_config(random)), random);
    const scene::GaussianScene scene = random_gaussians(random, static_cast<float>(real_between(random, 1.0, 12.0)));
    const Chain chain(scene, config);
    for (const golden::Sums& pixel : chain(Mixture{}).pixels) brightest = std::max(brightest, pixel[0]);
    hold(chain, totals);
  });
  std::printf("[figure] brightest pixel: %.2f (limit > 2)\n", brightest);
  EXPECT_GT(brightest, 2.0);
}

TEST(BoundOfBrightColours, HoldsAtRandomOfVolumes) {
  at_random(3206, "colours above 1, volumes", [](test::Random& random, BoundTotals& totals) {
    const bool samples = random.once_in(2), shapes = random.once_in(2);
    cmodel::Config config = bright(shapes ? test::random_ellipse_config(random) : test::random_config(random), random);
    auto description = stages::test::random_scene(random);
    if (shapes) description = shaped(description, random);
    const scene::Scene scene = scene::build_scene(samples ? sampled(description) : description);
    if (samples) config = sampling(config);
    hold(Chain(scene, config), totals);
  });
}

/// Footprints wider than a record's reach, which is 31 pixels with position words this short (N-8-85).
TEST(BoundOfGaussians, HoldsWhereARecordsReachClips) {
  BoundTotals totals;
  scene::GaussianDescription description;
  description.camera.zoom = 3.0;
  description.width = 120, description.height = 40;
  description.up = scene::UpAxis::Z;
  auto cloud = scene::make_synthetic_gaussians("cloud:40");
  for (auto& one : cloud.gaussians) one.scale *= 4.0F;
  const auto scene = scene::build_gaussian_scene(description, std::make_shared<scene::GaussianCloud>(std::move(cloud)));
  cmodel::Config config = sampling(test::named_config("ellipse"));
  config.tile_width = config.tile_height = 32;
  config.rlut_columns = 8;
  config.position_int_bits = 7;
  ASSERT_FALSE(cmodel::first_violation(config));
  const Chain chain(scene, config);
  hold(chain, totals);
  totals.print("clipped at a record's reach");
  Mixture geometry = known_steps(Known::Geometry), whole = geometry;
  whole.set(Step::Distance, false);
  const auto clipped = chain(geometry), all = chain(whole);
  double lost = 0.0;
  for (std::size_t i = 0; i < all.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) lost = std::max(lost, std::abs(all.pixels[i][c] - clipped.pixels[i][c]));
  }
  std::printf("[figure] most that is clipped: %.4g (limit > 0.01)\n", lost);
  EXPECT_GT(lost, 0.01);
}

/// Steps that can stand alone, or groups of them. An ellipse's distance goes with the words of its centre and shape,
/// which place its records.
const std::vector<std::vector<Step>>& alone() {
  static const std::vector<std::vector<Step>> kAlone{{Step::Position, Step::Snap},
                                                     {Step::Radius},
                                                     {Step::Position, Step::Snap, Step::Radius, Step::Distance},
                                                     {Step::Index},
                                                     {Step::Weight},
                                                     {Step::Emission},
                                                     {Step::Depth},
                                                     {Step::Phi},
                                                     {Step::Share},
                                                     {Step::Product},
                                                     {Step::Factor, Step::Slab},
                                                     {Step::Composite},
                                                     {Step::Freeze}};
  return kAlone;
}

/// In which steps can stand alone: nothing is diffused, products and slabs of any numbers lose bits, and sums do not
/// saturate.
cmodel::Config isolating(cmodel::Config config) {
  config.rounding_carry = static_cast<int>(cmodel::Carry::Off);
  config.colour_frac_bits = 16 - config.colour_int_bits;
  config.radial_frac_bits = 16;
  config.sheet_int_bits = 8;
  config.sheet_frac_bits = std::clamp(config.sheet_frac_bits, 8, 20);
  config.opacity_frac_bits = 16;
  config.composite_frac_bits = std::min(config.composite_frac_bits, config.sheet_frac_bits - 1);
  config.freeze_below = std::min(config.freeze_below, 1 << config.composite_frac_bits);
  return config;
}
scene::SceneDescription isolating(scene::SceneDescription scene) {
  scene.opacity_scale = std::min(scene.opacity_scale, 16.0);
  return scene;
}

/// Bounds of each of them, in frames of `frame`(random, visit), which calls visit(chain).
template <class Frame>
void each_alone(std::uint64_t seed, const char* what, const std::vector<std::vector<Step>>& all, Frame frame) {
  for (const auto& steps : all) {
    test::Random random(test::seed_or(seed));
    BoundTotals totals;
    for (int i = 0; i < 40; ++i) {
      try {
        frame(random, [&](const Chain& chain) { hold(chain, Mixture{}.with(steps), totals); });
      } catch (const UserError&) {
        continue;
      }
    }
    totals.print(std::string(what) + ", " + Mixture{}.with(steps).text() + " alone");
    EXPECT_GT(totals.frames, 20u);
  }
}

TEST(BoundOfEllipses, HoldsForEachStepAlone) {
  each_alone(3210, "ellipses", alone(), [](test::Random& random, auto visit) {
    const cmodel::Config config = isolating(test::random_ellipse_config(random));
    const scene::Scene scene = scene::build_scene(isolating(shaped(stages::test::random_scene(random), random)));
    visit(Chain(scene, config));
  });
}

/// Single splats thinner than the driver draws, which makes them wider and fainter.
TEST(BoundOfEllipses, HoldsForThinOnes) {
  test::Random random(test::seed_or(3216));
  BoundTotals totals;
  std::size_t thin = 0;
  while (totals.frames < kFrames) {
    const cmodel::Config config = isolating(test::random_ellipse_config(random));
    auto description = isolating(stages::test::random_scene(random));
    description.camera.projection = scene::Projection::Orthographic;
    description.camera.zoom = std::exp2(real_between(random, -8.0, -3.0));
    description.motion.translate = {6.0, 1.0, 0.0};
    description.volume = "shells:8";
    const int x = static_cast<int>(random.between(1, 6)), y = static_cast<int>(random.between(1, 6));
    description.crop = {.low = {x, y, 2}, .high = {x, y, 2}};
    try {
      const scene::Scene scene = scene::build_scene(description);
      const Chain chain(scene, config);
      if (chain.splats() == 0) continue;
      const double real = chain.staged(Mixture{}, false, 1).splats[0].value[3];
      if (chain.staged(Mixture{Step::Radius}, false, 1).splats[0].value[3] > 0.9 * real) continue;
      ++thin;
      hold(chain, totals);
      hold(chain, Mixture{Step::Radius}, totals);
    } catch (const UserError&) {
      continue;
    }
  }
  totals.print("thin ellipses");
  std::printf("[figure] single splats that are fainter by a tenth or more: %zu (limit >= 50)\n", thin);
  EXPECT_GE(thin, 50u);
}

/// Few voxels and thick slabs: a single boundary that moves is seen.
TEST(BoundOfEllipses, HoldsForDepthsOfGrownKernels) {
  test::Random random(test::seed_or(3213));
  BoundTotals totals;
  double grown = 1.0;
  for (int frame = 0; frame < 300; ++frame) {
    cmodel::Config config = isolating(test::random_ellipse_config(random));
    config.slice_phase_bits = static_cast<int>(random.between(2, 6));
    config.slice_frac_bits = 24;
    auto description = isolating(stages::test::random_scene(random));
    description.method = scene::Method::ImageAligned;
    description.camera.projection = scene::Projection::Orthographic;
    description.footprint.antialias = true;
    description.camera.zoom = real_between(random, 0.1, 0.5);
    description.slab_width = real_between(random, 3.0, 8.0);
    description.volume = "shells:8";
    const int x = static_cast<int>(random.between(1, 5)), y = static_cast<int>(random.between(1, 5)),
              z = static_cast<int>(random.between(1, 4));
    description.crop = {.low = {x, y, z}, .high = {x, y, z + 2}};
    try {
      const scene::Scene scene = scene::build_scene(description);
      const Chain chain(scene, config);
      hold(chain, Mixture{Step::Depth}, totals);
      hold(chain, Mixture{Step::Depth, Step::Phi}, totals);
      for (const auto& shape : chain.staged(Mixture{}, false, 1).shapes) grown = std::max(grown, shape.growth.real);
    } catch (const UserError&) {
      continue;
    }
  }
  totals.print("depths of grown kernels");
  EXPECT_GT(totals.frames, 100u);
  std::printf("[figure] largest growth: %.2f (limit > 2)\n", grown);
  EXPECT_GT(grown, 2.0);
}

/// Colours that would be brighter than a composited word can hold, U (1+ci).tf, in a picture that could show them.
TEST(BoundOfBrightColours, HoldsWhereCompositedColoursEnd) {
  test::Random random(test::seed_or(3215));
  BoundTotals totals;
  std::size_t ended = 0;
  for (int frame = 0; frame < 20; ++frame) {
    cmodel::Config config = sampling(test::named_config("ellipse"));
    config.pixel_int_bits = 5;
    const scene::GaussianScene scene = random_gaussians(random, 12.0F, true);
    const Chain chain(scene, config);
    hold(chain, totals);
    for (const golden::Sums& pixel : chain(Mixture::all_device()).pixels) ended += pixel[0] >= 1.99 ? 1 : 0;
  }
  totals.print("composited colours that end");
  std::printf("[figure] pixels at the end: %zu (limit > 0)\n", ended);
  EXPECT_GT(ended, 0u);
}

/// Layers whose added opacities pass 1 by what a step moves them, before others of nearly the same colour.
TEST(BoundOfBrightColours, HoldsWhereAddedOpacitiesEndAtOne) {
  test::Random random(test::seed_or(3214));
  BoundTotals totals;
  for (int frame = 0; frame < 150; ++frame) {
    const cmodel::Config config = isolating(test::random_config(random));
    auto description = stages::test::random_scene(random);
    description.method = scene::Method::ImageAligned;
    description.slab_opacity = scene::SlabOpacity::Additive;
    description.opacity_scale = real_between(random, 1.0, 12.0);
    try {
      const scene::Scene scene = scene::build_scene(description);
      const Chain chain(scene, config);
      for (const auto& steps : {Mixture{Step::Position, Step::Snap}, Mixture{Step::Radius}, Mixture{Step::Index}})
        hold(chain, steps, totals);
    } catch (const UserError&) {
      continue;
    }
  }
  totals.print("added opacities about 1");
  EXPECT_GT(totals.frames, 100u);
}

TEST(BoundOfEverySample, HoldsForEachStepAlone) {
  each_alone(3211, "every sample", alone(), [](test::Random& random, auto visit) {
    const cmodel::Config config = isolating(sampling(test::random_config(random)));
    const scene::Scene scene = scene::build_scene(isolating(sampled(stages::test::random_scene(random))));
    visit(Chain(scene, config));
  });
}

TEST(BoundOfGaussians, HoldsForEachStepAlone) {
  each_alone(3212, "3-D Gaussians", alone(), [](test::Random& random, auto visit) {
    const cmodel::Config config = isolating(sampling(test::random_ellipse_config(random)));
    const scene::GaussianScene scene = random_gaussians(random, 1.0F);
    visit(Chain(scene, config));
  });
}

TEST(BoundOfDensities, HoldsAtRandom) {
  std::size_t ellipses = 0;
  at_random(3220, "densities", [&](test::Random& random, BoundTotals& totals) {
    const bool shapes = random.once_in(2);
    cmodel::Config config = shapes ? test::random_ellipse_config(random) : test::random_density_config(random);
    if (shapes) config.classify_segment_bits = static_cast<int>(random.between(4, 9));
    auto description = stages::test::random_density_scene(random);
    if (shapes) description = shaped(description, random);
    const scene::Scene scene = scene::build_scene(description);
    const Chain chain(scene, config);
    hold(chain, totals);
    ellipses += chain.shaped() ? 1 : 0;
  });
  std::printf("[figure] frames with shapes: %zu (limit >= 10)\n", ellipses);
  EXPECT_GE(ellipses, 10u);
}

TEST(BoundOfDensities, HoldsOfNamedConfigurations) {
  BoundTotals totals;
  for (const std::string& name : test::config_names()) {
    for (const auto& description : stages::test::small_density_scenes()) {
      const scene::Scene scene = scene::build_scene(description);
      cmodel::Config config = test::named_config(name);
      config.classify_segment_bits = 8;
      if (!cmodel::first_violation(config)) hold(Chain(scene, config), totals);
    }
  }
  totals.print("densities, named configurations");
  EXPECT_GT(totals.worst, 0.5);
}

/// One or two voxels, whose densities err as far as the bound says, and mostly little light but that of gradients.
TEST(BoundOfDensities, HoldsForSingleSplats) {
  test::Random random(test::seed_or(3223));
  BoundTotals totals;
  for (int frame = 0; frame < 400; ++frame) {
    cmodel::Config config = isolating(test::random_density_config(random));
    config.position_frac_bits = std::min(config.position_frac_bits, 3);
    auto description = isolating(stages::test::random_density_scene(random));
    description.volume = "marschner-lobb:12";
    description.transfer_function = random.once_in(2) ? "terrain" : "linear";
    description.shading = 1;
    description.opacity_scale = 16.0;
    const int x = static_cast<int>(random.between(2, 8)), y = static_cast<int>(random.between(2, 8));
    description.crop = {.low = {x, y, 4}, .high = {x, y, 4 + static_cast<int>(random.between(0, 1))}};
    try {
      const scene::Scene scene = scene::build_scene(description);
      const Chain chain(scene, config);
      hold(chain, totals);
      for (const auto& steps : {Mixture{Step::Position, Step::Snap}, Mixture{Step::Index}, Mixture{Step::Depth}})
        hold(chain, steps, totals);
    } catch (const UserError&) {
      continue;
    }
  }
  totals.print("single splats of densities");
  EXPECT_GT(totals.frames, 500u);
}

TEST(BoundOfDensities, HoldsForEachStepAlone) {
  std::vector<std::vector<Step>> of_densities;
  for (const Step step : stages::all_steps()) {
    if (stages::of_densities(step)) of_densities.push_back({step});
  }
  of_densities.push_back({Step::Slope, Step::Normal, Step::Facing});
  each_alone(3221, "densities", of_densities, [](test::Random& random, auto visit) {
    const cmodel::Config config = isolating(test::random_density_config(random));
    const scene::Scene scene = scene::build_scene(isolating(stages::test::random_density_scene(random)));
    visit(Chain(scene, config));
  });
  each_alone(3222, "densities", alone(), [](test::Random& random, auto visit) {
    const cmodel::Config config = isolating(test::random_density_config(random));
    const scene::Scene scene = scene::build_scene(isolating(stages::test::random_density_scene(random)));
    visit(Chain(scene, config));
  });
}

}  // namespace
}  // namespace fastsplat::analysis
