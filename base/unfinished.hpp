// SPDX-License-Identifier: Apache-2.0
// Cleans up when a signal ends the process: unfinished files, their folders, child processes.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace fastsplat {

/// A file, or a folder made for files, that destructor or signal handler remove unless it is kept. It need not exist; a
/// folder is removed only if it is empty.
class UnfinishedPath {
 public:
  explicit UnfinishedPath(std::filesystem::path path);
  ~UnfinishedPath();
  UnfinishedPath(const UnfinishedPath&) = delete;
  UnfinishedPath& operator=(const UnfinishedPath&) = delete;

  /// Keeps it from now on.
  void keep();

 private:
  std::filesystem::path path_;
  bool kept_ = false;
};

/// A child that works for this process. A signal that ends this process ends the child first, so that it stops writing
/// and releases our stdout. The leader of a process group has five seconds to clean up; then the whole group ends.
class HelperProcess {
 public:
  enum class Leads { Nothing, Group };
  explicit HelperProcess(pid_t child, Leads leads = Leads::Nothing);
  ~HelperProcess();
  HelperProcess(const HelperProcess&) = delete;
  HelperProcess& operator=(const HelperProcess&) = delete;

  /// Waits for its end and returns the status of waitpid(). Call it once.
  int wait();

 private:
  void forget();

  pid_t child_;
  pid_t signalled_;  ///< argument for kill(): negative for a group
};
/// Call first in the child: it then ends with its parent, however that ends.
void end_with_parent(pid_t parent);

/// Ends every HelperProcess, then removes every UnfinishedPath. Async-signal-safe: for the handler that ends the
/// process.
void remove_unfinished_files() noexcept;

}  // namespace fastsplat
