// SPDX-License-Identifier: Apache-2.0
#include "cli/plan_vocabulary.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <map>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/hash_text.hpp"
#include "base/read_file.hpp"
#include "cli/command_line.hpp"
#include "cli/config_flags.hpp"
#include "cli/output_names.hpp"
#include "driver/config/changed.hpp"
#include "scene/scene_file.hpp"

namespace fastsplat::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 34;

/// Differs once a file was written or replaced.
struct Version {
  ino_t file = 0;
  off_t bytes = 0;
  timespec written{};
  bool operator==(const Version& other) const {
    return file == other.file && bytes == other.bytes && written.tv_sec == other.written.tv_sec &&
           written.tv_nsec == other.written.tv_nsec;
  }
};

Version version_of(const fs::path& path) {
  struct stat now {};
  if (::stat(path.c_str(), &now) != 0) return {};
  return {now.st_ino, now.st_size, now.st_mtim};
}

struct HashedFile {
  Version version;
  std::string hash;
};
std::map<fs::path, HashedFile>& hashed_files() {
  static std::map<fs::path, HashedFile> known;
  return known;
}

/// The hash of a file's bytes; each file is read once.
std::string hash_of_file(const fs::path& path) {
  HashedFile& file = hashed_files()[path];
  if (file.hash.empty()) {
    file.version = version_of(path);
    file.hash = hash_text(fnv1a(kFnv1aStart, read_text_file(path, kMostBytes)));
  }
  return file.hash;
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

bool has(const std::vector<std::string>& flags, const std::string& flag) {
  return std::ranges::find(flags, flag) != flags.end();
}

const std::vector<std::string>& known_flags(const std::string& subcommand) {
  static std::map<std::string, std::vector<std::string>> known;
  auto& flags = known[subcommand];
  if (flags.empty()) flags = flags_of(subcommand);
  return flags;
}

Action parse_words(const plan::Words& words, const std::vector<Subcommand>& subcommands) {
  std::vector<const char*> argv{"fastsplat"};
  for (const auto& word : words) argv.push_back(word.c_str());
  return parse(static_cast<int>(argv.size()), argv.data(), subcommands);
}

/// Hash of a scene's settings and the bytes of the files it names; their paths do not count.
std::string hash_of_scene(scene::SceneDescription description) {
  const scene::SceneDescription plain;
  std::uint64_t hash = kFnv1aStart;
  for (const auto& path : inputs_of_volume(description.volume)) hash = fnv1a(fnv1a(hash, "volume"), hash_of_file(path));
  if (hash != kFnv1aStart) description.volume = plain.volume;
  if (is_file(description.transfer_function)) {
    hash = fnv1a(fnv1a(hash, "transfer function"), hash_of_file(description.transfer_function));
    description.transfer_function = plain.transfer_function;
  }
  return hash_text(fnv1a(hash, scene::to_toml(description)));
}

SceneFlags& scene_flags() {
  static SceneFlags flags;
  return flags;
}

/// `render` with the flags of a scene only; parsing fills scene_flags().
const std::vector<Subcommand>& scene_render() {
  static const std::vector<Subcommand> subcommands{{"render", "", [](Options& options) {
                                                      scene_flags() = {};
                                                      declare(options, scene_flags());
                                                      return Action([] { return ExitCode::Pass; });
                                                    }}};
  return subcommands;
}

plan::Words scene_words(const plan::Settings& settings) {
  static const auto names = flags_of("render", scene_render());
  plan::Words words{"render"};
  for (const auto& [name, value] : settings) {
    if (!has(names, "--" + name)) continue;
    const auto* flag = std::get_if<bool>(&value);
    if (flag == nullptr) {
      words.push_back("--" + name + "=" + plan::to_text(value));
    } else if (*flag) {
      words.push_back("--" + name);
    }
  }
  return words;
}

/// Hash of the scene that `settings` describe, cached.
std::string scene_hash(const plan::Settings& settings) {
  static std::map<std::string, std::string> known;
  auto& hash = known[plan::shell_line(scene_words(settings))];
  if (hash.empty()) hash = hash_of_scene(scene_of(settings));
  return hash;
}

std::string config_hash(const plan::Settings& settings) {
  ConfigFlags flags;
  for (const auto& [name, value] : settings) {
    const std::string text = plan::to_text(value);
    if (plan::is_key(name)) flags.changes.push_back(name + "=" + text);
    if (name == "config") flags.config = text;
    if (name == "index") flags.changes.push_back("--index " + text);
  }
  static std::map<std::string, cmodel::Config> known;  // each file is read once
  const std::string name = flags.config.value_or("base");
  if (is_file(name)) hash_of_file(name);  // for changed_file()
  if (!known.contains(name)) known[name] = load(name, {});
  return hash_text(cmodel::config_hash(driver::changed(known.at(name), flags.changes)));
}

plan::Content content_of(const plan::Settings& settings, const std::vector<std::string>& subcommands) {
  const auto set = [&](const char* name) { return std::ranges::find(settings, name, &plan::Setting::name); };
  plan::Content content;
  for (const auto& subcommand : subcommands) {
    const auto& flags = known_flags(subcommand);
    if (content.config_hash.empty() && has(flags, "--config")) content.config_hash = config_hash(settings);
    const bool has_other = (has(flags, "--random") && set("random") != settings.end());
    if (!content.scene_hash.empty() || has_other) continue;
    if (const auto stream = set("stream"); has(flags, "--stream") && stream != settings.end()) {
      const std::string path = plan::to_text(stream->value);
      require_regular_file(path);
      content.scene_hash = hash_of_file(path);
    } else if (has(flags, "--volume")) {
      content.scene_hash = scene_hash(settings);
    }
  }
  return content;
}

/// The subcommand that a case names, with those of its group: building all of them is most of the time of a case.
std::vector<Subcommand> named_by(const plan::Words& words) {
  std::vector<Subcommand> some;
  std::ranges::copy_if(all_subcommands(), std::back_inserter(some), [&](const Subcommand& one) {
    return words.front() == one.name || std::string_view(one.name).starts_with(words.front() + " ");
  });
  return some;
}

std::vector<std::string> subcommands_of(const plan::Case& one) {
  std::vector<std::string> subcommands;
  for (const auto& step : one.steps) subcommands.push_back(step.result.empty() ? step.words.front() : step.result);
  return subcommands;
}

}  // namespace

plan::Vocabulary plan_vocabulary() {
  return {.flags_of = [](const std::string& subcommand) { return known_flags(subcommand); },
          .check = [](const plan::Words& words) { parse_words(words, named_by(words)); },
          .content = content_of};
}

scene::SceneDescription scene_of(const plan::Settings& settings) {
  parse_words(scene_words(settings), scene_render());
  if (const auto& file = scene_flags().file; file && is_file(*file)) hash_of_file(*file);  // for changed_file()
  return describe(scene_flags());
}

void require_content(const plan::Plan& plan, const std::string& plan_file) {
  plan::require_made(plan, plan_vocabulary(), plan_file);  // first: it has every later subcommand
  for (const auto& one : plan.cases) {
    if (content_of(one.settings, subcommands_of(one)) == one.content) continue;
    throw_input(
        {.where = plan_file,
         .what = fmt::format("case {}: its configuration or scene changed after the plan was made", one.id),
         .expected = fmt::format("configuration {}, scene {}", one.content.config_hash, one.content.scene_hash),
         .got = {},
         .fix = "run it in the folder where the plan was made, or make the plan again with `fastsplat plan make`"});
  }
}

std::string changed_file() {
  for (const auto& [path, file] : hashed_files())
    if (!(version_of(path) == file.version)) return path.string();
  return {};
}

std::string program_hash() {
  return hash_text(fnv1a(kFnv1aStart, read_text_file("/proc/self/exe", kMostBytes)));
}

}  // namespace fastsplat::cli
