// SPDX-License-Identifier: Apache-2.0
// Simulators of RTL as modules: shared libraries, found or built when a configuration's RTL is first simulated.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "base/progress.hpp"
#include "cmodel/numbers/config.hpp"
#include "testbench/module/simulated_top.hpp"

namespace fastsplat::testbench {

/// Features of a simulator beyond simulating.
struct RtlAbilities {
  bool wave = false;    ///< write waveforms; slow
  bool faults = false;  ///< hold the faults of testbench/faults/faults.def, SimulatorOptions::fault selects one
};

/// Watches builds of modules.
struct RtlBuildWatch {
  /// Called with a line on what is built, why and how long it takes; returns a callback that gets the number of files
  /// compiled and their total.
  std::function<Progress(const std::string& line)> begin;
  std::function<void()> end;  ///< called after the build, whether it succeeded or not
};

/// Replaces the watch of this process. By default the line goes to stderr.
void watch_rtl_builds(RtlBuildWatch watch);

/// The module for a configuration's hash and the RTL sources beside the program. It is in the program's own folder
/// (../lib/fastsplat), else in the user's cache ($XDG_CACHE_HOME/fastsplat, ~/.cache/fastsplat), where it is built if
/// it is missing. Two processes never build the same module. Throws UserError: Usage if the configuration has no RTL
/// (cmodel::rtl_violation) or a tool to build it is missing; Input if the cache cannot be written; Internal if the
/// tools fail.
std::filesystem::path rtl_module(const cmodel::Config& config, RtlAbilities abilities);

/// As rtl_module(), but built into `folder` unless it is there.
std::filesystem::path rtl_module_in(const std::filesystem::path& folder, const cmodel::Config& config,
                                    RtlAbilities abilities);

/// Opens the configuration's module as a simulator. Throws UserError (Input) if the file is not a module.
std::unique_ptr<SimulatedTop> open_rtl(const cmodel::Config& config, RtlAbilities abilities,
                                       const SimulatorOptions& options);

}  // namespace fastsplat::testbench
