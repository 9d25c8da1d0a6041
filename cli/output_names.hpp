// The files of a command by name: results that can be written, and that replace nothing the command reads.
#pragma once

#include <string>
#include <vector>

#include "cli/scene_flags.hpp"

namespace fastsplat::cli {

/// The files of a command; empty names and "-" stand for none.
struct OutputNames {
  std::vector<std::string> images{};  ///< .exr, .png, .tif
  std::vector<std::string> maps{};    ///< .png
  std::vector<std::string> raws{};    ///< .exr
  std::vector<std::string> others{};  ///< any ending: JSON, scene, stream
  std::vector<std::string> inputs{};  ///< files that the command reads and must not replace
};

/// Every name has a known ending, can be created, is named once and is no file that the command reads, under whatever
/// name (links, hard links); else a UserError, before any time is spent. Last of what a command checks: where pictures
/// are named it opens the image library (0.25 s).
void check_outputs(const OutputNames& names);

/// UserError (Usage) for "-": a file, not standard output, which only --json writes to.
void require_file(const char* flag, const std::string& path);

/// What a command reads, as far as its words tell; names that are no files do no harm. A scene's file is read for what
/// it names.
std::vector<std::string> inputs_of(const SceneFlags& scene);
/// A configuration's file; a built-in name is none.
std::vector<std::string> inputs_of_config(const std::string& name_or_path);
/// A volume's file, and its data file where that is another.
std::vector<std::string> inputs_of_volume(const std::string& name_or_path);
std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b);

}  // namespace fastsplat::cli
