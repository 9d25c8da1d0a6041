// SPDX-License-Identifier: Apache-2.0
// The subcommands, each defined in the file of its name.
#pragma once

#include "cli/subcommand.hpp"

namespace fastsplat::cli::subcommands {

extern const Subcommand compare, completion, config_check, config_diff, config_list, config_show, cycles, doctor,
    errors, errors_bound, errors_file, errors_propose, errors_ranges, family, gaussians_convert, gaussians_info, help,
    lab, pixel, plan_csv, plan_make, plan_merge, plan_pareto, plan_run, plan_status, plan_submit, plan_table, render,
    report, stream_dump, stream_record, stream_replay, stream_vectors, verify, volume_convert, volume_info;

}  // namespace fastsplat::cli::subcommands
