// SPDX-License-Identifier: Apache-2.0
#include "cli/other_programs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <csignal>
#include <cstring>
#include <optional>
#include <sstream>

#include "base/programs.hpp"

namespace fastsplat::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct Known {
  const char* name;
  std::vector<const char*> commands;  ///< in order of preference
  const char* ask;                    ///< flag that prints the version
  const char* says;                   ///< text that its answer contains; another program may have the same name
  const char* use;
  const char* package;
};

const std::vector<Known>& known() {
  static const std::vector<Known> all{
      {"ffmpeg", {"ffmpeg"}, "-version", "ffmpeg", "render --video", "ffmpeg"},
      {"verilator", {"verilator"}, "--version", "Verilator", "building RTL: verify, render --engine rtl", "verilator"},
      {"yosys", {"yosys"}, "-V", "Yosys", "netlists and proofs of the RTL, in ./run test", "yosys"},
      {"z3", {"z3"}, "--version", "Z3", "proofs of the RTL, in ./run test", "z3"},
      {"iverilog", {"iverilog"}, "-V", "Icarus", "the RTL in a second simulator, in ./run test", "iverilog"},
      {"node",
       {"node", "nodejs"},
       "--version",
       "v",
       "./run lab, rebuilding the report's page, browser tests",
       "nodejs"},
      {"emcc", {"emcc"}, "--version", "mscripten", "./run lab", "emscripten"},
      {"chromium",
       {"chromium", "chromium-browser", "google-chrome"},
       "--version",
       "Chrom",
       "the report's browser tests",
       "chromium"},
      {"slurm", {"sbatch"}, "--version", "slurm", "plan submit --engine slurm", "slurm-wlm"},
      {"parallel",
       {"parallel"},
       "--version",
       "GNU parallel",
       "command lists of plan submit --engine script",
       "parallel"},
      {"ccache", {"ccache", "sccache"}, "--version", "cache", "rebuilding in a fraction of the time", "ccache"},
  };
  return all;
}

/// A program started for its version.
struct Asked {
  pid_t child = -1;
  int answer = -1;  ///< reads its stdout and stderr; -1: at its end
  std::string text;
  bool in_time = false;
};

[[noreturn]] void become(const std::string& path, const char* flag, int answer) {
  ::setpgid(0, 0);  // its children are killed with it
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(answer, STDOUT_FILENO);
  ::dup2(answer, STDERR_FILENO);
  const std::array<char*, 3> words{const_cast<char*>(path.c_str()), const_cast<char*>(flag), nullptr};
  ::execv(path.c_str(), words.data());
  ::_exit(127);
}

Asked ask(const std::string& path, const char* flag) {
  Asked asked;
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return asked;
  asked.child = ::fork();
  if (asked.child == 0) become(path, flag, ends[1]);
  ::close(ends[1]);
  asked.answer = ends[0];
  return asked;
}

void read_some(Asked& asked) {
  std::array<char, 4096> buffer{};
  const ssize_t got = ::read(asked.answer, buffer.data(), buffer.size());
  if (got < 0 && errno == EINTR) return;
  constexpr std::size_t kMost = 1 << 16;
  if (got > 0 && asked.text.size() < kMost) {
    asked.text.append(buffer.data(), static_cast<std::size_t>(got));
  } else if (got <= 0) {
    asked.in_time = true;
    ::close(asked.answer);
    asked.answer = -1;
  }
}

/// Waits for all answers until `deadline` at most, then kills what still runs.
void wait_for(std::vector<Asked>& all, Clock::time_point deadline) {
  while (true) {
    std::vector<pollfd> ends;
    std::vector<Asked*> whose;
    for (Asked& asked : all) {
      if (asked.answer < 0) continue;
      ends.push_back({asked.answer, POLLIN, 0});
      whose.push_back(&asked);
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (ends.empty() || left <= 0) break;
    if (::poll(ends.data(), ends.size(), static_cast<int>(left)) <= 0) continue;
    for (std::size_t at = 0; at < ends.size(); ++at) {
      if (ends[at].revents != 0) read_some(*whose[at]);
    }
  }
  for (Asked& asked : all) {
    if (asked.answer >= 0) ::close(asked.answer);
    if (asked.child <= 0) continue;
    // A program that closed its output and keeps running also counts as late.
    int status = 0;
    while (::waitpid(asked.child, &status, WNOHANG) == 0) {
      if (Clock::now() >= deadline) {
        ::kill(-asked.child, SIGKILL);
        ::kill(asked.child, SIGKILL);
        ::waitpid(asked.child, &status, 0);
        asked.in_time = false;
        break;
      }
      ::usleep(1000);
    }
  }
}

/// "5.006" for "Verilator 5.006 2023-01-22": the first word that is a number, with or without a leading v.
std::string version_in(const std::string& text) {
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word.starts_with('v')) word.erase(0, 1);
    if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0])) == 0) continue;
    word.resize(std::min(word.size(), word.find_first_not_of("0123456789.")));
    while (word.ends_with('.')) word.pop_back();
    return word;
  }
  return {};
}

/// Last line of a program's output, printable, at most 120 characters.
std::string last_line(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) text.pop_back();
  text.erase(0, text.rfind('\n') == text.npos ? 0 : text.rfind('\n') + 1);
  for (char& c : text) c = std::isprint(static_cast<unsigned char>(c)) != 0 ? c : '?';
  return text.empty() ? "no output" : text.substr(0, 120);
}

}  // namespace

std::vector<OtherProgram> look_for_programs(std::chrono::milliseconds limit) {
  std::vector<OtherProgram> programs;
  std::vector<Asked> asked;
  const auto deadline = Clock::now() + limit;
  for (const Known& one : known()) {
    OtherProgram program{
        .name = one.name, .use = one.use, .get = fmt::format("apt-get install {}", one.package), .path = {}};
    for (const char* command : one.commands) {
      if (program.path.empty()) program.path = path_of(command);
    }
    asked.push_back(program.path.empty() ? Asked{} : ask(program.path, one.ask));
    programs.push_back(std::move(program));
  }
  wait_for(asked, deadline);
  for (std::size_t at = 0; at < programs.size(); ++at) {
    OtherProgram& program = programs[at];
    if (program.path.empty()) continue;
    const bool itself = asked[at].text.find(known()[at].says) != std::string::npos;
    if (itself) program.version = version_in(asked[at].text.substr(asked[at].text.find(known()[at].says)));
    if (!asked[at].in_time) {
      program.version.clear();
      program.problem =
          fmt::format("does not answer {} within {} s", known()[at].ask, static_cast<double>(limit.count()) / 1000.0);
    } else if (!itself || program.version.empty()) {
      program.problem = fmt::format("does not print its version: {}", last_line(asked[at].text));
    }
  }
  return programs;
}

}  // namespace fastsplat::cli
