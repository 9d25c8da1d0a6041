// SPDX-License-Identifier: Apache-2.0
#include "cli/staged_scene.hpp"

#include "base/error.hpp"
#include "cli/errors_output.hpp"
#include "cli/gaussian_picture.hpp"
#include "cli/output_names.hpp"
#include "cli/volume_json.hpp"
#include "driver/splats/splat_quantiser.hpp"
#include "driver/tables/density_tables.hpp"
#include "driver/tiles/gaussian_frame.hpp"

namespace fastsplat::cli {

void declare(Options& options, StagedFlags& to) {
  declare(options, to.scene);
  declare(options, to.gaussians);
  options.group("Device");
  declare(options, to.config, "hardware configuration, a name or a TOML file");
}

StagedScene::StagedScene(const StagedFlags& flags)
    : flags_(flags), config_(flags.gaussians.file ? load_for_gaussians(flags.config) : load(flags.config)) {
  if (flags.gaussians.file) {
    view_ = describe_for_device(flags.gaussians, flags.scene);
    return;
  }
  refuse_without_gaussians(flags.gaussians);
  description_ = describe(flags.scene);
}

std::vector<std::string> StagedScene::inputs() const {
  return joined(view_ ? inputs_of(flags_.gaussians) : inputs_of(flags_.scene),
                inputs_of_config(flags_.config.config.value_or("")));
}

std::vector<stages::StepSet> StagedScene::sets(bool floats) const {
  auto sets = view_ ? stages::gaussian_sets(config_)
                    : stages::step_sets(config_, driver::carries(description_.method, config_) && !floats,
                                        driver::holds_densities(description_));
  return floats ? stages::float_sets(std::move(sets)) : sets;
}

void StagedScene::read(const Output& output) {
  if (view_) {
    gaussians_ = build(flags_.gaussians, *view_);
    output.remark(remarks(*gaussians_->cloud));
  } else {
    scene_ = build(flags_.scene);
    output.remark(remarks(*scene_));
  }
}

std::string StagedScene::summary() const { return gaussians_ ? cli::summary(*gaussians_) : cli::summary(*scene_); }

std::unique_ptr<stages::Chain> StagedScene::chain(const cmodel::Config& config, int threads) const {
  return gaussians_ ? std::make_unique<stages::Chain>(*gaussians_, config, threads)
                    : std::make_unique<stages::Chain>(*scene_, config);
}

std::unique_ptr<stages::Chain> StagedScene::chain(int threads, const Output& output) const {
  auto made = chain(config_, threads);
  if (const stages::GaussianSteps* const steps = made->gaussians()) {
    output.remark(remarks(steps->projection()));
    output.remark(remarks(driver::GaussianFrame(*gaussians_, steps->gaussians(), config_, threads).report(), config_));
  }
  return made;
}

images::Metadata StagedScene::metadata(const char* what) const {
  return gaussians_ ? gaussian_metadata(what, *gaussians_, config_, golden::GaussianOrder::Centres)
                    : values_metadata(what, *scene_, config_);
}

}  // namespace fastsplat::cli
