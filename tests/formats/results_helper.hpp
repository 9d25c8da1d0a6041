// SPDX-License-Identifier: Apache-2.0
// Small results of every kind, as subcommands write them.
#pragma once

#include <string>
#include <vector>

#include "report/results.hpp"

namespace fastsplat::report {

/// `text` is the result's JSON.
Result result_from(const std::string& file, const std::string& text);

/// One result of every reported subcommand, ordered by name: some pass, some fail.
std::vector<Result> all_kinds();
/// The one of `subcommand`.
Result kind(const std::string& subcommand);

}  // namespace fastsplat::report
