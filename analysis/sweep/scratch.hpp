// Where runs write before their files are published: a folder of this process alone, which goes when it goes.
#pragma once

#include <filesystem>
#include <string>

namespace fastsplat::plan {

/// FOLDER/.scratch/HOST.XXXXXX, locked as long as it is in use. Processes that were killed leave theirs behind: those
/// of this host that nobody locks are removed first. MachineError if FOLDER cannot be written.
class Scratch {
 public:
  explicit Scratch(const std::filesystem::path& folder);
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// An empty folder in it.
  std::filesystem::path fresh(const std::string& name) const;

  /// `folder` with those above it. MachineError where it cannot be made.
  static void make_folder(const std::filesystem::path& folder);

  /// Flushes `file` and gives it its name in the results: it is there whole or not at all, whoever else writes the
  /// same.
  static void publish(const std::filesystem::path& file, const std::filesystem::path& as);

 private:
  std::filesystem::path path_;
  int lock_ = -1;
};

}  // namespace fastsplat::plan
