// The page: a template built from report/web, with a report's data put in its place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fastsplat::report {

/// What the template holds once, where the data goes.
inline constexpr std::string_view kDataMark = "<!--FASTSPLAT-DATA-->";

/// report/template.html as it was when the program was configured.
const std::string& page_template();

/// Text beside the data: a picture's bytes.
struct Block {
  std::string id;     ///< of the element: [a-z0-9-]+
  std::string bytes;  ///< any; goes in as base64
};

/// JSON that may stand in a page: < > & and the two line ends that scripts know are written as \u.... They occur in
/// JSON within strings only, so it stays the same value.
std::string script_safe(std::string_view json);

/// `page` with <script type="application/json" id="data"> and one <script type="text/plain"> a block in the mark's
/// place. Every other byte is as it was: the template's policy names its script by hash. std::logic_error when the mark
/// is not there exactly once: whoever built the template erred, not the user.
std::string filled(std::string_view page, std::string_view json, const std::vector<Block>& blocks);

}  // namespace fastsplat::report
