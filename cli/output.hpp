// SPDX-License-Identifier: Apache-2.0
// Output channels: results to stdout, messages to stderr, JSON to the target of --json.
#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cli/common.hpp"

namespace fastsplat::cli {

/// Writes all of `text` to stdout. Returns false if the reader has gone (`| head`): stop producing output, this is not
/// an error. Any other failure (disk full, closed stdout) is a UserError (Input).
bool write_stdout(std::string_view text);

/// Whether stderr is a terminal that supports control sequences.
bool stderr_is_terminal();
/// The same, unless the user disabled colour (NO_COLOR).
bool stderr_has_colour();

/// "fastsplat: error: ..." as exactly one line on stderr.
void print_error(std::string_view message) noexcept;

/// "1234567" as "1,234,567".
std::string grouped(unsigned long long number);
/// "1 tile", "1,234 tiles".
std::string counted(unsigned long long number, const std::string& what);

/// part / whole; 0 if whole is 0.
double ratio(std::uint64_t part, std::uint64_t whole);

/// A message about a result, for stderr.
struct Remark {
  enum Kind { Note, Warning } kind = Note;
  std::string text;
};

/// Output of one subcommand, controlled by --json and --quiet. A result is a struct; its to_text(), to_json() and
/// remarks() produce the arguments of these functions.
class Output {
 public:
  explicit Output(const Common& common) : common_(common) {}

  /// Prints the result or a part of it to stdout; not with --quiet or if stdout carries the JSON.
  void line(const std::string& text) const;
  /// Writes the result as JSON to --json's file or stdout, with the "command" that reproduces it; nothing without
  /// --json.
  void json(const nlohmann::ordered_json& json) const;
  /// Prints a warning or note to stderr; not with --quiet.
  void warn(const std::string& text) const;
  void note(const std::string& text) const;
  void remark(const std::vector<Remark>& remarks) const;
  /// Prints a note with the seconds since construction.
  void note_time(const std::string& what) const;

  double seconds() const;

 private:
  const Common& common_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace fastsplat::cli
