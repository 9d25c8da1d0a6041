// SPDX-License-Identifier: Apache-2.0
// Results written at the end of a run: a failure to write one does not prevent the others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "cli/output.hpp"

namespace fastsplat::cli {

class ResultWriter {
 public:
  /// Calls `write`. A UserError from it is kept for report_failures(); other exceptions propagate.
  void write(const std::function<void()>& write);

  /// Error messages of the results that could not be written.
  const std::vector<std::string>& unwritten() const { return unwritten_; }

  /// Reports the failed writes: as warnings if `run`, the run's exit code, is not a pass; else as errors. Returns
  /// `run`, or after a pass the code of the first failed write.
  ExitCode report_failures(ExitCode run, const Output& output) const;

 private:
  std::vector<std::string> unwritten_;
  ExitCode first_ = ExitCode::Pass;
};

}  // namespace fastsplat::cli
