// SPDX-License-Identifier: Apache-2.0
#include "tests/pipeline/mixtures_helper.hpp"

#include <cmath>

namespace fastsplat::stages::test {

namespace {

double real_between(fastsplat::test::Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random.between(0, 1 << 20)) / (1 << 20);
}

}  // namespace

scene::SceneDescription random_scene(fastsplat::test::Random& random) {
  scene::SceneDescription scene;
  scene.volume = "shells:" + std::to_string(random.between(8, 12));
  scene.width = static_cast<int>(random.between(14, 22));
  scene.height = static_cast<int>(random.between(14, 22));
  scene.kernel = "";
  scene.kernel_a = real_between(random, 1.0, 3.0);
  scene.kernel_radius = real_between(random, 1.0, 2.5);
  scene.camera.azimuth = real_between(random, 0.0, 360.0);
  scene.camera.elevation = real_between(random, -80.0, 80.0);
  scene.camera.zoom = real_between(random, 0.5, 1.3);
  if (random.once_in(2)) {
    scene.camera.projection = scene::Projection::Perspective;
    scene.camera.zoom = 1.0;
    scene.camera.fov = real_between(random, 20.0, 70.0);
  }
  scene.opacity_scale = std::exp2(real_between(random, -3.0, random.once_in(4) ? 12.0 : 4.0));
  scene.slab_width = real_between(random, 0.3, 2.5);
  scene.slab_opacity = random.once_in(2) ? scene::SlabOpacity::Additive : scene::SlabOpacity::Exponential;
  switch (random.between(0, 4)) {
    case 0:
      scene.method = scene::Method::AxisAligned;
      break;
    case 1:
      scene.method = scene::Method::XRay;
      if (random.once_in(2)) scene.xray_exposure = real_between(random, 0.01, 2.0);
      if (random.once_in(2)) scene.xray_sheets = static_cast<int>(random.between(2, 9));
      break;
    default:
      scene.method = scene::Method::ImageAligned;
  }
  if (random.once_in(4)) scene.crop = {.low = {1, 2, 0}, .high = {6, 7, 4}};
  return scene;
}

scene::SceneDescription random_density_scene(fastsplat::test::Random& random) {
  scene::SceneDescription scene = random_scene(random);
  scene.method = scene::Method::ImageAligned;
  scene.xray_exposure = 0.0;
  scene.xray_sheets = 1;
  scene.classify = scene::ClassifyOrder::Post;
  // Two volumes of many values, one of two.
  const char* const volumes[] = {"shells:", "marschner-lobb:", "binary-cube:"};
  scene.volume = volumes[random.between(0, 2)];
  scene.volume += std::to_string(random.between(8, 12));
  // All of them begin clear; "terrain" and "ct-head" are shaded by themselves.
  const char* const functions[] = {"ct-head", "bone", "soft-tissue", "linear", "terrain", "default"};
  scene.transfer_function = functions[random.between(0, 5)];
  scene.shading = static_cast<int>(random.between(-1, 1));
  scene.opacity_scale = std::exp2(real_between(random, 0.0, random.once_in(4) ? 12.0 : 5.0));
  if (scene.camera.projection == scene::Projection::Orthographic) scene.camera.zoom = real_between(random, 0.8, 2.5);
  return scene;
}

std::vector<scene::SceneDescription> small_density_scenes() {
  std::vector<scene::SceneDescription> scenes(3);
  for (scene::SceneDescription& scene : scenes) {
    scene.volume = "marschner-lobb:12";
    scene.transfer_function = "ct-head";
    scene.classify = scene::ClassifyOrder::Post;
    scene.shading = 1;
    scene.width = 20;
    scene.height = 18;
    scene.camera.azimuth = 37.0;
    scene.camera.elevation = 21.0;
  }
  scenes[0].camera.projection = scene::Projection::Perspective;
  scenes[0].slab_width = 0.7;
  scenes[1].volume = "shells:10";
  scenes[1].transfer_function = "terrain";  // with a gradient floor
  scenes[2].slab_opacity = scene::SlabOpacity::Additive;
  scenes[2].camera.zoom = 2.0;
  return scenes;
}

Mixture random_mixture(fastsplat::test::Random& random, bool densities) {
  const std::int64_t in_eight = random.one_of({1, 4, 4, 7});
  Mixture mixture;
  for (const Step step : all_steps()) {
    if (densities || !of_densities(step)) mixture.set(step, random.between(1, 8) <= in_eight);
  }
  return mixture;
}

FloatNumbers random_floats(fastsplat::test::Random& random) {
  const auto any = [&] {
    const auto last = static_cast<std::int64_t>(float_formats().size()) - 1;
    return float_formats()[static_cast<std::size_t>(random.between(0, last))];
  };
  FloatNumbers out{.operands = any(), .subnormals = random.once_in(2), .tile_centres = random.once_in(2)};
  out.sums = random.once_in(2) ? out.operands : any();
  return out;
}

Mixture random_mixture_with_floats(fastsplat::test::Random& random) {
  Mixture mixture = random_mixture(random, true);
  const Mixture floats = Mixture::all_floats(random_floats(random));
  for (const Step step : all_steps())
    if (random.once_in(2)) mixture = mixture.with({&step, 1}, floats);
  const auto real = [&](Step step) { mixture = mixture.with({&step, 1}, false); };
  if (mixture.device(Step::Depth) && mixture.floats(Step::Sheet)) real(Step::Depth);
  if (mixture.device(Step::Distance) && floats.tile_centres()) real(Step::Distance);
  return mixture;
}

std::vector<scene::SceneDescription> small_scenes() {
  std::vector<scene::SceneDescription> scenes(3);
  for (scene::SceneDescription& scene : scenes) {
    scene.volume = "shells:10";
    scene.width = 20;
    scene.height = 18;
    scene.camera.azimuth = 37.0;
    scene.camera.elevation = 21.0;
    scene.opacity_scale = 3.0;
  }
  scenes[0].camera.projection = scene::Projection::Perspective;
  scenes[0].slab_width = 0.7;
  scenes[1].method = scene::Method::AxisAligned;
  scenes[1].slab_opacity = scene::SlabOpacity::Additive;
  scenes[2].method = scene::Method::XRay;
  scenes[2].xray_sheets = 4;
  return scenes;
}

std::string text_of(const cmodel::Config& config) {
  std::string text;
  for (const cmodel::ConfigKey& key : cmodel::config_keys())
    text += std::string(key.name) + "=" + cmodel::text_of(config, key) + " ";
  return text;
}

}  // namespace fastsplat::stages::test
