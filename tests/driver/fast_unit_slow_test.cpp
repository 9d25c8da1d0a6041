// SPDX-License-Identifier: Apache-2.0
// The fast unit gives the plain unit's words, counters and report for whole frames. Configurations, methods, views,
// threads and heights of bands vary, and so do the vector instructions that this processor has.
#include <gtest/gtest.h>

#include <memory>

#include "driver/config/config_file.hpp"
#include "scene/gaussians/synthetic_gaussians.hpp"
#include "tests/driver/fast_unit_helper.hpp"

namespace fastsplat::driver {
namespace {

struct Change {
  const char* name;
  void (*apply)(scene::SceneDescription&);
};
const Change kMethods[] = {
    {"image", [](scene::SceneDescription&) {}},
    {"image_opaque", [](scene::SceneDescription& d) { d.opacity_scale = 12; }},
    {"image_additive", [](scene::SceneDescription& d) { d.slab_opacity = scene::SlabOpacity::Additive; }},
    {"image_wide_slab", [](scene::SceneDescription& d) { d.slab_width = 3.7; }},
    {"axis", [](scene::SceneDescription& d) { d.method = scene::Method::AxisAligned; }},
    {"xray", [](scene::SceneDescription& d) { d.method = scene::Method::XRay; }},
    {"xray_bright", [](scene::SceneDescription& d) { d.method = scene::Method::XRay, d.xray_exposure = 3.0; }},
};
const Change kViews[] = {
    {"turned", [](scene::SceneDescription& d) { d.camera.azimuth = 33, d.camera.elevation = 21, d.camera.roll = 5; }},
    {"near", [](scene::SceneDescription& d) { d.camera.azimuth = -50, d.camera.zoom = 2.3; }},
    {"far", [](scene::SceneDescription& d) { d.camera.zoom = 0.4; }},
    {"above", [](scene::SceneDescription& d) { d.camera.azimuth = 10, d.camera.elevation = 80, d.camera.zoom = 1.3; }},
    {"perspective",
     [](scene::SceneDescription& d) {
       d.camera.projection = scene::Projection::Perspective, d.camera.azimuth = 20, d.camera.fov = 45;
     }},
};

TEST(FastUnit, DrawsThePlainUnitsWordsAndCounters) {
  UnitsCompared compared;
  for (const auto& name : config_names()) {
    for (const Change& method : kMethods) {
      for (const Change& view : kViews) {
        for (const char* volume : {"shells:16", "marschner-lobb:18"}) {
          scene::SceneDescription description;
          description.volume = volume;
          description.transfer_function = std::string(volume).starts_with("shells") ? "ct-head" : "default";
          description.width = 75, description.height = 50;
          method.apply(description);
          view.apply(description);
          compared.frame(name, name + " " + method.name + " " + view.name + " " + volume, description,
                         load_config(name));
        }
      }
    }
  }
  compared.finish();
  EXPECT_GT(compared.combinations(), 300u);
  EXPECT_GT(compared.pictures(), 1500u);
}

// Individual footprints, in sheets and sample by sample; kernels that grow in depth; splats that freeze whole blocks.
const Change kShapes[] = {
    {"perspective",
     [](scene::SceneDescription& d) {
       d.camera.projection = scene::Projection::Perspective, d.camera.fov = 60;
       d.footprint.shape = scene::FootprintShape::Ellipse;
     }},
    {"antialias", [](scene::SceneDescription& d) { d.footprint.antialias = true, d.camera.zoom = 0.3; }},
    {"motion",
     [](scene::SceneDescription& d) {
       d.motion.translate = {30.0, 11.0, 5.0};
     }},
    {"orbit", [](scene::SceneDescription& d) { d.motion.orbit = 14, d.camera.zoom = 1.7; }},
    {"lens",
     [](scene::SceneDescription& d) {
       d.lens.depth_of_field = scene::DepthOfField::Splats, d.lens.aperture = 1.5;
       d.camera.projection = scene::Projection::Perspective;
     }},
    {"mixed",
     [](scene::SceneDescription& d) {
       d.camera.projection = scene::Projection::Perspective, d.footprint.shape = scene::FootprintShape::Ellipse;
       d.footprint.antialias = true, d.motion.orbit = 6, d.opacity_scale = 12;
     }},
    {"circles", [](scene::SceneDescription&) {}},
};

TEST(FastUnit, DrawsEllipsesAndSamplesAsThePlainUnit) {
  UnitsCompared compared;
  for (const bool samples : {false, true}) {
    for (const char* name : {"ellipse", "base", "compact"}) {
      cmodel::Config config = load_config(name);
      config.composite_every_sample = samples ? 1 : 0;
      for (const Change& method : kMethods) {
        for (const Change& shape : kShapes) {
          scene::SceneDescription description;
          description.volume = "shells:16";
          description.width = 150, description.height = 140;  // tiles that the image cuts
          description.camera.azimuth = 25, description.camera.elevation = 15;
          method.apply(description);
          shape.apply(description);
          if (samples && description.method != scene::Method::ImageAligned) continue;
          if (samples) description.method = scene::Method::Westover;
          if (!config.has_ellipses() && (!samples || std::string(shape.name) != "circles")) continue;
          compared.frame(name + std::string(samples ? ", every sample" : ""),
                         std::string(name) + " " + method.name + " " + shape.name, description, config);
        }
      }
    }
  }
  compared.finish();
  EXPECT_GT(compared.combinations(), 60u);
}

// Densities: blocks of the rim, tiles that read each other's edges, ellipses, pictures in the footprints.
TEST(FastUnit, DrawsDensitiesAsThePlainUnit) {
  const Change densities[] = {
      {"whole slabs", [](scene::SceneDescription&) {}},
      {"thin slabs", [](scene::SceneDescription& d) { d.slab_width = 0.5; }},
      {"additive", [](scene::SceneDescription& d) { d.slab_opacity = scene::SlabOpacity::Additive; }},
      {"ellipses", [](scene::SceneDescription& d) { d.footprint.shape = scene::FootprintShape::Ellipse; }},
      {"textured",
       [](scene::SceneDescription& d) {
         d.footprint.texture = {8, 0.7, 0, 0.4};
       }},
  };
  UnitsCompared compared;
  for (const char* name : {"base", "small", "fine", "tiny"}) {
    for (const Change& what : densities) {
      for (const Change& view : {kViews[0], kViews[3]}) {
        scene::SceneDescription description;
        description.volume = "marschner-lobb:18";
        description.transfer_function = "ct-head";
        description.classify = scene::ClassifyOrder::Post;
        description.width = 75, description.height = 50;
        what.apply(description);
        view.apply(description);
        auto config = load_config(name);
        config.classify_segment_bits = std::min(9, config.sheet_frac_bits);
        const bool shaped = std::string(what.name) == "ellipses", textured = std::string(what.name) == "textured";
        if (shaped) config.ellipse_frac_bits = 12, config.radial_interpolate = 0;
        if (textured) {
          config.index_kind = static_cast<int>(cmodel::IndexKind::Blit2d), config.radial_interpolate = 0;
          config.phases = 8, config.radial_int_bits = 1;
        }
        if (cmodel::first_violation(config)) continue;
        compared.frame(name, std::string(name) + " " + what.name + " " + view.name, description, config);
      }
    }
  }
  compared.finish();
  EXPECT_GT(compared.combinations(), 30u);
}

TEST(FastUnit, DrawsGaussiansAsThePlainUnit) {
  UnitsCompared compared;
  for (const char* cloud : {"shells:1500", "cloud:400"}) {
    scene::GaussianDescription description;
    description.width = 300, description.height = 200;
    auto bright = scene::make_synthetic_gaussians(cloud);
    for (glm::vec3& harmonic : bright.harmonics) harmonic *= 2.0F;
    const auto scene =
        scene::build_gaussian_scene(description, std::make_shared<scene::GaussianCloud>(std::move(bright)));
    const auto projected = scene::project_all(scene);
    // 12: products in lanes of 16 bits, colours that are cut; 15, 14: colours that may exceed 1
    for (const int colour_bits : {16, 12, 15, 14}) {
      for (const int freeze_below : {0, 7, 4096}) {
        cmodel::Config config = load_config("ellipse");
        config.composite_every_sample = 1;
        config.freeze_below = freeze_below;
        config.colour_frac_bits = colour_bits;
        if (colour_bits == 15 || colour_bits == 14) config.colour_int_bits = 1;
        if (colour_bits == 14) config.sheet_int_bits = 4;
        if (colour_bits == 12) config.sheet_frac_bits = 12, config.radial_frac_bits = 12;
        compared.gaussians(std::string(cloud) + ", freeze below " + std::to_string(freeze_below),
                           GaussianFrame(scene, projected, config));
      }
    }
  }
  compared.finish();
  EXPECT_EQ(compared.combinations(), 24u);
  EXPECT_GE(compared.pictures(), 24u);
  EXPECT_GT(compared.left_out(), 0u);
}

}  // namespace
}  // namespace fastsplat::driver
