// SPDX-License-Identifier: Apache-2.0
// Runs the program in child processes: starts them, waits for them and for signals, ends them.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <functional>
#include <optional>
#include <string>

#include "analysis/sweep/value.hpp"

namespace fastsplat::plan {

/// Runs the words of a command in a fork of this process and returns the exit code.
using Program = std::function<int(const Words&)>;

/// How a child ended, and its CPU time.
struct Ended {
  pid_t pid = 0;
  int exit_code = 0;  ///< 128 + signal where a signal ended it
  int signal = 0;     ///< the signal that ended it, or that its exit code above 128 reports; else 0
  double cpu_seconds = 0.0;
  std::string message{};  ///< the last line it wrote to stderr, without "fastsplat: error:"
};

/// The children of this process, each in its own process group: Ctrl-C reaches only this process, which ends them. No
/// child outlives this process, however it ends. While the object exists, only wait() receives SIGINT, SIGTERM and
/// SIGHUP (ignored signals stay ignored). For a process with one thread: a fork has no others.
class Children {
 public:
  Children();
  ~Children();  ///< ends the children that still run
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  /// Forks this process, which calls `program`. stdin and stdout are /dev/null; the environment contains
  /// kReportMachine. Throws MachineError if the system cannot start a process.
  pid_t start(const Program& program, const Words& words);

  /// Waits for the next event: the end of a child, or a signal to stop (nullopt; see signal()).
  std::optional<Ended> wait();
  int signal() const { return signal_; }

  /// Sends TERM to all, after five seconds KILL, and waits for their ends.
  void end_all();

 private:
  struct Child {
    pid_t pid;
    int errors;  ///< memory file with its stderr
  };
  std::optional<Ended> reap();

  std::vector<Child> running_;
  sigset_t taken_{}, before_{};
  int signal_ = 0;
};

}  // namespace fastsplat::plan
