// One process at a time changes a file that several may add to.
#pragma once

#include <filesystem>

namespace fastsplat {

/// Waits until no other holds the lock of the folder in which `path` lies; releases it when it goes, or the process
/// does. The folder itself is locked: the file is replaced whenever it is written, and a lock file beside it would
/// stay behind. UserError (Input) where the folder cannot be opened.
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
