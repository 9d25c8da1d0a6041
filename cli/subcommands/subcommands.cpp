// SPDX-License-Identifier: Apache-2.0
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {

const std::vector<Verb>& all_verbs() {
  static const std::vector<Verb> all{
      verbs::render,
      verbs::compare,
      {"volume", "inspect and convert volumes: NRRD, NIfTI, MetaImage, built-in", nullptr},
      verbs::volume_info,
      verbs::volume_convert,
      {"stream", "record, dump, replay and export the device's input streams (.fss)", nullptr},
      verbs::stream_record,
      verbs::stream_dump,
      verbs::stream_replay,
      verbs::stream_vectors,
      verbs::cycles,
      verbs::errors,
      verbs::errors_bound,
      verbs::errors_ranges,
      verbs::errors_propose,
      {"config", "list, show, check and compare hardware configurations", nullptr},
      verbs::config_list,
      verbs::config_show,
      verbs::config_check,
      verbs::config_diff,
      verbs::family,
      verbs::verify,
      {"plan", "parameter sweeps: make, run in shards, merge, tabulate", nullptr},
      verbs::plan_make,
      verbs::plan_run,
      verbs::plan_submit,
      verbs::plan_status,
      verbs::plan_merge,
      verbs::plan_table,
      verbs::plan_pareto,
      verbs::plan_csv,
      verbs::report,
      verbs::doctor,
      verbs::completion,
      verbs::help,
  };
  return all;
}

}  // namespace fastsplat::cli
