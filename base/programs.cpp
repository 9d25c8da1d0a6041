// SPDX-License-Identifier: Apache-2.0
#include "base/programs.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace fastsplat {

namespace fs = std::filesystem;

std::string path_of(const std::string& program) {
  const char* all = std::getenv("PATH");
  std::string folders = all == nullptr ? "" : all;
  std::error_code ignored;
  while (!folders.empty()) {
    const auto end = std::min(folders.find(':'), folders.size());
    const fs::path candidate = fs::path(folders.substr(0, end)) / program;
    if (end > 0 && ::access(candidate.c_str(), X_OK) == 0 && fs::is_regular_file(candidate, ignored))
      return candidate.string();
    folders.erase(0, end + 1);
  }
  return {};
}

bool in_path(const std::string& program) { return !path_of(program).empty(); }

}  // namespace fastsplat
