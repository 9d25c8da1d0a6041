// SPDX-License-Identifier: Apache-2.0
#include "tests/slurm/process_tree_helper.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "base/number_text.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::slurm_test {
namespace {

namespace fs = std::filesystem;

std::string with(std::string text, char from, char to) {
  std::replace(text.begin(), text.end(), from, to);
  return text;
}

/// "pid (name) state parent ...": the part after the name, which may hold any characters.
std::string after_name(const std::string& stat) {
  const auto at = stat.rfind(')');
  return at == std::string::npos || at + 4 > stat.size() ? std::string() : stat.substr(at + 2);
}

}  // namespace

std::vector<Process> processes_of(const fs::path& folder) {
  std::vector<Process> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const auto id = integer_from<pid_t>(entry.path().filename().string());
    if (!id || *id == ::getpid()) continue;
    const std::string stat = after_name(cli_test::read_bytes(entry.path() / "stat"));
    if (stat.empty() || stat[0] == 'Z' || stat[0] == 'X') continue;
    Process process{.id = *id,
                    .parent = static_cast<pid_t>(std::atoi(stat.c_str() + 2)),
                    .command = with(cli_test::read_bytes(entry.path() / "cmdline"), '\0', ' '),
                    .environment = with(cli_test::read_bytes(entry.path() / "environ"), '\0', '\n')};
    const std::string works_in = fs::read_symlink(entry.path() / "cwd", ignored).string();
    for (const std::string& text : {process.command, process.environment, works_in}) {
      if (text.find(folder.string()) == std::string::npos) continue;
      found.push_back(std::move(process));
      break;
    }
  }
  return found;
}

pid_t start_daemon(const std::vector<std::string>& words, const std::vector<std::string>& environment,
                   const fs::path& log) {
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork");
  if (child > 0) return child;
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  for (const auto& setting : environment) ::putenv(::strdup(setting.c_str()));
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) ::signal(signal, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDONLY);
  const int out = ::open(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  ::closefrom(STDERR_FILENO + 1);
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

void end_child(pid_t child) {
  ::kill(child, SIGTERM);
  if (wait_until([child] { return ::waitpid(child, nullptr, WNOHANG) != 0; }, 10)) return;
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

bool wait_until(const std::function<bool()>& condition, double seconds) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return true;
}

}  // namespace fastsplat::slurm_test
