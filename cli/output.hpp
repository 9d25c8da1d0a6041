// Where words go: results to stdout, talk to stderr, JSON where --json says.
#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "cli/common.hpp"

namespace fastsplat::cli {

/// Writes all of `text` to stdout. False when the reader has gone (`| head`): stop producing, it is no error.
/// Any other failure (disk full, closed stdout) is a UserError (Input).
bool write_stdout(std::string_view text);

/// stderr is a terminal that understands control sequences.
bool stderr_is_terminal();
/// ... and the user did not switch colour off (NO_COLOR).
bool stderr_has_colour();

/// "fastsplat: error: ..." as exactly one line on stderr.
void print_error(std::string_view message) noexcept;

/// "1234567" as "1,234,567".
std::string grouped(unsigned long long number);
/// "1 tile", "1,234 tiles".
std::string counted(unsigned long long number, const std::string& what);

/// part / whole; 0 of nothing.
double ratio(std::uint64_t part, std::uint64_t whole);

/// What a result has to say on stderr.
struct Remark {
  enum Kind { Note, Warning } kind = Note;
  std::string text;
};

/// One verb's output, obeying --json and --quiet. A verb's result is a struct; to_text(), to_json() and remarks() of it
/// are what this is given.
class Output {
 public:
  explicit Output(const Common& common) : common_(common) {}

  /// The result, or a part of it, as lines to stdout; not when --quiet, nor when stdout belongs to the JSON.
  void line(const std::string& text) const;
  /// The result as JSON, to --json's file or stdout, with the "command" that makes it again; nothing without --json.
  void json(const nlohmann::ordered_json& json) const;
  /// A warning or a remark on stderr; not when --quiet.
  void warn(const std::string& text) const;
  void note(const std::string& text) const;
  void remark(const std::vector<Remark>& remarks) const;
  /// A note of the seconds since this object was made.
  void note_time(const std::string& what) const;

  double seconds() const;

 private:
  const Common& common_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace fastsplat::cli
