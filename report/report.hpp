// One offline page from results and pictures.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/picture_names.hpp"
#include "report/results.hpp"

namespace fastsplat::report {

struct Request {
  std::vector<Result> results;
  std::vector<NamedPicture> pictures;  ///< the user's, beside those that the results name
  std::size_t most_bytes = 5'000'000;  ///< of the page; pictures are cropped to keep below
};

struct Report {
  std::string html;
  Verdict verdict;                   ///< of all results; Measured and empty when there are none
  std::size_t pictures = 0;          ///< that are in it
  std::vector<std::string> remarks;  ///< pictures that are missing, cropped or left out; in the page too
};

/// The same request gives the same bytes (with the same zlib). UserError (Input) for pictures of the user's that cannot
/// be read.
Report make_report(const Request& request);

/// "data" of the page but for its pictures: docs/report.md has its keys.
Json page_data(const std::vector<Result>& results);

}  // namespace fastsplat::report
