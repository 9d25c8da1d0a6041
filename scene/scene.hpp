// SPDX-License-Identifier: Apache-2.0
// Everything that decides a picture, independent of the engine that renders it.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scene/camera.hpp"
#include "scene/culling.hpp"
#include "scene/display.hpp"
#include "scene/kernel.hpp"
#include "scene/solid_texture.hpp"
#include "scene/techniques.hpp"
#include "scene/transfer_function.hpp"
#include "scene/volume/volume.hpp"
#include "scene/voxel_box.hpp"

namespace fastsplat::scene {

enum class Method { RayCast, XRay, Westover, AxisAligned, ImageAligned };
enum class SlabOpacity { Additive, Exponential };
/// Whether voxels are classified before they are splatted, or pixels after.
enum class ClassifyOrder { Pre, Post };
/// Gradients of post-classified densities: differences between pixels and sheets, or splatted derivatives.
enum class GradientKind { Central, Splats };

/// The content of scene.toml; flags override single fields before `build_scene`.
struct SceneDescription {
  std::string volume = "shells:64";
  std::string transfer_function{};  ///< empty: chosen by the volume (mri-head, binary, checker, else default)
  std::string kernel = "gauss2";    ///< a name, or empty with kernel_a / kernel_radius
  double kernel_a = 2.0, kernel_radius = 2.0;
  CameraParams camera{};
  int width = 512, height = 512;
  Method method = Method::ImageAligned;
  double slab_width = 1.0;  ///< kernel units
  SlabOpacity slab_opacity = SlabOpacity::Exponential;
  double ray_end = 0.0;        ///< ray caster: a ray ends below this transmittance; 0: once nothing can change
  int xray_sheets = 1;         ///< number of sheets of an X-ray (the image must not depend on it)
  double xray_exposure = 0.0;  ///< pixel = exposure * integral; 0: automatic, see Scene::xray_scale
  int shading = -1;            ///< -1 as the transfer function suggests, 0 off, 1 on
  double opacity_scale = 1.0;  ///< multiplies extinction
  FootprintSettings footprint{};
  Motion motion{};
  Lens lens{};
  ClassifyOrder classify = ClassifyOrder::Pre;
  GradientKind gradients = GradientKind::Central;
  Texture texture{};
  Bump bump{};
  Culling culling{};
  VoxelBox crop{};                 ///< voxels outside are ignored
  Display display{};               ///< only for displayed pictures
  std::optional<double> nan_as{};  ///< replaces non-finite voxels, which are refused without it
  /// "scene.toml:1:10" if a file names the volume, the transfer function and the box, else empty.
  std::string volume_place{}, transfer_function_place{}, crop_place{};
};

class SplatStore;  // scene/splat_store.hpp

/// Ready to render: files read, names resolved, limits checked.
struct Scene {
  SceneDescription description;
  std::shared_ptr<const volume::Volume> volume;  ///< cropped
  TransferFunction transfer_function;            ///< if cropped, resolved to the domain of the whole volume
  Kernel kernel;
  Camera camera;
  Shading shading;
  /// Footprint amplitude per unit extinction: kernel.peak() * volume of a grid cell / kernel_unit^3
  /// (optical depth that one voxel of extinction 1 adds at its centre).
  double amplitude = 0.0;
  /// Method::XRay: pixel = xray_scale * summed emission. Given, or automatic_exposure() (xray_exposure.hpp).
  double xray_scale = 1.0;
  std::shared_ptr<const volume::Volume> whole{};  ///< before cropping, for further calls of build_scene
  std::vector<std::string> remarks{};             ///< assumptions and oddities of the input, a sentence each
  std::shared_ptr<SplatStore> store{};            ///< what frames of the volume share, or null
};

/// Loads a scene.toml, or a built-in scene as "demo:NAME". Unknown keys and bad values are UserErrors with file:line
/// and a hint; the error for an unknown demo names the nearest. Relative volume paths are relative to the file.
SceneDescription load_scene_file(const std::filesystem::path& path);
std::vector<std::string> demo_names();  ///< sorted
/// TOML that load_scene_file turns into a scene of the same picture, and to_toml again into the same text. Settings
/// without effect (scene/capability.hpp) are left out unless they are at their default.
std::string to_toml(const SceneDescription& description);

Scene build_scene(const SceneDescription& description);
/// The same with a volume already in memory, not yet cropped.
Scene build_scene(const SceneDescription& description, std::shared_ptr<const volume::Volume> volume);

const char* to_string(Method method);
const char* to_string(SlabOpacity opacity);
const std::vector<std::string>& method_names();        ///< in the order of Method
const std::vector<std::string>& slab_opacity_names();  ///< in the order of SlabOpacity

}  // namespace fastsplat::scene
