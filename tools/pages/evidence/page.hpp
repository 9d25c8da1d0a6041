// docs/evidence.md from the JSON of docs/evidence/: nothing on the page is typed by hand but its words.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace fastsplat::evidence {

/// Reads the JSON of `folder`; what is not there is said to be missing. `now` is of tools/helpers/evidence_stamp.py,
/// {"rtl": {module: hash}}: each figure is told with its day and with the modules of the RTL that have changed since;
/// null says nothing of it. Throws std::runtime_error, or what nlohmann's JSON throws, for a file that is wrong.
std::string page(const std::filesystem::path& folder, const nlohmann::ordered_json& now);

}  // namespace fastsplat::evidence
