// docs/evidence.md from the JSON of docs/evidence/: nothing on the page is typed by hand but its words.
#pragma once

#include <filesystem>
#include <string>

namespace fastsplat::evidence {

/// Reads `folder`/synthesis.json, icarus.json, netlist.json and proofs.json; what is not there is said to be missing.
/// Throws std::runtime_error, or what nlohmann's JSON throws, for a file that is wrong.
std::string page(const std::filesystem::path& folder);

}  // namespace fastsplat::evidence
