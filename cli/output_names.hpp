// SPDX-License-Identifier: Apache-2.0
// Checks a command's file names: results must be writable and must not replace its inputs.
#pragma once

#include <string>
#include <vector>

#include "cli/scene_flags.hpp"

namespace fastsplat::cli {

/// The files of a command; empty names and "-" are ignored.
struct OutputNames {
  std::vector<std::string> images{};  ///< .exr, .png, .tif
  std::vector<std::string> maps{};    ///< .png
  std::vector<std::string> raws{};    ///< .exr
  std::vector<std::string> others{};  ///< any extension: JSON, scene, stream
  std::vector<std::string> inputs{};  ///< files that the command reads and must not replace
};

/// Throws UserError, before any work, unless every output has a known extension, can be created, is named once, and is
/// not also an input under any name (links, hard links). Call it last of all checks: if pictures are named it loads the
/// image library (0.25 s).
void check_outputs(const OutputNames& names);

/// UserError (Usage) for "-": only --json may write to standard output.
void require_file(const char* flag, const std::string& path);

/// Files that a command reads, as far as its arguments show; words that name no file are harmless. Reads a scene's file
/// for the names in it.
std::vector<std::string> inputs_of(const SceneFlags& scene);
/// A configuration's file; empty for built-in names.
std::vector<std::string> inputs_of_config(const std::string& name_or_path);
/// A volume's file, and its data file if separate.
std::vector<std::string> inputs_of_volume(const std::string& name_or_path);
std::vector<std::string> joined(std::vector<std::string> a, const std::vector<std::string>& b);

}  // namespace fastsplat::cli
