// --gaussians and what goes with it: from flags to a view of 3-D Gaussians.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/config_flags.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/scene_flags.hpp"
#include "golden/gaussians.hpp"
#include "scene/display.hpp"
#include "scene/gaussians/gaussian_scene.hpp"

namespace fastsplat::cli {

struct GaussianFlags {
  std::optional<std::string> file, up, order;
  std::optional<double> low_pass, cutoff;
};

void declare(Options& options, GaussianFlags& to);

/// A view and how it is shown.
struct GaussianView {
  scene::GaussianDescription description;
  scene::SceneDescription shown;  ///< of which only `display` is meant
  golden::GaussianOrder order = golden::GaussianOrder::Centres;
};

/// `flags.file` is there. Of the scene's flags those of the camera, --size and --background; UserError (Usage) for any
/// other. Perspective unless --orthographic; up is --up, else -y, of a built-in scene z.
GaussianView describe(const GaussianFlags& flags, const SceneFlags& scene);
/// UserError (Usage) for a flag that means nothing without --gaussians.
void refuse_without_gaussians(const GaussianFlags& flags);
/// What the command reads.
std::vector<std::string> inputs_of(const GaussianFlags& flags);

/// Reads the file, or makes the built-in scene; unknown names are Usage. Up is --up, else what the file declares.
scene::GaussianScene build(const GaussianFlags& flags, const GaussianView& view);
/// GaussianCloud::remarks, each a warning that names the scene.
std::vector<Remark> remarks(const scene::GaussianCloud& cloud);
/// The configuration named; without a name `ellipse` that composites every sample and finishes pixels where golden
/// does.
cmodel::Config load_for_gaussians(const ConfigFlags& flags);
/// "lastchance.splat, 14,007 Gaussians, degree 0, 512x512 pixels".
std::string summary(const scene::GaussianScene& scene);

}  // namespace fastsplat::cli
