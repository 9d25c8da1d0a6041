// SPDX-License-Identifier: Apache-2.0
// What subcommands that follow the device's steps work on: a volume's scene or a view of 3-D Gaussians, and a
// configuration.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/pipeline/chain.hpp"
#include "base/images/image_file.hpp"
#include "cli/config_flags.hpp"
#include "cli/gaussian_flags.hpp"
#include "cli/output.hpp"
#include "cli/scene_flags.hpp"

namespace fastsplat::cli {

struct StagedFlags {
  SceneFlags scene;
  GaussianFlags gaussians;  ///< instead of a volume's scene
  ConfigFlags config;
};

void declare(Options& options, StagedFlags& to);

class StagedScene {
 public:
  /// Checks the flags; reads the configuration, but neither volume nor Gaussians.
  explicit StagedScene(const StagedFlags& flags);
  const cmodel::Config& config() const { return config_; }
  std::vector<std::string> inputs() const;  ///< files that the command reads
  std::vector<stages::StepSet> sets(bool floats) const;  ///< as Chain::sets()

  /// Reads the scene and prints its remarks. Before the functions below.
  void read(const Output& output);
  std::string summary() const;
  /// Refers to this object and to `config`.
  std::unique_ptr<stages::Chain> chain(const cmodel::Config& config, int threads) const;
  /// With the scene's own configuration; prints what is left out.
  std::unique_ptr<stages::Chain> chain(int threads, const Output& output) const;
  /// Metadata of values per pixel: "errors".
  images::Metadata metadata(const char* what) const;

 private:
  const StagedFlags& flags_;
  cmodel::Config config_;
  scene::SceneDescription description_;  ///< of a volume
  std::optional<GaussianView> view_;
  std::optional<scene::Scene> scene_;
  std::optional<scene::GaussianScene> gaussians_;
};

}  // namespace fastsplat::cli
