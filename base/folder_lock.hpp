// SPDX-License-Identifier: Apache-2.0
// Lets one process at a time change a file that several may add to.
#pragma once

#include <filesystem>

namespace fastsplat {

/// Waits for the lock of the folder that contains `path`; releases it in the destructor or when the process ends. The
/// folder itself is locked, because the file is replaced at each write and a separate lock file would stay behind.
/// Throws UserError (Input) if the folder cannot be opened.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& path);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace fastsplat
