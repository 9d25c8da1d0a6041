// SPDX-License-Identifier: Apache-2.0
// A folder of this process for files that are not published yet; removed with the process.
#pragma once

#include <filesystem>
#include <string>

namespace fastsplat::plan {

/// FOLDER/.scratch/HOST.XXXXXX, locked while in use. Killed processes leave theirs behind: unlocked ones of this host
/// are removed first. Throws MachineError if FOLDER cannot be written.
class Scratch {
 public:
  explicit Scratch(const std::filesystem::path& folder);
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// An empty folder in it.
  std::filesystem::path fresh(const std::string& name) const;

  /// Creates `folder` and its parents. Throws MachineError on failure.
  static void make_folder(const std::filesystem::path& folder);

  /// Flushes `file` and renames it to `as`: atomic even if others publish the same file.
  static void publish(const std::filesystem::path& file, const std::filesystem::path& as);

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace fastsplat::plan
