// SPDX-License-Identifier: Apache-2.0
// Processes by /proc: which belong to a folder, whether they have ended, and ending them by their id.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace fastsplat::slurm_test {

/// A process that names a folder in its command line, its environment or by working in it.
struct Process {
  pid_t id = 0, parent = 0;
  std::string command;      ///< its words with blanks between
  std::string environment;  ///< "A=1\nB=2\n"
  bool has(const std::string& setting) const {
    return ("\n" + environment).find("\n" + setting + "\n") != std::string::npos;
  }
};

/// All living ones but this process; a zombie is dead already.
std::vector<Process> processes_of(const std::filesystem::path& folder);

/// Starts `words` with `environment` added, both streams at the end of `log`, no other descriptor inherited; ends with
/// TERM when this process dies. Throws if it cannot be started.
pid_t start_daemon(const std::vector<std::string>& words, const std::vector<std::string>& environment,
                   const std::filesystem::path& log);
/// TERM, then KILL after ten seconds, to a child process; waits for it.
void end_child(pid_t child);

/// Polls every 50 ms. False if `seconds` pass first.
bool wait_until(const std::function<bool()>& condition, double seconds);

}  // namespace fastsplat::slurm_test
