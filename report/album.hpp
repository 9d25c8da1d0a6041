// The pictures of a report: loaded, identified, and reduced to a limit of bytes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/page.hpp"
#include "report/picture.hpp"
#include "report/picture_names.hpp"

namespace fastsplat::report {

/// A point that must stay where pictures are cropped: a compare's worst pixel.
struct Focus {
  int x = 0, y = 0;
};

struct Album {
  std::vector<Picture> pictures;
  std::vector<std::string> missing;  ///< what the results name and is not to be had, each with the reason
};

/// A file is loaded once, in the user's role where the user gave one. Files that hold the same values in the same role
/// become one picture, the one with raw words. Pictures of the user's that are missing are a UserError (Input).
Album load_album(const std::vector<NamedPicture>& named);

struct Pages {
  Json entries = Json::array();  ///< of "pictures" in the page's data, docs/report.md
  std::vector<Block> blocks;
  std::vector<std::string> remarks;  ///< what had to be cropped or left out
};

/// Reduces the pictures to at most `bytes` of base64, if possible. Pictures for measuring are all cropped to one window
/// around `focus` (else the middle), as large as fits. If that is not enough, pictures for display are left out,
/// largest first.
Pages fit(const Album& album, Focus focus, std::size_t bytes);

}  // namespace fastsplat::report
