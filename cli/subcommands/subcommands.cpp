// SPDX-License-Identifier: Apache-2.0
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {

const std::vector<Subcommand>& all_subcommands() {
  static const std::vector<Subcommand> all{
      subcommands::render,
      subcommands::compare,
      {"volume", "inspect and convert volumes: NRRD, NIfTI, MetaImage, built-in", nullptr},
      subcommands::volume_info,
      subcommands::volume_convert,
      {"gaussians", "inspect and convert scenes of 3-D Gaussians", nullptr},
      subcommands::gaussians_info,
      subcommands::gaussians_convert,
      {"stream", "record, dump, replay and export the device's input streams (.fss)", nullptr},
      subcommands::stream_record,
      subcommands::stream_dump,
      subcommands::stream_replay,
      subcommands::stream_vectors,
      subcommands::cycles,
      subcommands::errors,
      subcommands::errors_bound,
      subcommands::errors_file,
      subcommands::errors_ranges,
      subcommands::errors_propose,
      subcommands::pixel,
      {"config", "list, show, check and compare hardware configurations", nullptr},
      subcommands::config_list,
      subcommands::config_show,
      subcommands::config_check,
      subcommands::config_diff,
      subcommands::family,
      subcommands::verify,
      {"plan", "parameter sweeps: make, run in shards, merge, tabulate", nullptr},
      subcommands::plan_make,
      subcommands::plan_run,
      subcommands::plan_submit,
      subcommands::plan_status,
      subcommands::plan_merge,
      subcommands::plan_table,
      subcommands::plan_pareto,
      subcommands::plan_csv,
      subcommands::report,
      subcommands::lab,
      subcommands::doctor,
      subcommands::completion,
      subcommands::help,
  };
  return all;
}

}  // namespace fastsplat::cli
