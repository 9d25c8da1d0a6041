// SPDX-License-Identifier: Apache-2.0
#include "base/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "base/error.hpp"
#include "base/machine_error.hpp"

namespace fastsplat {

FolderLock::FolderLock(const std::filesystem::path& path) {
  // Resolve links, as writing does: two names of one file must lock the same folder.
  std::error_code ignored;
  const auto whole = std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
  const auto folder = whole.has_parent_path() ? whole.parent_path() : std::filesystem::path(".");
  descriptor_ = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  int outcome = -1;
  if (descriptor_ >= 0) {
    do {
      outcome = ::flock(descriptor_, LOCK_EX);
    } while (outcome != 0 && errno == EINTR);
  }
  if (outcome == 0) return;
  const int reason = errno;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw_machine({.where = path.string(),
                 .what = std::string("cannot lock its folder: ") + std::strerror(reason),
                 .expected = {},
                 .got = {},
                 .fix = "use your own folder on a local disk"});
}

FolderLock::~FolderLock() { ::close(descriptor_); }

}  // namespace fastsplat
