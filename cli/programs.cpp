#include "cli/programs.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace fastsplat::cli {

bool in_path(const std::string& program) {
  const char* all = std::getenv("PATH");
  std::string folders = all == nullptr ? "" : all;
  while (!folders.empty()) {
    const auto end = std::min(folders.find(':'), folders.size());
    const std::filesystem::path candidate = std::filesystem::path(folders.substr(0, end)) / program;
    if (end > 0 && ::access(candidate.c_str(), X_OK) == 0) return true;
    folders.erase(0, end + 1);
  }
  return false;
}

}  // namespace fastsplat::cli
