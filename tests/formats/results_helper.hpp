// SPDX-License-Identifier: Apache-2.0
// Results as subcommands write them, small, and of every kind.
#pragma once

#include <string>
#include <vector>

#include "report/results.hpp"

namespace fastsplat::report {

/// `text` is the result's JSON.
Result result_from(const std::string& file, const std::string& text);

/// One of every subcommand that is reported, in the order of their names: some pass, some fail.
std::vector<Result> all_kinds();
/// `subcommand` among them.
Result kind(const std::string& subcommand);

}  // namespace fastsplat::report
