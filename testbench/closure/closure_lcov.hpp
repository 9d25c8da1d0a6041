// SPDX-License-Identifier: Apache-2.0
// Coverage for other viewers: LCOV's tracefile (`man geninfo`; genhtml draws it) and the files that Coverview reads
// (its README, "Data structure").
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "testbench/closure/closure_report.hpp"

namespace fastsplat::testbench {

/// Lines and branches of the RTL as an LCOV tracefile. `source` is the repository; files are named from there
/// (rtl/splat/fastsplat_lane.sv). Excused places are left out.
std::string closure_info(const ClosureReport& report, const std::filesystem::path& source);

/// By name: config.json, sources.txt, and a tracefile each of lines, branches and functional bins. A bin is a branch of
/// its testpoint's line in docs/verification_plan.toml; block N is the Nth configuration. Other branches are named if,
/// else and case.
std::map<std::string, std::string> coverview_files(const ClosureReport& report, const std::filesystem::path& source);

}  // namespace fastsplat::testbench
