// SPDX-License-Identifier: Apache-2.0
// Finds the pictures of a report: those named by its results, and the user's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/results.hpp"

namespace fastsplat::report {

struct NamedPicture {
  std::string role;            ///< empty: from the file's metadata, else `otherwise`
  std::filesystem::path file;  ///< where it is
  std::string otherwise;       ///< role if the metadata have none
  bool wanted = false;         ///< requested by the user: an error if missing
  /// "ref" or "test" for pictures of a compare, else empty; in a report with the result's index in front: "0.ref".
  /// Pictures of one compare are shown together.
  std::string tie = {};
};

/// The files that a result names, one per picture, by preference: raw words, .exr, .tif, .png. Files that are not at
/// the named place are searched for beside the result.
std::vector<NamedPicture> pictures_of(const Result& result);

/// Parses "ROLE=FILE", where a role is [a-z][a-z0-9-]*. UserError (Usage) for other texts.
NamedPicture picture_from(const std::string& text);

/// The role of an engine's pictures: golden, integer, rtl; empty for unknown engines.
std::string role_of_engine(const std::string& engine);

}  // namespace fastsplat::report
