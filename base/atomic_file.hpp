// SPDX-License-Identifier: Apache-2.0
// A result file appears whole under its final name or not at all.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "base/unfinished.hpp"

namespace fastsplat {

/// Writes beside `path` under a temporary name with the same extension, then renames over it.
/// On any failure (exception while writing, disk full, no permission) the temporary file is removed and a
/// UserError (ExitCode::Input) names `path` and the reason. A link's target is replaced, not the link; an existing path
/// that is not a regular file, or is write-protected, is refused.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write: in the folder of the final path, with the same extension (.nii.gz, too).
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Flushes the temporary file to disk and renames it to the final path.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  std::optional<UnfinishedPath> unfinished_;  ///< the temporary file, until it is committed
};

/// Writes `text` to `path` atomically; directly if it is a device or a pipe (/dev/null, /dev/stdout).
void write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace fastsplat
