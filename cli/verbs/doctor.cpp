// fastsplat doctor: what this program is made of and what the machine offers it.
#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "analysis/provenance.hpp"
#include "base/version.hpp"
#include "cli/output.hpp"
#include "cli/verbs/verbs.hpp"
#include "driver/config_file.hpp"
#include "scene/scene.hpp"
#include "scene/transfer_function.hpp"
#include "volume/synthetic.hpp"
#include "volume/volume_file.hpp"

namespace fastsplat::cli {
namespace {

struct Arguments {
  Common common;
};

using Json = nlohmann::ordered_json;

struct Library {
  const char* name;
  const char* version;
};
constexpr Library kLibraries[] = {
    {"CLI11", VERSION_CLI11},
    {"fmt", VERSION_FMT},
    {"GLM", VERSION_GLM},
    {"nlohmann-json", VERSION_JSON},
    {"OpenImageIO", VERSION_OPENIMAGEIO},
    {"oneTBB", VERSION_TBB},
    {"teem", VERSION_TEEM},
    {"toml++", VERSION_TOMLPLUSPLUS},
    {"zlib", VERSION_ZLIB},
};

/// Processors that this process may use, which containers and taskset make fewer than there are.
int usable_processors() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return ::sched_getaffinity(0, sizeof(set), &set) == 0 ? CPU_COUNT(&set)
                                                        : static_cast<int>(::sysconf(_SC_NPROCESSORS_ONLN));
}

double memory_gb() {
  return static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE)) / 1e9;
}

bool is_synthetic(const std::string& name) {
  const auto names = volume::synthetic_names();
  return std::find(names.begin(), names.end(), name.substr(0, name.find(':'))) != names.end();
}

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  Json json{{"version", program_version()},
            {"build", VERSION_BUILD},
            {"compiler", VERSION_COMPILER},
            {"cmake", VERSION_CMAKE}};
  output.line(fmt::format("fastsplat {} ({} build, {}, CMake {})", program_version(), VERSION_BUILD, VERSION_COMPILER,
                          VERSION_CMAKE));
  output.line(fmt::format("machine: {} processors, {:.1f} GB memory", usable_processors(), memory_gb()));
  json["processors"] = usable_processors();
  json["memory_gb"] = memory_gb();

  output.line("libraries:");
  for (const auto& [name, version] : kLibraries) {
    const std::string text = *version == '\0' ? "unknown" : version;
    output.line(fmt::format("  {:14} {}", name, text));
    json["libraries"][name] = text;
  }

  output.line("scans:");
  bool all_there = true;
  json["scans"] = Json::array();
  for (const auto& name : volume::known_volume_names()) {
    if (is_synthetic(name)) continue;
    Json entry{{"name", name}};
    try {
      const auto volume = volume::read_volume_header(name);
      output.line(fmt::format("  {:16} found: {} ({}x{}x{})", name, volume.source, volume.dims.x, volume.dims.y,
                              volume.dims.z));
      entry["found"] = true;
      entry["source"] = volume.source;
    } catch (const UserError& error) {
      output.line(fmt::format("  {:16} missing", name));
      entry["found"] = false;
      entry["reason"] = error.what();
      all_there = false;
    }
    json["scans"].push_back(entry);
  }
  output.line(fmt::format("built-in volumes: {}", fmt::join(volume::synthetic_names(), ", ")));
  output.line(fmt::format("transfer functions: {}", fmt::join(scene::transfer_function_presets(), ", ")));
  output.line(fmt::format("demo scenes: {}", fmt::join(scene::demo_names(), ", ")));
  output.line(fmt::format("configurations: {}", fmt::join(driver::config_names(), ", ")));
  json["synthetics"] = volume::synthetic_names();
  json["transfer_functions"] = scene::transfer_function_presets();
  json["demos"] = scene::demo_names();
  json["configurations"] = driver::config_names();

  const std::string fix =
      "apt-get install mricron-data, or put the .nii.gz files in a folder and set FASTSPLAT_DATA to it";
  output.line(all_there ? "nothing is missing" : "missing scans: " + fix + "; everything else works without them");
  json["missing"] = Json::array();
  if (!all_there) json["missing"].push_back({{"what", "scans of mricron-data"}, {"fix", fix}});
  output.json(json.dump(2));
  return ExitCode::Pass;
}

void declare(Options& options, Arguments& to) { declare(options, to.common); }

}  // namespace

const Verb verbs::doctor{"doctor", "versions, processors, scans; what is missing and how to get it",
                         verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
