// A result file appears whole under its final name or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace fastsplat {

/// Writes beside `path` under a temporary name with the same extension, then renames over it.
/// On any failure (exception from `write`, disk full, no permission) the temporary file is removed and a
/// UserError (ExitCode::Input) names `path` and the reason.
class AtomicFile {
 public:
  explicit AtomicFile(std::filesystem::path path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Where to write; same folder and extension as the final path.
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Flushes the temporary file to disk and renames it to the final path.
  void commit();

 private:
  std::filesystem::path path_;
  std::filesystem::path temporary_;
  bool committed_ = false;
};

/// `text` to `path`, atomically.
void write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace fastsplat
