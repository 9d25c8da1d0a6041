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

/// What a simulator can do beyond simulating.
struct RtlAbilities {
  bool wave = false;    ///< write waveforms; slow
  bool faults = false;  ///< hold the faults of testbench/faults/faults.def, SimulatorOptions::fault selects one
};

/// Watches builds of modules.
struct RtlBuildWatch {
  /// Called with a line that says what is built, why and how long it takes; returns what is called with the number of
  /// files compiled and their total.
  std::function<Progress(const std::string& line)> begin;
  std::function<void()> end;  ///< called after the build, whether it succeeded or not
};

/// Replaces the watch of this process. By default the line goes to stderr.
void watch_rtl_builds(RtlBuildWatch watch);

/// The module of a configuration's hash and of the RTL sources beside the program: of the program's own folder
/// (../lib/fastsplat), else of the user's cache ($XDG_CACHE_HOME/fastsplat, ~/.cache/fastsplat), where it is built if
/// it is missing. Two processes do not build the same. UserError: Usage where the configuration has no RTL
/// (cmodel::rtl_violation), or a tool that builds it is missing; Input where the cache cannot be written; Internal
/// where the tools fail.
std::filesystem::path rtl_module(const cmodel::Config& config, RtlAbilities abilities);

/// As rtl_module(), but built into `folder` unless it is there.
std::filesystem::path rtl_module_in(const std::filesystem::path& folder, const cmodel::Config& config,
                                    RtlAbilities abilities);

/// A simulator of the module's. Throws UserError (Input) for a file that is not one.
std::unique_ptr<SimulatedTop> open_rtl(const cmodel::Config& config, RtlAbilities abilities,
                                       const SimulatorOptions& options);

}  // namespace fastsplat::testbench
