// SPDX-License-Identifier: Apache-2.0
#include "driver/tiles/frame_head.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/error.hpp"
#include "cmodel/stream/records.hpp"
#include "driver/splats/projection.hpp"
#include "driver/tables/density_tables.hpp"
#include "driver/tables/index_tables.hpp"
#include "driver/tables/pattern_tables.hpp"
#include "driver/tables/tables.hpp"

namespace fastsplat::driver {

cmodel::Mode mode_of(const scene::SceneDescription& description) {
  if (description.method == scene::Method::XRay) return cmodel::Mode::Sum;
  const bool exponential = description.slab_opacity == scene::SlabOpacity::Exponential;
  if (holds_densities(description))
    return exponential ? cmodel::Mode::DensityExponential : cmodel::Mode::DensityAdditive;
  if (every_sample(description)) return exponential ? cmodel::Mode::SampleExponential : cmodel::Mode::SampleAdditive;
  return exponential ? cmodel::Mode::Exponential : cmodel::Mode::Additive;
}

namespace {

const cmodel::Config& checked(const scene::Scene& scene, const cmodel::Config& device) {
  scene::check_capability(scene, offers(device));
  check_densities(scene);
  return device;
}

/// Only radius sets have pictures; ellipses do not. Detail raises weights to 1 + m; a format that ends at 1 would cut
/// them.
scene::TexturedSplats checked_textures(const scene::Scene& scene, const cmodel::Config& config) {
  scene::TexturedSplats textures(scene.description.footprint.texture, scene.kernel);
  if (textures.phases().empty()) return textures;
  if (draws_ellipses(scene, config)) {
    throw_usage({.where = "splat_texture.amplitude",
                 .what = "the device cannot draw textured ellipses",
                 .expected = "circles, or splats without texture",
                 .got = "ellipses",
                 .fix = "use --splat-texture 0, circles without anti-aliasing, motion and lens, or --engine golden"});
  }
  if (config.radial_int_bits > 0) return textures;
  throw_usage({.where = "configuration " + config.name,
               .what = "textured splats have weights above 1",
               .expected = "radial.int_bits = 1",
               .got = "0",
               .fix = "add --set radial.int_bits=1, or use --splat-texture 0"});
}

}  // namespace

scene::SheetPlan plan_for_device(const scene::Scene& scene) {
  if (every_sample(scene.description)) return {scene::SheetUse::OneSheet, {.count = 1}};
  const scene::SheetPlan plan = scene::sheet_plan(scene);
  assert(plan.use != scene::SheetUse::None && "refused by check_capability");
  return plan;
}

scene::Offers offers(const cmodel::Config& config) {
  using scene::Method, scene::only;
  scene::Offers out{.engine = "device",
                    .methods = only(Method::ImageAligned) | only(Method::AxisAligned) | only(Method::XRay),
                    .features = 0u,
                    .footprints_fix = "choose a configuration with ellipses, ",
                    .methods_elsewhere = only(Method::Westover),
                    .methods_fix = "set composite.every_sample = 1, ",
                    .densities_fix = "set classify.segment_bits = 9, ",
                    .details_fix = "set index.kind = blit2d and snap.phases = 8, ",
                    .patterns_fix = "set pattern.node_bits = 7, "};
  if (config.has_ellipses()) {
    out.engine = "device with ellipses";
    out.features = static_cast<unsigned>(scene::Feature::Footprints);
  }
  if (config.classifies()) out.features |= static_cast<unsigned>(scene::Feature::Densities);
  if (config.has_patterns()) out.features |= static_cast<unsigned>(scene::Feature::Patterns);
  // Textured footprints have neither mirror images nor a radial table.
  if (config.index() == cmodel::IndexKind::Blit2d &&
      config.index_symmetry == static_cast<int>(cmodel::IndexSymmetry::Off))
    out.features |= static_cast<unsigned>(scene::Feature::Details);
  if (config.composite_every_sample != 0) out.methods |= only(Method::Westover);
  return out;
}

bool every_sample(const scene::SceneDescription& description) { return description.method == scene::Method::Westover; }

FrameHead::FrameHead(const scene::Scene& scene, const cmodel::Config& device, int threads)
    : config(checked(scene, device)),
      mode(mode_of(scene.description)),
      plan(plan_for_device(scene)),
      slices(frame_slices(device, scene, plan)),
      textures(checked_textures(scene, device)),
      sets(radius_sets(scene, device, std::max<std::size_t>(1, textures.phases().size()))),
      grid(device, scene.description.width, scene.description.height, holds_densities(scene.description) ? 1 : 0) {
  make_preamble(scene, threads);
}

void FrameHead::make_preamble(const scene::Scene& scene, int threads) {
  cmodel::append(preamble, cmodel::BeginFrame{cmodel::config_hash(config), grid.image_width, grid.image_height,
                                              static_cast<std::uint32_t>(grid.count())});
  cmodel::append(preamble, radial_table(config, scene.kernel));
  cmodel::append(preamble, factor_table(config));
  for (std::uint32_t set = 0; set < sets.size(); ++set) {
    cmodel::append(preamble, set_table(config, scene.kernel, set, sets.radius(set), sets.base(set),
                                       {.textures = &textures, .number = sets.picture(set)}));
  }
  const auto append_all = [this](std::vector<cmodel::LoadTable> tables) {
    for (cmodel::LoadTable& table : tables) cmodel::append(preamble, std::move(table));
  };
  if (holds_densities(scene.description)) append_all(density_tables(config, scene, plan.slabs));
  if (has_pattern(scene.description)) append_all(pattern_tables(config, scene, plan.slabs, threads));
}

}  // namespace fastsplat::driver
