// SPDX-License-Identifier: Apache-2.0
// Prints docs/performance.md, made from the benchmarks' JSON files that its arguments name (tools/performance): medians
// of CPU time, their spread, and figures with goals.
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "tools/pages/benchmarks/results.hpp"

namespace {

using namespace fastsplat::bench;

/// `fast` must be at least `goal` times as fast as `slow`.
struct Race {
  const char* what;
  const char* slow;
  const char* fast;
  double goal;
};
constexpr Race kRaces[] = {
    {"head 512², `base`: plain / fast unit", "plain/head512/base", "fast/head512/base", 10},
    {"head 512², `compact`: plain / fast unit", "plain/head512/compact", "fast/head512/compact", 15},
    {"head 512², `tiny`: plain / fast unit", "plain/head512/tiny", "fast/head512/tiny", 8},
    {"head 512², `base`: plain unit / picture without counters", "plain/head512/base", "picture/head512/base", 20},
    {"head 512², `compact`: the same", "plain/head512/compact", "picture/head512/compact", 20},
    {"head 512², `tiny`: the same", "plain/head512/tiny", "picture/head512/tiny", 20},
    {"head 512², golden: plain / fast", "plain/head512/golden", "fast/head512/golden", 2},
    {"head 128², golden's rays: plain / fast", "plain/rays128/golden", "fast/rays128/golden", 1.5},
    {"head 512², perspective, ellipses: plain / fast unit", "plain/perspective512/ellipse",
     "fast/perspective512/ellipse", 5},
    {"the same, every sample", "plain/samples512/ellipse", "fast/samples512/ellipse", 5},
    {"100,000 Gaussians (shells), 1920 x 1080: plain / fast unit", "plain/shells100000/ellipse",
     "fast/shells100000/ellipse", 5},
    {"100,000 Gaussians (cloud), 1920 x 1080: the same", "plain/cloud100000/ellipse", "fast/cloud100000/ellipse", 5},
    {"rows of 5 px, `compact`", "plain/rows5/compact", "fast/rows5/compact", 12},
    {"rows of 7 px, `compact`", "plain/rows7/compact", "fast/rows7/compact", 15},
    {"rows of 9 px, `compact`", "plain/rows9/compact", "fast/rows9/compact", 13},
    {"rows of 16 px, `compact`", "plain/rows16/compact", "fast/rows16/compact", 18},
    {"rows of 5 px, `base`", "plain/rows5/base", "fast/rows5/base", 6},
    {"rows of 7 px, `base`", "plain/rows7/base", "fast/rows7/base", 8},
    {"rows of 9 px, `base`", "plain/rows9/base", "fast/rows9/base", 7},
    {"rows of 16 px, `base`", "plain/rows16/base", "fast/rows16/base", 9},
    {"opaque 256³ (cube), `base`: nothing freezes / freezing", "opaque-cube256/never-frozen", "opaque-cube256/freezing",
     1.8},
    {"opaque 256³ (shells), `base`: the same", "opaque-shells256/never-frozen", "opaque-shells256/freezing", 1.8},
};

/// Wall-clock time of one thread against two.
void print_threads(const Results& results, const char* what, const std::string& line) {
  const Line* one = results.line("wall1/" + line + "/process_time");
  const Line* two = results.line("wall2/" + line + "/process_time/real_time");
  if (one != nullptr && two != nullptr)
    print_goal(std::string(what) + ": 1 / 2 threads, wall", ratio(one->wall, two->wall), Goal::AtLeast, 1.8);
}

void print_races(const Results& results) {
  for (const Race& race : kRaces) {
    const Line* slow = results.line(race.slow);
    const Line* fast = results.line(race.fast);
    if (slow != nullptr && fast != nullptr)
      print_goal(race.what, ratio(slow->cpu, fast->cpu), Goal::AtLeast, race.goal);
  }
  print_threads(results, "head 512², `base`, fast", "head512/base");
  print_threads(results, "the same, without counters", "picture512/base");
  print_threads(results, "head 512², golden, fast", "head512/golden");
}

void print_limits(const Results& results) {
  if (const auto* bound = results.line("bound/slice7/compact"), *kernel = results.line("kernel/slice7/compact");
      bound != nullptr && kernel != nullptr) {
    print_goal("row kernel, 7 px, `compact`: share of the first-level cache's read-modify-write bound",
               ratio(bound->cpu, kernel->cpu), Goal::AtLeast, 0.55, "%");
  }
  if (const auto* on = results.line("clear-shells256/freezing"), *off = results.line("clear-shells256/never-frozen");
      on != nullptr && off != nullptr) {
    Figure cost = ratio(on->cpu, off->cpu);
    print_goal("clear 256³ (shells), `base`: freezing / nothing freezes, where nothing is hidden", cost, Goal::AtMost,
               1.03);
  }
  for (const auto& [name, goal] : {std::pair{"base", 100.0}, {"tiny", 60.0}}) {
    if (const Line* line = results.line(std::string("rtl/") + name); line != nullptr)
      print_goal(fmt::format("cycle model, `{}`: Verilated RTL / cycle model", name),
                 ratio(line->each.at("plain/cycle_model"), {1.0}), Goal::AtLeast, goal);
  }
  for (const char* name : {"tiny", "small", "base"}) {
    if (const Line* line = results.line(std::string("rtl/") + name); line != nullptr)
      print_goal(fmt::format("simulation of `{}`: whole checker and assertions / plain", name),
                 ratio(line->each.at("checked/plain"), {1.0}), Goal::AtMost, 1.5);
  }
  if (const Line* line = results.line("rtl/tiny"); line != nullptr)
    print_goal("simulation of `tiny`, plain: million clock cycles a second", ratio(line->each.at("cycles/s"), {1e6}),
               Goal::AtLeast, 5.0);
}

using Points = std::vector<std::pair<double, std::vector<double>>>;

/// Exponents over all points and over the largest three, because small frames are dominated by fixed costs.
void print_exponents(const std::string& what, Points points, double goal) {
  if (points.size() < 3) return;
  std::ranges::sort(points);
  print_goal(what, exponent(points), Goal::AtMost, goal);
  print_goal("the same, greatest three", exponent({points.end() - 3, points.end()}), Goal::AtMost, goal);
}

/// Frame time of the fast unit against splats and pixels.
void print_growth(const Results& results) {
  Points splats, pixels;
  for (const auto& [name, line] : results.lines) {
    if (name.starts_with("growth/")) splats.emplace_back(line.counters.at("voxels"), line.cpu);
  }
  for (const int size : {128, 256, 512, 1024, 2048}) {
    if (const Line* line = results.line(fmt::format("fast/head{}/base", size)); line != nullptr)
      pixels.emplace_back(static_cast<double>(size) * size, line->cpu);
  }
  print_exponents("shells 32³ to 192³, 512², `base`: exponent of CPU time against splats", splats, 1.05);
  print_exponents("head 128² to 2048², `base`: exponent of CPU time against pixels", pixels, 1.0);
  if (const Line* line = results.line("memory/shells320/base"); line != nullptr)
    print_goal("shells 320³, 1024², `base`: peak memory of the program", only(line->counters.at("peak_mb")),
               Goal::AtMost, 1000, "MB");
}

void print_lines(const Results& results) {
  std::cout << "\n| line | CPU ms, median | least | greatest | of splats, hidden | tiles redone "
               "|\n|---|---|---|---|---|---|\n";
  for (const auto& [name, line] : results.lines) {
    if (name.starts_with("rtl/")) continue;  // its time covers everything compared there
    const auto counter = [&line](const char* key) {
      const auto found = line.counters.find(key);
      return found == line.counters.end() ? 0.0 : found->second;
    };
    const double splats = counter("splats");
    std::cout << fmt::format("| {} | {:.3g} | {:.3g} | {:.3g} | {} | {} |\n", name, median(line.cpu),
                             *std::ranges::min_element(line.cpu), *std::ranges::max_element(line.cpu),
                             splats > 0 ? fmt::format("{:.1f} %", 100 * counter("hidden") / splats) : "",
                             splats > 0 ? fmt::format("{:.0f}", counter("redone")) : "");
  }
}

}  // namespace

int main(int count, char** arguments) try {
  if (count < 2) throw std::runtime_error("expected the JSON of the benchmarks");
  const std::vector<std::string> files(arguments + 1, arguments + count);
  const Results results = read_results(files);
  std::cout << "<!-- Made by tools/performance; the words are in tools/pages/benchmarks/preface.md. -->\n"
            << std::ifstream(FASTSPLAT_SOURCE_DIR "/tools/pages/benchmarks/preface.md").rdbuf() << "\n## Measured\n\n"
            << fmt::format("{}, {}; {}; {} repetitions, interleaved at random.\n\n", results.machine, results.date,
                           FASTSPLAT_COMPILER, results.repetitions());
  print_heading("ratio of medians, CPU time");
  print_races(results);
  print_limits(results);
  print_growth(results);
  print_lines(results);
  return 0;
} catch (const std::exception& problem) {
  std::cerr << "performance table: " << problem.what() << "\n";
  return 1;
}
