// docs/performance.md from the JSON of bench_frame (./run performance): medians of CPU time, their spread, and the
// ratios that the goals are about. Prints the page; reads the JSON's name from its only argument.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <vector>

namespace {

using Json = nlohmann::json;

struct Line {
  std::vector<double> cpu, wall;  ///< ms, one a repetition
  double splats = 0, hidden = 0, redone = 0;
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

/// At least `goal` times as fast.
struct Goal {
  const char* what;
  const char* slow;
  const char* fast;
  double goal;
};
constexpr Goal kGoals[] = {
    {"head 512², `base`: plain / fast unit", "plain/head512/base", "fast/head512/base", 10},
    {"head 512², `compact`: plain / fast unit", "plain/head512/compact", "fast/head512/compact", 15},
    {"head 512², `tiny`: plain / fast unit", "plain/head512/tiny", "fast/head512/tiny", 8},
    {"head 512², golden: plain / fast", "plain/head512/golden", "fast/head512/golden", 2},
    {"head 128², golden's rays: plain / fast", "plain/rays128/golden", "fast/rays128/golden", 1.5},
    {"rows of 5 px, `compact`", "plain/rows5/compact", "fast/rows5/compact", 12},
    {"rows of 7 px, `compact`", "plain/rows7/compact", "fast/rows7/compact", 15},
    {"rows of 9 px, `compact`", "plain/rows9/compact", "fast/rows9/compact", 13},
    {"rows of 16 px, `compact`", "plain/rows16/compact", "fast/rows16/compact", 18},
    {"rows of 5 px, `base`", "plain/rows5/base", "fast/rows5/base", 6},
    {"rows of 7 px, `base`", "plain/rows7/base", "fast/rows7/base", 8},
    {"rows of 9 px, `base`", "plain/rows9/base", "fast/rows9/base", 7},
    {"rows of 16 px, `base`", "plain/rows16/base", "fast/rows16/base", 9},
};

/// One thread against two, by the clock on the wall.
void print_threads(const std::map<std::string, Line>& lines, const char* what, const std::string& line) {
  const auto one = lines.find("wall1/" + line + "/process_time"),
             two = lines.find("wall2/" + line + "/process_time/real_time");
  if (one == lines.end() || two == lines.end()) return;
  const double ratio = median(one->second.wall) / median(two->second.wall);
  std::cout << fmt::format("| {}: 1 / 2 threads, wall | {:.2f} | {:.2f}, {:.2f} | 1.8 | {} |\n", what, ratio,
                           *std::ranges::min_element(one->second.wall) / *std::ranges::max_element(two->second.wall),
                           *std::ranges::max_element(one->second.wall) / *std::ranges::min_element(two->second.wall),
                           ratio >= 1.8 ? "met" : fmt::format("missed by {:.0f} %", 100 * (1 - ratio / 1.8)));
}

void print_goals(const std::map<std::string, Line>& lines) {
  std::cout << "| ratio of medians, CPU time | measured | least, greatest of its repetitions | goal | "
               "|\n|---|---|---|---|---|\n";
  for (const Goal& goal : kGoals) {
    const auto slow = lines.find(goal.slow), fast = lines.find(goal.fast);
    if (slow == lines.end() || fast == lines.end()) continue;
    const double ratio = median(slow->second.cpu) / median(fast->second.cpu);
    const double least = *std::ranges::min_element(slow->second.cpu) / *std::ranges::max_element(fast->second.cpu);
    const double most = *std::ranges::max_element(slow->second.cpu) / *std::ranges::min_element(fast->second.cpu);
    std::cout << fmt::format(
        "| {} | {:.1f} | {:.1f}, {:.1f} | {} | {} |\n", goal.what, ratio, least, most, goal.goal,
        ratio >= goal.goal ? "met" : fmt::format("missed by {:.0f} %", 100 * (1 - ratio / goal.goal)));
  }
  print_threads(lines, "head 512², `base`, fast", "head512/base");
  print_threads(lines, "head 512², golden, fast", "head512/golden");
}

void print_lines(const std::map<std::string, Line>& lines) {
  std::cout << "\n| line | CPU ms, median | least | greatest | of splats, hidden | tiles redone "
               "|\n|---|---|---|---|---|---|\n";
  for (const auto& [name, line] : lines) {
    std::cout << fmt::format("| {} | {:.3g} | {:.3g} | {:.3g} | {} | {} |\n", name, median(line.cpu),
                             *std::ranges::min_element(line.cpu), *std::ranges::max_element(line.cpu),
                             line.splats > 0 ? fmt::format("{:.1f} %", 100 * line.hidden / line.splats) : "",
                             line.splats > 0 ? fmt::format("{:.0f}", line.redone) : "");
  }
}

}  // namespace

int main(int count, char** arguments) try {
  if (count != 2) throw std::runtime_error("expected the JSON of bench_frame");
  // Google Benchmark writes the spread of a counter that is 0 as NaN, which is no JSON.
  std::ostringstream text;
  text << std::ifstream(arguments[1]).rdbuf();
  const Json json = Json::parse(std::regex_replace(text.str(), std::regex(": -?(NaN|nan|inf)"), ": null"));
  std::map<std::string, Line> lines;
  for (const Json& run : json.at("benchmarks")) {
    if (run.at("run_type") != "iteration" || run.contains("error_occurred")) continue;
    // "plain/head512/base/iterations:1/process_time" -> without what every line of its kind has
    std::string name = run.at("run_name");
    if (const auto at = name.find("/iterations:1"); at != std::string::npos) name.erase(at, 13);
    if (!name.starts_with("wall")) {
      if (const auto at = name.find("/process_time"); at != std::string::npos) name.erase(at, 13);
    }
    Line& line = lines[name];
    line.cpu.push_back(run.at("cpu_time"));
    line.wall.push_back(run.at("real_time"));
    line.splats = run.value("splats", 0.0);
    line.hidden = run.value("hidden", 0.0);
    line.redone = run.value("redone", 0.0);
  }
  if (lines.empty()) throw std::runtime_error("the JSON holds no run");
  const Json& context = json.at("context");
  std::cout << "<!-- Made by ./run performance; the words are in bench/table/preface.md. -->\n"
            << std::ifstream(FASTSPLAT_SOURCE_DIR "/bench/table/preface.md").rdbuf() << "\n## Measured\n\n"
            << fmt::format("{} cores at {} MHz, load {}, {}; {}; {} repetitions, interleaved at random.\n\n",
                           context.at("num_cpus").get<int>(), context.at("mhz_per_cpu").get<int>(),
                           context.contains("load_avg") && !context.at("load_avg").empty()
                               ? context.at("load_avg")[0].dump()
                               : "unknown",
                           context.at("date").get<std::string>().substr(0, 10), FASTSPLAT_COMPILER,
                           lines.begin()->second.cpu.size());
  print_goals(lines);
  print_lines(lines);
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "performance table: " << problem.what() << "\n";
  return 1;
}
