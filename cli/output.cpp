// SPDX-License-Identifier: Apache-2.0
#include "cli/output.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/json_text.hpp"
#include "base/machine_error.hpp"
#include "base/printable.hpp"
#include "cli/command_text.hpp"

namespace fastsplat::cli {
namespace {

// Returns false, with errno set, if the descriptor does not take all of it.
bool write_all(int descriptor, std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

bool set(const char* variable) {
  const char* value = std::getenv(variable);
  return value != nullptr && *value != '\0';
}

void talk(const std::string& label, const char* colour, const std::string& words) {
  const std::string text = printable_lines(words);
  // Errors on stderr cannot be reported anywhere.
  if (stderr_has_colour()) {
    write_all(STDERR_FILENO, fmt::format("\033[{}m{}\033[0m {}\n", colour, label, text));
  } else {
    write_all(STDERR_FILENO, label + " " + text + "\n");
  }
}

}  // namespace

bool write_stdout(std::string_view text) {
  static bool reader_gone = false;
  if (reader_gone) return false;
  if (write_all(STDOUT_FILENO, text)) return true;
  if (errno == EPIPE) {
    reader_gone = true;
    return false;
  }
  throw_machine({.where = "standard output",
                 .what = std::string("cannot write: ") + std::strerror(errno),
                 .expected = {},
                 .got = {},
                 .fix = "redirect it to a writable place"});
}

bool stderr_is_terminal() {
  const char* kind = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) == 1 && kind != nullptr && std::strcmp(kind, "dumb") != 0;
}

bool stderr_has_colour() { return stderr_is_terminal() && !set("NO_COLOR"); }

void print_error(std::string_view message) noexcept {
  try {
    std::string line = printable(message);
    while (!line.empty() && line.back() == ' ') line.pop_back();
    talk("fastsplat: error:", "1;31", line);
  } catch (...) {
    write_all(STDERR_FILENO, "fastsplat: error: not enough memory for the message\n");
  }
}

std::string grouped(unsigned long long number) {
  std::string digits = std::to_string(number);
  for (int at = static_cast<int>(digits.size()) - 3; at > 0; at -= 3) digits.insert(static_cast<std::size_t>(at), ",");
  return digits;
}

double ratio(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(whole);
}

std::string counted(unsigned long long number, const std::string& what) {
  return grouped(number) + " " + what + (number == 1 ? "" : "s");
}

void Output::line(const std::string& text) const {
  if (!common_.quiet && common_.json != "-") write_stdout(printable_lines(text.ends_with('\n') ? text : text + "\n"));
}

void Output::json(const nlohmann::ordered_json& json) const {
  if (common_.json.empty()) return;
  auto whole = json;
  if (whole.contains("verb") && !this_command().empty()) whole["command"] = this_command();
  const std::string text = json_text(whole, 2);
  if (common_.json == "-") {
    write_stdout(text + "\n");
  } else {
    write_text_file(common_.json, text + "\n");
  }
}

void Output::warn(const std::string& text) const {
  if (!common_.quiet) talk("fastsplat: warning:", "1;33", text);
}

void Output::note(const std::string& text) const {
  if (!common_.quiet) talk("fastsplat:", "2", text);
}

void Output::remark(const std::vector<Remark>& remarks) const {
  for (const auto& [kind, text] : remarks) kind == Remark::Warning ? warn(text) : note(text);
}

void Output::note_time(const std::string& what) const { note(fmt::format("{} in {:.1f} s", what, seconds())); }

double Output::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace fastsplat::cli
