// What must not stay behind when a signal ends the process: half-written files, folders made for them, helpers.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace fastsplat {

/// A file, or a folder made for files, that is to be gone unless it is kept: removed when this ends, or by the handler
/// of a signal. Nothing need be there; a folder goes only once it is empty.
class UnfinishedPath {
 public:
  explicit UnfinishedPath(std::filesystem::path path);
  ~UnfinishedPath();
  UnfinishedPath(const UnfinishedPath&) = delete;
  UnfinishedPath& operator=(const UnfinishedPath&) = delete;

  /// From now on it stays.
  void keep();

 private:
  std::filesystem::path path_;
  bool kept_ = false;
};

/// A child that works for this process: a signal that ends this one ends it first, so that it neither writes on nor
/// holds our stdout. One that leads a process group has five seconds to clean up; the whole group ends.
class HelperProcess {
 public:
  enum class Leads { Nothing, Group };
  explicit HelperProcess(pid_t child, Leads leads = Leads::Nothing);
  ~HelperProcess();
  HelperProcess(const HelperProcess&) = delete;
  HelperProcess& operator=(const HelperProcess&) = delete;

  /// Waits for its end; its status as waitpid() tells it. Once.
  int wait();

 private:
  void forget();

  pid_t child_;
  pid_t signalled_;  ///< as kill() takes it: of a group negative
};
/// In the child, first of all: it ends with its parent, however that ends.
void end_with_parent(pid_t parent);

/// Ends every HelperProcess, then removes every UnfinishedPath. Async-signal-safe: for the handler that ends the
/// process.
void remove_unfinished_files() noexcept;

}  // namespace fastsplat
