// Calls another program and keeps what it prints.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fastsplat {

struct Called {
  int code = 0;  ///< exit code; 127 where there is no such program, 128 + signal, 124 when it was given up
  std::string out, err;
  /// The last line that says something, of stderr or else of stdout; else its exit code in words.
  std::string last_words() const;
};

/// Called with what the program has printed to stdout so far.
using Heard = std::function<void(const std::string& out)>;

/// Runs `words`, the program first, without stdin, for at most `seconds` (0: however long it takes); then it is killed.
/// It and what it starts do not outlive this process. UserError (Input) where no process can be started.
Called call(const std::vector<std::string>& words, int seconds, const Heard& heard = {});

}  // namespace fastsplat
