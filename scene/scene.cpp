// SPDX-License-Identifier: Apache-2.0
#include "scene/scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/machine_error.hpp"
#include "scene/capability.hpp"
#include "scene/content_fit.hpp"
#include "scene/kept_volumes.hpp"
#include "scene/ripple.hpp"
#include "scene/settings.hpp"
#include "scene/splat_store.hpp"
#include "scene/volume/volume_file.hpp"
#include "scene/xray_exposure.hpp"

namespace fastsplat::scene {
namespace {

/// Default transfer function for a volume, chosen by its name.
std::string preset_for(const std::string& volume) {
  const std::string name = volume.substr(0, volume.find(':'));
  if (name == "binary-cube" || name == "constant" || name == "point") return "binary";
  if (name == "checkerboard-floor" || name == "checkerboard-tunnel") return "checker";
  for (const char* scan : {"ch2", "ch2bet", "ch2better", "inia19-t1-brain"}) {
    const std::string file = std::filesystem::path(volume).filename().string();
    if (file == scan || file == fmt::format("{}.nii.gz", scan)) return "mri-head";
  }
  return "default";
}

/// Returns load(). Errors get the place at which a scene file names the input, and are of that file.
template <class Load>
auto named_at(const std::string& place, const Load& load) {
  try {
    return load();
  } catch (const UserError& error) {
    if (place.empty()) throw;
    ErrorParts parts = error.parts();
    parts.where = place + (parts.where.empty() ? "" : ": " + parts.where);
    throw_again(error, std::move(parts), error.code() == ExitCode::Usage ? ExitCode::Input : error.code());
  }
}

Kernel make_kernel(const SceneDescription& description) {
  return description.kernel.empty() ? Kernel(description.kernel_a, description.kernel_radius)
                                    : kernel_by_name(description.kernel);
}

/// What magnified voxels show of the method of a picture that is classified by pixel; empty if they are too small.
std::string terraces(const Scene& scene) {
  constexpr double kPixels = 2.0, kRipple = 0.02;
  const SceneDescription& description = scene.description;
  if (description.method != Method::ImageAligned || description.classify != ClassifyOrder::Post) return {};
  const double voxel = scene.camera.project(glm::dvec3(0.0)).scale * scene.volume->kernel_unit();  // pixels
  const double ripple = ripple_bound(scene.kernel, 0.0);
  const bool rings = description.slab_width * voxel >= kPixels;
  const bool stripes = voxel >= kPixels && ripple > kRipple && scene.shading.on;
  std::string shown, fix;
  if (rings) {
    shown = fmt::format("slabs are {:.2g} pixels thick and show as rings on surfaces", description.slab_width * voxel);
    fix = fmt::format("--slab-width {:.2g}", 1.0 / voxel);
  }
  if (stripes) {
    shown += fmt::format("{}the kernel ripples by up to {:.2g} % and shows the grid in the shading",
                         rings ? ", and " : "", 100.0 * ripple);
    fix += std::string(rings ? " and " : "") + "--kernel smooth";
  }
  return shown.empty() ? shown : "classified by pixel: " + shown + "; use " + fix;
}

}  // namespace

Scene build_scene(const SceneDescription& description) {
  check_limits(description);
  check_capability(description, kOffersAll);
  if (const auto [volume, store] = kept_volume(description); volume) {
    Scene scene = build_scene(description, volume);
    if (store && store->serves(scene)) scene.store = store;
    return scene;
  }
  volume::ReadOptions reading;
  if (description.nan_as) reading.nan_as = static_cast<float>(*description.nan_as);
  return build_scene(description, named_at(description.volume_place, [&] {
                       return std::make_shared<const volume::Volume>(volume::load_volume(description.volume, reading));
                     }));
}

Scene build_scene(const SceneDescription& description, std::shared_ptr<const volume::Volume> whole) {
  check_limits(description);
  check_capability(description, kOffersAll);
  auto volume = named_at(description.crop_place, [&] { return cropped(whole, description.crop); });
  const Kernel kernel = make_kernel(description);
  const double unit = volume->kernel_unit();
  const Camera camera(description.camera, *volume, kernel.radius() * unit, description.width, description.height);
  check_techniques(description.motion, description.lens, camera, volume->bounding_radius() + kernel.radius() * unit);
  TransferFunction tf = named_at(description.transfer_function_place, [&] {
    return load_transfer_function(description.transfer_function.empty() ? preset_for(description.volume)
                                                                        : description.transfer_function);
  });
  auto remarks = whole->remarks;
  if (const auto remark = remark_on(tf, *whole); !remark.empty()) remarks.push_back(remark);
  if (!description.crop.everything()) tf = resolved(tf, *whole);  // cropping keeps the colours
  Shading shading = tf.shading;
  if (description.shading >= 0) shading.on = description.shading == 1;
  double xray_scale = 1.0;
  if (description.method == Method::XRay) {
    xray_scale = description.xray_exposure > 0.0
                     ? description.xray_exposure
                     : automatic_exposure(*volume, Classifier(tf, *volume), description.opacity_scale);
  }
  const glm::dvec3 cell = volume->spacing / unit;
  const double upright = volume->oblique ? std::abs(glm::determinant(volume->axes)) : 1.0;  // a sheared cell is smaller
  Scene scene{.description = description,
              .volume = std::move(volume),
              .transfer_function = std::move(tf),
              .kernel = kernel,
              .camera = camera,
              .shading = shading,
              .amplitude = kernel.peak() * cell.x * cell.y * cell.z * upright,
              .xray_scale = xray_scale,
              .whole = std::move(whole),
              .remarks = std::move(remarks)};
  if (description.camera.fit == Fit::Content) scene.camera = fitted_to_content(scene, description.camera.zoom);
  check_capability(scene, kOffersAll);  // now that shading is known
  if (auto remark = terraces(scene); !remark.empty()) scene.remarks.push_back(std::move(remark));
  return scene;
}

const std::vector<std::string>& method_names() {
  static const std::vector<std::string> names = {"raycast", "xray", "westover", "axis_aligned", "image_aligned"};
  return names;
}

const std::vector<std::string>& slab_opacity_names() {
  static const std::vector<std::string> names = {"additive", "exponential"};
  return names;
}

const char* to_string(Method method) { return method_names()[static_cast<std::size_t>(method)].c_str(); }
const char* to_string(SlabOpacity opacity) { return slab_opacity_names()[static_cast<std::size_t>(opacity)].c_str(); }

}  // namespace fastsplat::scene
