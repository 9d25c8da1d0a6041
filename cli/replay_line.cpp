#include "cli/replay_line.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace fastsplat::cli {
namespace {

/// As a shell reads it back.
std::string quoted(const std::string& word) {
  const auto plain = [](unsigned char c) { return std::isalnum(c) || std::strchr("/._-+,=:@%", c) != nullptr; };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

std::string replay_line(const std::filesystem::path& stream, const ConfigFlags& config,
                        const testbench::VerifyOptions& options) {
  std::string line =
      "fastsplat verify --stream " + quoted(stream.string()) + " --config " + quoted(config.config.value_or("base"));
  for (const auto& change : config.changes) line += " --set " + quoted(change);
  line += " --ready " + options.ready + " --input " + options.input + " --fill " + to_string(options.fill) +
          " --seed " + std::to_string(options.seed);
  if (options.reset_after > 0) line += " --reset-after " + std::to_string(options.reset_after);
  return line;
}

}  // namespace fastsplat::cli
