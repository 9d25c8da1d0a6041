// SPDX-License-Identifier: Apache-2.0
// fastsplat doctor: the program's parts and what the machine provides.
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/provenance.hpp"
#include "base/images/image_file.hpp"
#include "base/memory.hpp"
#include "base/version.hpp"
#include "cli/other_programs.hpp"
#include "cli/output.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "cli/versions.hpp"
#include "driver/config/config_file.hpp"
#include "scene/scene.hpp"
#include "scene/transfer_function.hpp"
#include "scene/volume/synthetic.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::cli {
namespace {

struct DoctorArguments {
  Common common;
};

using Json = nlohmann::ordered_json;

struct Library {
  const char* name;
  const char* version;  ///< null: loaded on demand and queried
};
constexpr Library kLibraries[] = {
    {"CLI11", VERSION_CLI11},        {"fmt", VERSION_FMT},         {"GLM", VERSION_GLM},
    {"nlohmann-json", VERSION_JSON}, {"libnifti2", VERSION_NIFTI}, {"OpenImageIO", nullptr},
    {"oneTBB", VERSION_TBB},         {"teem", VERSION_TEEM},       {"toml++", VERSION_TOMLPLUSPLUS},
    {"zlib", VERSION_ZLIB},
};

/// Processors available to this process; containers and taskset can reduce them.
int usable_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return ::sched_getaffinity(0, sizeof(set), &set) == 0 ? CPU_COUNT(&set)
                                                        : static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN));
}

double memory_gb() { return static_cast<double>(machine_memory()) / 1e9; }

bool is_synthetic(const std::string& name) {
  const auto names = volume::synthetic_names();
  return std::find(names.begin(), names.end(), name.substr(0, name.find(':'))) != names.end();
}

struct Scan {
  std::string name;
  std::optional<volume::Volume> header;  ///< absent: missing
  std::string reason;                    ///< why it is missing
};

struct Missing {
  std::string what, fix;
};

/// The program's parts and what it found.
struct DoctorResult {
  int processors = 0;
  double memory_gb = 0.0;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
  std::vector<OtherProgram> programs;
  std::vector<Scan> scans;
  std::vector<std::string> synthetics, transfer_functions, demos, configurations;
  std::vector<Missing> missing;
};

/// Loads the library to find out whether pictures can be read and written here.
std::string image_library(DoctorResult& result) {
  try {
    return images::library_version();
  } catch (const UserError& error) {
    result.missing.push_back({"image library", error.what()});
    return "missing";
  }
}

DoctorResult look() {
  DoctorResult result{.processors = usable_processors(),
                      .memory_gb = memory_gb(),
                      .libraries = {},
                      .programs = look_for_programs(),
                      .scans = {},
                      .synthetics = volume::synthetic_names(),
                      .transfer_functions = scene::transfer_function_presets(),
                      .demos = scene::demo_names(),
                      .configurations = driver::config_names(),
                      .missing = {}};
  for (const auto& [name, version] : kLibraries) {
    const std::string text = version == nullptr ? image_library(result) : version;
    result.libraries.emplace_back(name, text.empty() ? "unknown" : text);
  }
  for (const auto& program : result.programs) {
    if (program.usable()) continue;
    result.missing.push_back({fmt::format("{} ({})", program.name, program.use),
                              program.path.empty() ? program.get : program.path + " " + program.problem});
  }
  for (const auto& name : volume::known_volume_names()) {
    if (is_synthetic(name)) continue;
    Scan scan{.name = name, .header = {}, .reason = {}};
    try {
      scan.header = volume::read_volume_header(name);
    } catch (const UserError& error) {
      scan.reason = error.what();
    }
    result.scans.push_back(std::move(scan));
  }
  if (std::any_of(result.scans.begin(), result.scans.end(), [](const Scan& scan) { return !scan.header; })) {
    result.missing.push_back(
        {"scans of mricron-data",
         "apt-get install mricron-data, or put the .nii.gz files in a folder and set FASTSPLAT_DATA to it"});
  }
  return result;
}

std::string to_text(const DoctorResult& result) {
  std::string text = fmt::format("fastsplat {} ({} build, {}, CMake {})\n", program_version(), VERSION_BUILD,
                                 VERSION_COMPILER, VERSION_CMAKE);
  text += fmt::format("machine: {} processors, {:.1f} GB memory\n", result.processors, result.memory_gb);
  text += "libraries:\n";
  for (const auto& [name, version] : result.libraries) text += fmt::format("  {:14} {}\n", name, version);
  text += "programs:\n";
  for (const auto& program : result.programs) {
    const std::string state = program.path.empty()       ? "missing"
                              : !program.problem.empty() ? program.path + " " + program.problem
                                                         : program.version;
    text += fmt::format("  {:14} {:12} for {}\n", program.name, state, program.use);
  }
  text += "scans:\n";
  for (const auto& [name, header, reason] : result.scans) {
    text += header ? fmt::format("  {:16} found: {} ({}x{}x{})\n", name, header->source, header->dims.x, header->dims.y,
                                 header->dims.z)
                   : fmt::format("  {:16} missing\n", name);
  }
  text += fmt::format("built-in volumes: {}\n", fmt::join(result.synthetics, ", "));
  text += fmt::format("transfer functions: {}\n", fmt::join(result.transfer_functions, ", "));
  text += fmt::format("demo scenes: {}\n", fmt::join(result.demos, ", "));
  text += fmt::format("configurations: {}\n", fmt::join(result.configurations, ", "));
  for (const auto& [what, fix] : result.missing)
    text += fmt::format("missing {}: {}; everything else works without it\n", what, fix);
  return text + (result.missing.empty() ? "nothing is missing\n" : "");
}

Json to_json(const Scan& scan) {
  if (scan.header) return {{"name", scan.name}, {"found", true}, {"source", scan.header->source}};
  return {{"name", scan.name}, {"found", false}, {"reason", scan.reason}};
}

Json to_json(const OtherProgram& program) {
  Json json{{"found", !program.path.empty()}, {"for", program.use}, {"get", program.get}};
  if (!program.path.empty()) json["path"] = program.path;
  if (!program.version.empty()) json["version"] = program.version;
  if (!program.problem.empty()) json["problem"] = program.problem;
  return json;
}

Json to_json(const DoctorResult& result) {
  Json json{{"version", program_version()}, {"build", VERSION_BUILD},          {"compiler", VERSION_COMPILER},
            {"cmake", VERSION_CMAKE},       {"processors", result.processors}, {"memory_gb", result.memory_gb}};
  for (const auto& [name, version] : result.libraries) json["libraries"][name] = version;
  for (const auto& program : result.programs) json["programs"][program.name] = to_json(program);
  json["scans"] = Json::array();
  for (const auto& scan : result.scans) json["scans"].push_back(to_json(scan));
  json["synthetics"] = result.synthetics;
  json["transfer_functions"] = result.transfer_functions;
  json["demos"] = result.demos;
  json["configurations"] = result.configurations;
  json["missing"] = Json::array();
  for (const auto& [what, fix] : result.missing) json["missing"].push_back({{"what", what}, {"fix", fix}});
  return json;
}

ExitCode run(const DoctorArguments& arguments) {
  const Output output(arguments.common);
  const DoctorResult result = look();
  output.line(to_text(result));
  output.json(to_json(result));
  return ExitCode::Pass;
}

void declare(Options& options, DoctorArguments& to) {
  declare(options, to.common);
  options.example("fastsplat doctor", "versions of this program and its libraries, and what is missing");
  options.example("fastsplat doctor --json doctor.json", "the same as JSON");
}

}  // namespace

const Subcommand subcommands::doctor{
    "doctor", "list versions, processors, programs and scans, what is missing and how to install it",
    subcommand<DoctorArguments, declare, run>};

}  // namespace fastsplat::cli
