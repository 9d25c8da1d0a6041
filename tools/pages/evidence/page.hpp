// SPDX-License-Identifier: Apache-2.0
// Makes docs/evidence.md from the JSON of docs/evidence/: no figure on the page is typed by hand.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace fastsplat::evidence {

/// Reads the JSON of `folder`; the page names missing files. `now`, from tools/helpers/evidence_stamp.py, is {"rtl":
/// {module: hash}, "io": [module]}: each figure gets its day and the RTL modules that changed since. If `now` is null
/// the page omits those modules. Throws std::runtime_error or nlohmann's exceptions for an invalid file.
std::string page(const std::filesystem::path& folder, const nlohmann::ordered_json& now);

}  // namespace fastsplat::evidence
