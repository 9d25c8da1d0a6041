// SPDX-License-Identifier: Apache-2.0
#include "testbench/device/rtl_module.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

#include "base/called.hpp"
#include "base/error.hpp"
#include "base/folder_lock.hpp"
#include "base/hash_text.hpp"
#include "base/machine_error.hpp"
#include "base/programs.hpp"
#include "base/read_file.hpp"
#include "base/sha256.hpp"
#include "base/unfinished.hpp"
#include "cmodel/rtl_package/sv_package.hpp"

namespace fastsplat::testbench {
namespace {

namespace fs = std::filesystem;

using MakeTop = SimulatedTop* (*)(const SimulatorOptions&);
constexpr const char* kMakeTop = "fastsplat_rtl_top";  // module.cpp

RtlBuildWatch& watch() {
  static RtlBuildWatch now{.begin =
                               [](const std::string& line) {
                                 std::fprintf(stderr, "fastsplat: %s\n", line.c_str());
                                 return Progress{};
                               },
                           .end = [] {}};
  return now;
}

fs::path program_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

/// Holds rtl/, testbench/module/ and the faults' package, in the build folder as in an installation.
fs::path share_folder() { return (program_folder() / "../share/fastsplat").lexically_normal(); }

/// Hash of all sources of a module but the configuration's package.
const std::string& sources_hash() {
  static const std::string hash = [] {
    const fs::path share = share_folder();
    std::vector<fs::path> files{share / "fastsplat_fault_pkg.sv"};
    for (const char* folder : {"rtl", "testbench/module"}) {
      std::error_code missing;
      for (const auto& entry : fs::recursive_directory_iterator(share / folder, missing))
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    if (files.size() == 1) {
      throw_machine({.where = share.string(),
                     .what = "the sources of the RTL are missing",
                     .expected = "rtl/ and testbench/module/ in this folder",
                     .got = {},
                     .fix = "install or build fastsplat again"});
    }
    std::sort(files.begin(), files.end());
    Sha256 sum;
    for (const auto& file : files) sum.add(file.filename().string() + "\n" + read_text_file(file));
    return sum.text().substr(0, 16);
  }();
  return hash;
}

std::string module_name(const cmodel::Config& config, RtlAbilities abilities) {
  return "rtl-" + hash_text(cmodel::config_hash(config)) + "-" + sources_hash() + (abilities.faults ? "-faults" : "") +
         (abilities.wave ? "-wave" : "");
}

fs::path cache_folder() {
  for (const auto& [variable, below] : {std::pair{"XDG_CACHE_HOME", "fastsplat"}, {"HOME", ".cache/fastsplat"}}) {
    const char* folder = std::getenv(variable);
    if (folder != nullptr && folder[0] == '/') return fs::path(folder) / below;
  }
  throw_machine({.where = "cache of simulators",
                 .what = "no folder is available",
                 .expected = {},
                 .got = {},
                 .fix = "set XDG_CACHE_HOME to your own folder"});
}

void require_tools(const cmodel::Config& config) {
  const char* chosen = std::getenv("CXX");
  std::string missing;
  for (const std::string& tool :
       {std::string("verilator"), std::string("make"), std::string(chosen == nullptr ? "g++" : chosen)})
    if (!in_path(tool)) missing += (missing.empty() ? "" : ", ") + tool;
  if (missing.empty()) return;
  throw MachineError({.where = "configuration " + config.name,
                      .what = "its RTL is not built yet, and the tools to build it are missing",
                      .expected = "verilator, make and a C++ compiler",
                      .got = "no " + missing,
                      .fix = "apt-get install verilator make g++, or use the model: --engine cmodel"},
                     ExitCode::Usage);
}

/// Reports the files compiled, of those announced, in what build.sh has printed so far.
void report(const Progress& progress, const std::string& printed) {
  const auto announced = printed.find("files ");
  if (!progress || announced == std::string::npos) return;
  std::size_t done = 0;
  for (auto at = printed.find(" -c ", announced); at != std::string::npos; at = printed.find(" -c ", at + 1)) ++done;
  const auto total = std::strtoul(printed.c_str() + announced + 6, nullptr, 10);
  progress(done, std::max(done, static_cast<std::size_t>(total)));
}

/// The line of a tool's output that has the error.
std::string first_error(const Called& called) {
  const std::string all = called.out + called.err;
  for (const char* sign : {"%Error", "error:", "rror"}) {
    const auto at = all.find(sign);
    if (at == std::string::npos) continue;
    const auto begin = all.rfind('\n', at) + 1;
    return all.substr(begin, all.find('\n', at) - begin);
  }
  return called.last_words();
}

/// Expected duration of a build; it grows with the array of P x P lanes.
std::string duration(const cmodel::Config& config) {
  const int lanes = config.lanes * config.lanes;
  return lanes <= 4 ? "takes half a minute" : lanes <= 16 ? "takes a minute" : "takes several minutes";
}

void build(const fs::path& module, const cmodel::Config& config, RtlAbilities abilities) {
  require_tools(config);
  const fs::path share = share_folder(), package = module.string() + ".pkg.sv", log = module.string() + ".log";
  const UnfinishedPath folder(module.parent_path()),
      text(package);  // gone after an interrupt; the folder if it is empty
  std::ofstream(package) << cmodel::sv_package(config);
  std::vector<std::string> words{"env",
                                 "JOBS=" + std::to_string(std::max(1U, std::thread::hardware_concurrency())),
                                 (share / "testbench/module/build.sh").string(),
                                 share.string(),
                                 package.string(),
                                 module.string()};
  if (abilities.wave) words.emplace_back("wave");
  if (abilities.faults) words.emplace_back("faults");
  const Progress progress = watch().begin(
      "building the simulator of configuration " + config.name + (abilities.faults ? ", with faults" : "") +
      (abilities.wave ? ", with waveforms" : "") + ": the first use of this RTL; " + duration(config));
  const Called called = call(words, 0, [&](const std::string& printed) { report(progress, printed); });
  watch().end();
  std::error_code ignored;
  if (called.code == 0 && fs::exists(module)) {
    fs::remove(log, ignored);
    return;
  }
  std::ofstream(log) << called.out << called.err;
  throw UserError(ExitCode::Internal, {.where = "configuration " + config.name,
                                       .what = "its RTL cannot be built: " + first_error(called),
                                       .expected = {},
                                       .got = {},
                                       .fix = "see " + log.string()});
}

MakeTop load(const fs::path& module) {
  void* library = ::dlopen(module.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* make = library == nullptr ? nullptr : ::dlsym(library, kMakeTop);
  if (make == nullptr) {
    const char* reason = ::dlerror();
    throw_machine({.where = module.string(),
                   .what = std::string("the simulator cannot be loaded: ") + (reason == nullptr ? "no reason" : reason),
                   .expected = {},
                   .got = {},
                   .fix = "delete the file to rebuild it"});
  }
  return reinterpret_cast<MakeTop>(make);  // the library stays: devices come and go
}

}  // namespace

void watch_rtl_builds(RtlBuildWatch now) { watch() = std::move(now); }

fs::path rtl_module_in(const fs::path& folder, const cmodel::Config& config, RtlAbilities abilities) {
  const std::string name = module_name(config, abilities);
  const fs::path module = folder / name / (name + ".so");
  if (fs::exists(module)) return module;
  std::error_code error;
  fs::create_directories(module.parent_path(), error);
  if (error) {
    throw_machine({.where = module.parent_path().string(),
                   .what = "cannot create the folder for a simulator: " + error.message(),
                   .expected = {},
                   .got = {},
                   .fix = "set XDG_CACHE_HOME to your own folder"});
  }
  const FolderLock lock(module);
  if (!fs::exists(module)) build(module, config, abilities);
  return module;
}

fs::path rtl_module(const cmodel::Config& config, RtlAbilities abilities) {
  if (auto never = cmodel::rtl_violation(config)) {
    never->where = "configuration " + config.name + ": " + never->where;
    throw_usage(*never);
  }
  const std::string name = module_name(config, abilities);
  const fs::path built = (program_folder() / "../lib/fastsplat" / name / (name + ".so")).lexically_normal();
  return fs::exists(built) ? built : rtl_module_in(cache_folder(), config, abilities);
}

std::unique_ptr<SimulatedTop> open_rtl(const cmodel::Config& config, RtlAbilities abilities,
                                       const SimulatorOptions& options) {
  static std::mutex mutex;
  static std::map<std::string, MakeTop> loaded;
  MakeTop make = nullptr;
  {
    const std::lock_guard one(mutex);
    MakeTop& known = loaded[module_name(config, abilities)];
    if (known == nullptr) known = load(rtl_module(config, abilities));
    make = known;
  }
  return std::unique_ptr<SimulatedTop>(make(options));
}

}  // namespace fastsplat::testbench
