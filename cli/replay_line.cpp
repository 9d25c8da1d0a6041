// SPDX-License-Identifier: Apache-2.0
#include "cli/replay_line.hpp"

#include "base/shell_word.hpp"
#include "driver/config/changed.hpp"

namespace fastsplat::cli {
namespace {

std::string of_stream(const std::filesystem::path& stream, const ConfigFlags& config) {
  std::string words =
      " --stream " + shell_word(stream.string()) + " --config " + shell_word(config.config.value_or("base"));
  for (const auto& change : config.changes) words += " " + driver::as_flag(change);
  return words;
}

}  // namespace

std::string pixel_line(const std::filesystem::path& stream, const ConfigFlags& config,
                       const testbench::TilePixel& pixel) {
  return "fastsplat pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y) + " --tile " +
         std::to_string(pixel.tile) + of_stream(stream, config);
}

std::string replay_line(const std::filesystem::path& stream, const ConfigFlags& config,
                        const testbench::VerifyOptions& options, const std::string& fault) {
  std::string line = "fastsplat verify" + of_stream(stream, config);
  line += " --ready " + options.ready + " --input " + options.input + " --fill " + to_string(options.fill) +
          " --seed " + std::to_string(options.seed);
  if (options.reset_after > 0) line += " --reset-after " + std::to_string(options.reset_after);
  if (!fault.empty()) line += " --fault " + fault;
  return line;
}

}  // namespace fastsplat::cli
