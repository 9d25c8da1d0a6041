// SPDX-License-Identifier: Apache-2.0
// Makes one offline page from results and pictures.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "report/picture_names.hpp"
#include "report/results.hpp"

namespace fastsplat::report {

struct Request {
  std::vector<Result> results;
  std::vector<NamedPicture> pictures;  ///< the user's, besides those named by the results
  std::size_t most_bytes = 5'000'000;  ///< of the page; pictures are cropped to stay below
};

struct Report {
  std::string html;
  Verdict verdict;                   ///< of all results; Measured and empty without results
  std::size_t pictures = 0;          ///< in the page
  std::vector<std::string> remarks;  ///< missing, cropped or omitted pictures; also in the page
};

/// Deterministic: equal requests give equal bytes (with the same zlib). UserError (Input) for pictures of the user's
/// that cannot be read.
Report make_report(const Request& request);

/// The page's "data" without its pictures: docs/report.md has its keys.
Json page_data(const std::vector<Result>& results);

}  // namespace fastsplat::report
