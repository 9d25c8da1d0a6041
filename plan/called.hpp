// Another program called and its words kept: for clients that answer soon, or are given up.
#pragma once

#include <string>
#include <vector>

namespace fastsplat::plan {

struct Called {
  int code = 0;  ///< exit code; 127 where there is no such program, 128 + signal, 124 when it was given up
  std::string out, err;
  /// The last line that says something, of stderr or else of stdout; else its exit code in words.
  std::string last_words() const;
};

/// Runs `words`, the program first, without stdin, for at most `seconds`; then it is killed. It does not outlive this
/// process. UserError (Input) where no process can be started.
Called call(const std::vector<std::string>& words, int seconds);

}  // namespace fastsplat::plan
