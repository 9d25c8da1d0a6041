// SPDX-License-Identifier: Apache-2.0
#include "cli/result_writer.hpp"

#include "base/machine_error.hpp"

namespace fastsplat::cli {

void ResultWriter::write(const std::function<void()>& write) {
  try {
    write();
  } catch (const UserError& error) {
    if (unwritten_.empty()) first_ = exit_code_of(error);
    unwritten_.emplace_back(error.what());
  }
}

ExitCode ResultWriter::report_failures(ExitCode run, const Output& output) const {
  for (const std::string& why : unwritten_) run == ExitCode::Pass ? print_error(why) : output.warn(why);
  return run == ExitCode::Pass ? first_ : run;
}

}  // namespace fastsplat::cli
