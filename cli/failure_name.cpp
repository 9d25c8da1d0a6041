// SPDX-License-Identifier: Apache-2.0
#include "cli/failure_name.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/error.hpp"
#include "base/machine_error.hpp"

namespace fastsplat::cli {
namespace {

namespace fs = std::filesystem;

bool same_place(const std::string& a, const std::string& b) {
  std::error_code ignored;
  const auto place = [&](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  return !a.empty() && !b.empty() && place(a) == place(b);
}

bool free_of_files(const std::string& prefix, const std::vector<std::string>& taken) {
  const auto files = failure_files(prefix);
  return std::none_of(files.begin(), files.end(), [&](const std::string& file) {
    std::error_code ignored;
    // Dangling links exist, too.
    return fs::exists(fs::symlink_status(file, ignored)) ||
           std::any_of(taken.begin(), taken.end(), [&](const std::string& name) { return same_place(name, file); });
  });
}

}  // namespace

FailureName::FailureName(const std::string& stem, const std::vector<std::string>& taken) {
  for (int number = 1;; ++number) {
    prefix_ = number == 1 ? stem : fmt::format("{}-{}", stem, number);
    const fs::path path(prefix_);
    const fs::path claim = path.parent_path() / (".tmp-claim." + path.filename().string());
    // The system lets only one of several runs create the claim; only that run looks for existing files.
    const int descriptor = ::open(claim.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (descriptor < 0) {
      if (errno == EEXIST) continue;
      throw_machine({.where = prefix_ + ".fss",
                     .what = std::string("cannot write: ") + std::strerror(errno),
                     .expected = {},
                     .got = {},
                     .fix = "name a writable place for the failure's files with --failure PREFIX"});
    }
    ::close(descriptor);
    claim_.emplace(claim);
    if (free_of_files(prefix_, taken)) return;
    claim_.reset();
  }
}

std::vector<std::string> failure_files(const std::string& prefix) {
  return {prefix + ".fss", prefix + ".fst", prefix + ".gtkw"};
}

}  // namespace fastsplat::cli
