// Results that a run writes one behind the other: one that cannot be written takes none of the others away.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/output.hpp"

namespace fastsplat::cli {

class LateResults {
 public:
  /// Calls `write`. A UserError that it throws is kept for tell(); what else it throws goes on.
  void write(const std::function<void()>& write);

  /// Why there is none, of those that could not be written.
  const std::vector<std::string>& unwritten() const { return unwritten_; }

  /// Says of each why. `run`: the exit code of the run, which stays where it is none of a pass, and that is a warning
  /// then; else an error, and the code of the first.
  ExitCode tell(ExitCode run, const Output& output) const;

 private:
  std::vector<std::string> unwritten_;
  ExitCode first_ = ExitCode::Pass;
};

}  // namespace fastsplat::cli
