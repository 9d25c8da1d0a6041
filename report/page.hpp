// SPDX-License-Identifier: Apache-2.0
// The page: inserts a report's data into a template built from report/web.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fastsplat::report {

/// The placeholder for the data, once in the template.
inline constexpr std::string_view kDataMark = "<!--FASTSPLAT-DATA-->";

/// report/template.html, as it was when the build was configured.
const std::string& page_template();

/// Data beside the JSON: a picture's bytes.
struct Block {
  std::string id;     ///< of the element: [a-z0-9-]+
  std::string bytes;  ///< any; written as base64
};

/// JSON that is safe in a page: < > & and the line ends U+2028 and U+2029 are written as \u.... They occur in JSON only
/// within strings, so the value stays the same.
std::string script_safe(std::string_view json);

/// `page` with <script type="application/json" id="data"> and one <script type="text/plain"> per block in place of the
/// mark. No other byte changes, because the template's policy names its script by hash. std::logic_error unless the
/// mark occurs exactly once: the template is then wrong, not the input.
std::string filled(std::string_view page, std::string_view json, const std::vector<Block>& blocks);

}  // namespace fastsplat::report
