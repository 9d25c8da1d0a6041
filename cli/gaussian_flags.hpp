// SPDX-License-Identifier: Apache-2.0
// --gaussians and its related flags: from flags to a view of 3-D Gaussians.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/config_flags.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/scene_flags.hpp"
#include "driver/tiles/gaussian_frame.hpp"
#include "golden/gaussians.hpp"
#include "scene/display.hpp"
#include "scene/gaussians/gaussian_scene.hpp"
#include "scene/voxel_box.hpp"

namespace fastsplat::cli {

struct GaussianFlags {
  std::optional<std::string> file, up, order;
  std::optional<std::string> cameras, view, pose, eye, look_at;  ///< of a placed camera
  std::optional<double> low_pass, cutoff, near;
  bool strict = false;  ///< refuses files with Gaussians that cannot be drawn
};

void declare(Options& options, GaussianFlags& to);

/// A view and its display settings.
struct GaussianView {
  scene::GaussianDescription description;
  scene::SceneDescription shown;       ///< of it `display` and, for animations, `camera`
  std::optional<scene::RealBox> crop;  ///< Gaussians whose centres are outside are ignored
  std::optional<glm::ivec2> size;      ///< --size
  golden::GaussianOrder order = golden::GaussianOrder::Centres;
};

/// Precondition: `flags.file` is set. Of the scene's flags it accepts the camera's, --size and --background; UserError
/// (Usage) for others. Perspective unless --orthographic; up is --up, else -y for files and z for built-in scenes.
GaussianView describe(const GaussianFlags& flags, const SceneFlags& scene);
/// The same; UserError (Usage) for --order pixels, too.
GaussianView describe_for_device(const GaussianFlags& flags, const SceneFlags& scene);
/// UserError (Usage) for flags that require --gaussians.
void refuse_without_gaussians(const GaussianFlags& flags);
/// Files that the command reads.
std::vector<std::string> inputs_of(const GaussianFlags& flags);

/// --strict.
void declare_strict(Options& options, bool& to);
/// Reads the file or generates the built-in scene. UserError (Usage) for unknown names, (Input) with `strict` if a
/// Gaussian cannot be drawn.
scene::GaussianCloud read_gaussians(const std::string& name_or_path, bool strict);
/// A scene's file; empty for a built-in scene.
std::vector<std::string> inputs_of_gaussians(const std::string& name_or_path);

/// Reads the file or generates the built-in scene, and reads --cameras; UserError (Usage) for unknown names. Up is
/// --up, else as the file declares; the size is --size, else the camera's.
scene::GaussianScene build(const GaussianFlags& flags, const GaussianView& view);
/// The views of a sequence's frames, and of all cameras of --cameras.
std::vector<scene::GaussianDescription> frames_of(const scene::Sequence& sequence, const GaussianView& view);
std::vector<scene::GaussianDescription> frames_of_cameras(const GaussianFlags& flags, const GaussianView& view);
/// GaussianCloud::remarks as warnings that name the scene.
std::vector<Remark> remarks(const scene::GaussianCloud& cloud);
/// Without a name, that of `ellipse` with every sample composited and golden's early-termination threshold.
ConfigFlags for_gaussians(ConfigFlags flags);
inline cmodel::Config load_for_gaussians(const ConfigFlags& flags) { return load(for_gaussians(flags)); }
/// A warning if Gaussians are left out although they meet the picture.
std::vector<Remark> remarks(const scene::ProjectionReport& projection);
/// What of a compiled view the device does not hold: clipped, thin, too bright or transparent Gaussians.
std::vector<Remark> remarks(const driver::GaussianReport& report, const cmodel::Config& config);
/// Compiles a view of them for the device, with both remarks and a progress bar while they are projected.
driver::GaussianFrame compile(const scene::GaussianScene& scene, const cmodel::Config& config, const Common& common,
                              const Output& output);
/// "lastchance.splat, 14,007 Gaussians, degree 0, 512x512 pixels".
std::string summary(const scene::GaussianScene& scene);

}  // namespace fastsplat::cli
