// SPDX-License-Identifier: Apache-2.0
// The pictures of a report: loads and identifies them, and reduces them to a size limit in bytes.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/page.hpp"
#include "report/picture.hpp"
#include "report/picture_names.hpp"

namespace fastsplat::report {

/// A point that cropping must keep: a compare's worst pixel.
struct Focus {
  int x = 0, y = 0;
};

struct Album {
  std::vector<Picture> pictures;
  std::vector<std::string> missing;  ///< one message for each picture that a result names but that cannot be read
};

/// Loads each file once, in the user's role if given. Files with the same values and role become one picture,
/// preferably the one with raw words. UserError (Input) for pictures of the user's that cannot be read.
Album load_album(const std::vector<NamedPicture>& named);

struct Pages {
  Json entries = Json::array();  ///< "pictures" of the page's data, docs/report.md
  std::vector<Block> blocks;
  std::vector<std::string> remarks;  ///< pictures that were cropped or left out
};

/// Reduces the pictures to at most `bytes` of base64, if possible. Crops all pictures for measuring to one window
/// around `focus`, as large as fits. If that is not enough, leaves out pictures for display, largest first.
Pages fit(const Album& album, Focus focus, std::size_t bytes);

}  // namespace fastsplat::report
