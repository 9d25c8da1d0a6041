// SPDX-License-Identifier: Apache-2.0
#include "cli/replay_line.hpp"

#include "base/shell_word.hpp"
#include "driver/config/changed.hpp"

namespace fastsplat::cli {
std::string replay_line(const std::filesystem::path& stream, const ConfigFlags& config,
                        const testbench::VerifyOptions& options, const std::string& fault) {
  std::string line = "fastsplat verify --stream " + shell_word(stream.string()) + " --config " +
                     shell_word(config.config.value_or("base"));
  for (const auto& change : config.changes) line += " " + driver::as_flag(change);
  line += " --ready " + options.ready + " --input " + options.input + " --fill " + to_string(options.fill) +
          " --seed " + std::to_string(options.seed);
  if (options.reset_after > 0) line += " --reset-after " + std::to_string(options.reset_after);
  if (!fault.empty()) line += " --fault " + fault;
  return line;
}

}  // namespace fastsplat::cli
