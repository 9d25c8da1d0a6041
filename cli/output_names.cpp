// SPDX-License-Identifier: Apache-2.0
#include "cli/output_names.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/images/image_file.hpp"
#include "base/lower_case.hpp"
#include "driver/config/config_file.hpp"
#include "scene/scene_file.hpp"
#include "scene/transfer_function.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::cli {
namespace {

namespace fs = std::filesystem;

void require_ending(const std::string& path, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), ending_of(path)) != known.end()) return;
  throw_usage({.where = path,
               .what = "unsupported image extension",
               .expected = fmt::format("{}", fmt::join(known, ", ")),
               .got = ending_of(path).empty() ? "none" : ending_of(path),
               .fix = "end the name in " + known.front()});
}

// Devices and pipes accept text; other files must be creatable.
void require_writable(const std::string& path) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  if (fs::is_character_file(status) || fs::is_fifo(status)) return;
  const AtomicFile probe(path);
}

/// Files in use, identified by path and, if they exist, by inode.
class Taken {
 public:
  enum class Role { Read, Written };

  /// The role of a file already in use; null if it is free.
  const Role* find(const std::string& path) const {
    for (const auto& key : keys(path)) {
      const auto found = roles_.find(key);
      if (found != roles_.end()) return &found->second;
    }
    return nullptr;
  }
  void add(const std::string& path, Role role) {
    for (const auto& key : keys(path)) roles_.emplace(key, role);
  }

 private:
  static std::vector<std::string> keys(const std::string& path) {
    std::error_code ignored;
    std::vector<std::string> keys{fs::weakly_canonical(fs::absolute(path, ignored), ignored).string()};
    struct stat status {};
    // Only regular files conflict; a terminal or /dev/null may be named repeatedly.
    if (::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode))
      keys.push_back(fmt::format("inode {}:{}", status.st_dev, status.st_ino));
    return keys;
  }
  std::map<std::string, Role> roles_;
};

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void check_outputs(const OutputNames& names) {
  Taken taken;
  for (const auto& path : names.inputs) {
    if (!path.empty()) taken.add(path, Taken::Role::Read);
  }
  const auto take = [&](const std::string& path) {
    if (path.empty() || path == "-") return;
    if (const auto* role = taken.find(path)) {
      const bool read = *role == Taken::Role::Read;
      throw_usage({.where = path,
                   .what = read ? "the same name for an input and an output, which would replace it"
                                : "the same name for two outputs",
                   .expected = {},
                   .got = {},
                   .fix = read ? "give the result another name" : "give each output its own name"});
    }
    taken.add(path, Taken::Role::Written);
    require_writable(path);
  };
  for (const auto& path : names.images) {
    require_ending(path, {".exr", ".png", ".tif", ".tiff"});
    take(path);
  }
  for (const auto& path : names.maps) {
    if (!path.empty()) require_ending(path, {".png"});
    take(path);
  }
  for (const auto& path : names.raws) {
    if (!path.empty()) require_ending(path, {".exr"});
    take(path);
  }
  for (const auto& path : names.others) take(path);
  for (const auto& path : names.images) images::require_library(path);
}

void require_file(const char* flag, const std::string& path) {
  if (path != "-") return;
  throw_usage({.where = std::string(flag) + " -",
               .what = "only --json goes to standard output",
               .expected = {},
               .got = {},
               .fix = "name a file"});
}

std::vector<std::string> inputs_of(const SceneFlags& flags) {
  const scene::SceneFile file = flags.file ? scene::read_scene_file(*flags.file) : scene::SceneFile{};
  auto inputs = inputs_of_volume(flags.volume.value_or(file.description.volume));
  if (flags.file) inputs.push_back(*flags.file);
  const auto& tf = flags.transfer_function.value_or(file.description.transfer_function);
  if (!contains(scene::transfer_function_presets(), tf)) inputs.push_back(tf);
  return inputs;
}

std::vector<std::string> inputs_of_config(const std::string& name_or_path) {
  return contains(driver::config_names(), name_or_path) ? std::vector<std::string>{} : std::vector{name_or_path};
}

std::vector<std::string> inputs_of_volume(const std::string& name_or_path) {
  std::vector<std::string> names;
  for (const auto& path : volume::files_of(name_or_path)) names.push_back(path.string());
  return names;
}

std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

}  // namespace fastsplat::cli
