// SPDX-License-Identifier: Apache-2.0
#include "tests/mutants/serve_mutants.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iostream>
#include <stdexcept>

namespace {

/// Of every device made from now on; 0: none.
int selected_mutant = 0;

}  // namespace

/// What fastsplat_mutant_pkg asks for.
extern "C" int fastsplat_mutant() { return selected_mutant; }

namespace fastsplat::test {
namespace {

/// Processor seconds of a mutant, beside so many times what the healthy device takes.
constexpr double kSeconds = 2.0, kTimes = 5.0;
/// Seconds of wall time for one of processor time, plus a minute: a process that uses no more processor time hangs.
constexpr double kPatience = 20.0;

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.substr(0, 200);
}

double processor_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

std::string verdict_of(const std::vector<Named>& checks, int to_where) {
  std::uint64_t comparisons = 0;
  for (const Named& named : checks) {
    // Known to the parent should this be the last thing heard of.
    if (write(to_where, (named.name + "\n").c_str(), named.name.size() + 1) < 0) _exit(1);
    Said said;
    try {
      said = named.check();
    } catch (const std::exception& error) {
      said.text = error.what();
    }
    comparisons += said.comparisons;
    if (!said.text.empty()) return "killed " + named.name + ": " + one_line(said.text);
  }
  if (comparisons == 0) return "killed nothing: nothing was compared";
  char text[64];
  std::snprintf(text, sizeof text, "lives %llu %.2f", static_cast<unsigned long long>(comparisons),
                processor_seconds());
  return text;
}

/// The last line the child wrote, and how it ended if that is not a verdict.
std::string judge(int number, const std::vector<Named>& checks, double limit) {
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process");
  if (child == 0) {
    close(ends[0]);
    const auto seconds = static_cast<rlim_t>(limit) + 1;
    const rlimit time{seconds, seconds}, core{0, 0}, memory{rlim_t{4} << 30, rlim_t{4} << 30};
    setrlimit(RLIMIT_CPU, &time);
    alarm(60 + static_cast<unsigned>(kPatience * limit));
    setrlimit(RLIMIT_CORE, &core);
    setrlimit(RLIMIT_AS, &memory);
    selected_mutant = number;
    const std::string verdict = verdict_of(checks, ends[1]) + "\n";
    const auto written = write(ends[1], verdict.c_str(), verdict.size());
    _exit(written < 0 ? 1 : 0);
  }
  close(ends[1]);
  std::string heard;
  char buffer[4096];
  for (ssize_t n = 0; (n = read(ends[0], buffer, sizeof buffer)) > 0;)
    heard.append(buffer, static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!heard.empty() && heard.back() == '\n') heard.pop_back();
  const std::string last = heard.substr(heard.rfind('\n') == std::string::npos ? 0 : heard.rfind('\n') + 1);
  if (last.starts_with("killed ") || last.starts_with("lives ")) return last;
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  return "killed " + last + ": " +
         (signal == SIGXCPU || signal == SIGKILL ? "no end within " + std::to_string(limit) + " s of processor time"
          : signal == SIGALRM                    ? "it waits, and takes no processor time"
                                                 : "the simulation dies of signal " + std::to_string(signal));
}

int serve(const std::vector<Named>& checks) {
  const std::string healthy = judge(0, checks, 600);
  std::cout << "0 " << healthy << std::endl;
  if (!healthy.starts_with("lives ")) return 1;
  const double limit = kSeconds + kTimes * std::stod(healthy.substr(healthy.rfind(' ')));
  for (int number = 0; std::cin >> number;) std::cout << number << " " << judge(number, checks, limit) << std::endl;
  return 0;
}

}  // namespace

int mutants_main(int argc, char** argv, const std::function<std::vector<Named>(const char*)>& checks_of) {
  if (argc != 2) {
    std::cerr << "usage: check_mutants_NAME CONFIG.toml <numbers\n";
    return 2;
  }
  try {
    return serve(checks_of(argv[1]));
  } catch (const std::exception& error) {
    std::cerr << "check_mutants: error: " << error.what() << "\n";
    return 3;
  }
}

}  // namespace fastsplat::test
