// Runs of the program as children: started, awaited together with signals, ended.
#pragma once

#include <signal.h>
#include <sys/types.h>

#include <optional>
#include <string>

#include "analysis/sweep/value.hpp"

namespace fastsplat::plan {

/// How a child ended, and what it took.
struct Ended {
  pid_t pid = 0;
  int exit_code = 0;  ///< 128 + signal where a signal ended it
  int signal = 0;     ///< that ended it, or that it says it was ended by (exit code above 128); else 0
  double cpu_seconds = 0.0;
  std::string message{};  ///< the last line it wrote to stderr, without "fastsplat: error:"
};

/// The children of this process, in process groups of their own: Ctrl-C reaches this process alone, which ends them.
/// A child does not outlive this process, however that ends. As long as this lives, SIGINT, SIGTERM and SIGHUP are
/// taken by wait() alone (where they are ignored, they stay so). One thread only.
class Children {
 public:
  Children();
  ~Children();  ///< ends what still runs
  Children(const Children&) = delete;
  Children& operator=(const Children&) = delete;

  /// Starts `program`, called fastsplat, with `words` after its name; stdin and stdout are /dev/null, the environment
  /// has kReportMachine. MachineError where the system has no process left.
  pid_t start(const std::string& program, const Words& words);

  /// Waits for the next event: a child's end, or a signal that asks to stop (then `signal()` tells it).
  std::optional<Ended> wait();
  int signal() const { return signal_; }

  /// TERM to all, after five seconds KILL, and waits for their ends.
  void end_all();

 private:
  struct Child {
    pid_t pid;
    int errors;  ///< what it wrote to stderr, in memory
  };
  std::optional<Ended> reap();

  std::vector<Child> running_;
  sigset_t taken_{}, before_{};
  int signal_ = 0;
};

}  // namespace fastsplat::plan
