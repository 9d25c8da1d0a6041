// SPDX-License-Identifier: Apache-2.0
// Calls another program and keeps its output.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fastsplat {

struct Called {
  int code = 0;  ///< exit code; 127: program not found, 128 + signal, 124: timed out
  std::string out, err;
  /// The last non-empty line of stderr, else of stdout; else the exit code in words.
  std::string last_words() const;
};

/// Called with the program's output on stdout so far.
using Heard = std::function<void(const std::string& out)>;

/// Runs `words`, the program first, without stdin. Kills it after `seconds` (0: no limit). The program and its children
/// do not outlive this process. Throws UserError (Input) if no process can be started.
Called call(const std::vector<std::string>& words, int seconds, const Heard& heard = {});

}  // namespace fastsplat
