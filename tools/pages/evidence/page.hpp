// docs/evidence.md from the JSON of docs/evidence/: no figure on the page is typed by hand.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace fastsplat::evidence {

/// Reads the JSON of `folder`; missing files are named on the page. `now` comes from tools/helpers/evidence_stamp.py,
/// {"rtl": {module: hash}}: each figure has its day and the modules of the RTL that have changed since. With null the
/// page leaves those modules out. Throws std::runtime_error or nlohmann's exceptions for an invalid file.
std::string page(const std::filesystem::path& folder, const nlohmann::ordered_json& now);

}  // namespace fastsplat::evidence
