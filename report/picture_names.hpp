// The pictures of a report: the ones named by its results, and the user's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/results.hpp"

namespace fastsplat::report {

struct NamedPicture {
  std::string role;            ///< empty: as the file's own metadata tell, else `otherwise`
  std::filesystem::path file;  ///< where it is
  std::string otherwise;       ///< role of a file that does not tell
  bool wanted = false;         ///< the user asked for it: that it is missing is an error
  /// "ref" or "test" of a compare, empty of others; in a report behind the result's place: "0.ref". Pictures of one
  /// compare are seen together.
  std::string tie = {};
};

/// The files a result names, one of each picture: raw words rather than .exr, .exr rather than .tif, that rather than
/// .png. A file that is not where the result says is looked for beside the result.
std::vector<NamedPicture> pictures_of(const Result& result);

/// "ROLE=FILE". UserError (Usage) for what has another shape; a role is [a-z][a-z0-9-]*.
NamedPicture picture_from(const std::string& text);

/// The role of what an engine drew: golden, integer, rtl; empty for another.
std::string role_of_engine(const std::string& engine);

}  // namespace fastsplat::report
