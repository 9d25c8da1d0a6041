// check_mutants CONFIG.toml: reads numbers of mutants from standard input, one a line, and answers each with a line
//   NUMBER killed CHECK: WHAT IT SAID   or   NUMBER lives COMPARISONS SECONDS
// The checks come cheapest first; the first that speaks ends it. Each mutant has a process and a limit of processor
// time of its own. Number 0 is the device as it is: it has to live, and its time makes the limit.
#include "tests/mutants/check_mutants.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <iostream>
#include <utility>

#include "base/error.hpp"
#include "driver/config_file.hpp"
#include "testbench/device/rtl_registry.hpp"
#include "testbench/stimulus/campaign.hpp"
#include "testbench/stimulus/directed.hpp"
#include "tests/mustfail/campaign_helper.hpp"

/// What fastsplat_mutant_pkg asks for.
extern "C" int fastsplat_mutant() { return fastsplat::test::selected_mutant; }

namespace fastsplat::testbench {

/// No source of rtl/ is in this program.
std::span<const RtlEntry> rtl_registry() { return {}; }

}  // namespace fastsplat::testbench

namespace fastsplat::test {
namespace {

using testbench::StimulusClass;

/// Longer than any wait of a healthy device in these streams.
constexpr std::uint64_t kTimeout = 40000;
/// Processor seconds of a mutant, beside so many times what the healthy device takes.
constexpr double kSeconds = 2.0, kTimes = 5.0;

/// What a check said; empty: nothing is wrong.
struct Said {
  std::string text;
  std::uint64_t comparisons = 0;
};
struct Named {
  std::string name;
  std::function<Said()> check;
};

testbench::MakeDevice mutant_of(const cmodel::Config& config) {
  return [config](cmodel::PixelSink& pixels, testbench::RtlOptions options) {
    options.timeout = kTimeout;
    return make_mutant(config, pixels, options);
  };
}

std::string one_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.substr(0, 200);
}

/// Streams of some classes; made once, for they are the same for each mutant.
Named streams(const std::string& name, const cmodel::Config& config, std::vector<StimulusClass> classes,
              std::uint64_t splats, std::uint64_t seeds) {
  testbench::CampaignOptions options;
  options.verify.config = config;
  options.verify.ready = options.verify.input = "all";
  options.verify.timeout = kTimeout;
  options.verify.stop_after = 1;
  options.verify.device = mutant_of(config);
  options.splats = splats * classes.size();
  options.seeds = seeds;
  options.classes = std::move(classes);
  std::vector<testbench::CampaignRun> runs;
  for (std::size_t i = 0; i < run_count(options); ++i) runs.push_back(make_run(options, i));
  return {name, [runs = std::move(runs)] {
            Said said;
            for (const auto& run : runs) {
              const auto result = verify(testbench::source_of(run.beats), run.options);
              said.comparisons += result.check.comparisons;
              if (result.verdict == testbench::Verdict::Pass) continue;
              said.text = !result.error.empty()   ? result.error
                          : result.check.detector ? to_string(*result.check.detector)
                                                  : to_string(result.verdict);
              break;
            }
            return said;
          }};
}

template <class Check>
Named directed(const std::string& name, const cmodel::Config& config, Check check) {
  return {name, [=] {
            const auto result = check(config, mutant_of(config));
            return Said{result.failures.empty() ? "" : result.failures.front(), result.comparisons};
          }};
}

/// The stimuli of tests/mustfail, made to show what other streams may not.
Named must_fail(const cmodel::Config& config) {
  return {"mustfail", [=] {
            Said said;
            for (const Stimulus stimulus : kStimuli) {
              const Outcome outcome = run(config, stimulus, [](const auto& c, auto& pixels, const auto& options) {
                return make_mutant(c, pixels, options);
              });
              said.comparisons += outcome.comparisons;
              if (!outcome.caught) continue;
              said.text = std::string(to_string(stimulus)) + ": " + to_string(outcome.caught->by);
              break;
            }
            return said;
          }};
}

std::vector<Named> checks_of(const cmodel::Config& config) {
  std::vector<Named> checks{streams("random", config, {StimulusClass::Mixed}, 40, 3),
                            streams("hazards", config, {StimulusClass::Hazards, StimulusClass::SwapHazards}, 60, 2),
                            directed("registers", config, testbench::check_registers),
                            directed("refusals", config, testbench::check_refusals),
                            streams("resets", config, {StimulusClass::Reset}, 60, 4),
                            must_fail(config),
                            directed("short resets", config, testbench::check_short_resets),
                            streams("all classes", config, testbench::stimulus_classes(), 60, 3)};
  // Sheets that freeze pixels while the table of the one before is built are rare.
  if (config.culls()) checks.push_back(streams("culling", config, testbench::stimulus_classes(), 400, 4));
  // A pixel of densities is rounded some forty times, and what a last bit decides is rare: many tables, many pixels.
  if (config.classifies()) checks.push_back(streams("densities", config, {StimulusClass::Mixed}, 10000, 12));
  return checks;
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
                                                 : "the simulation dies of signal " + std::to_string(signal));
}

int serve(const char* path) {
  const auto checks = checks_of(driver::load_config(path));
  const std::string healthy = judge(0, checks, 600);
  std::cout << "0 " << healthy << std::endl;
  if (!healthy.starts_with("lives ")) return 1;
  const double limit = kSeconds + kTimes * std::stod(healthy.substr(healthy.rfind(' ')));
  for (int number = 0; std::cin >> number;) std::cout << number << " " << judge(number, checks, limit) << std::endl;
  return 0;
}

}  // namespace
}  // namespace fastsplat::test

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: check_mutants_NAME CONFIG.toml <numbers\n";
    return 2;
  }
  try {
    return fastsplat::test::serve(argv[1]);
  } catch (const std::exception& error) {
    std::cerr << "check_mutants: error: " << error.what() << "\n";
    return 3;
  }
}
