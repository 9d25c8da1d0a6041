// SPDX-License-Identifier: Apache-2.0
#include "tools/pages/benchmarks/results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace fastsplat::bench {
namespace {

using Json = nlohmann::json;

/// Shortens "plain/head512/base/iterations:1/process_time" by what all lines of its kind share. Names that differ only
/// in the clock keep it.
std::string short_name(std::string name) {
  for (const std::string part : {"/iterations:1", "/repeats:1", "/manual_time"}) {
    if (const auto at = name.find(part); at != std::string::npos) name.erase(at, part.size());
  }
  if (name.starts_with("wall")) return name;
  if (const auto at = name.find("/process_time"); at != std::string::npos) name.erase(at);
  return name;
}

/// Google Benchmark's own keys; the rest are counters.
bool own_key(const std::string& key) {
  static const std::regex own(
      "family_index|per_family_instance_index|repetition.*|threads|iterations|real_time|cpu_time");
  return std::regex_match(key, own);
}

std::string machine_of(const Json& context) {
  const auto& load = context.value("load_avg", Json::array());
  return fmt::format("{} cores at {} MHz, load {:.1f}", context.at("num_cpus").get<int>(),
                     context.at("mhz_per_cpu").get<int>(), load.empty() ? 0.0 : load[0].get<double>());
}

void add_runs(const Json& json, Results& results) {
  for (const Json& run : json.at("benchmarks")) {
    if (run.at("run_type") != "iteration" || run.contains("error_occurred")) continue;
    Line& line = results.lines[short_name(run.at("run_name"))];
    line.cpu.push_back(run.at("cpu_time"));
    line.wall.push_back(run.at("real_time"));
    line.label = run.value("label", "");
    for (const auto& [key, value] : run.items()) {
      if (value.is_number() && !own_key(key)) line.each[key].push_back(line.counters[key] = value);
    }
  }
}

double fitted(const std::vector<std::pair<double, double>>& points) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [at, value] : points) {
    const double u = std::log(at), v = std::log(value);
    x += u, y += v, xx += u * u, xy += u * v;
  }
  const auto n = static_cast<double>(points.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

double least(const std::vector<double>& values) { return *std::ranges::min_element(values); }
double greatest(const std::vector<double>& values) { return *std::ranges::max_element(values); }

}  // namespace

const Line* Results::line(const std::string& name) const {
  const auto found = lines.find(name);
  return found == lines.end() ? nullptr : &found->second;
}

std::size_t Results::repetitions() const {
  std::size_t most = 0;
  for (const auto& [name, line] : lines) most = std::max(most, line.cpu.size());
  return most;
}

Results read_results(std::span<const std::string> files) {
  Results results;
  for (const std::string& file : files) {
    // Google Benchmark writes NaN for the spread of a counter that is 0, which is invalid JSON.
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    const Json json =
        Json::parse(std::regex_replace(text.str(), std::regex(": -?(NaN|nan|inf)"), ": null"), nullptr, false);
    if (json.is_discarded()) continue;
    add_runs(json, results);
    if (!results.machine.empty()) continue;
    results.machine = machine_of(json.at("context"));
    results.date = json.at("context").at("date").get<std::string>().substr(0, 10);
  }
  if (results.lines.empty()) throw std::runtime_error("the JSON contains no runs");
  return results;
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

Figure only(double value) { return {value, value, value}; }

Figure ratio(const std::vector<double>& above, const std::vector<double>& below) {
  return {median(above) / median(below), least(above) / greatest(below), greatest(above) / least(below)};
}

Figure exponent(const std::vector<std::pair<double, std::vector<double>>>& points) {
  std::vector<std::pair<double, double>> medians;
  std::size_t repetitions = points.front().second.size();
  for (const auto& [at, values] : points) {
    medians.emplace_back(at, median(values));
    repetitions = std::min(repetitions, values.size());
  }
  std::vector<double> single;
  for (std::size_t i = 0; i < repetitions; ++i) {
    std::vector<std::pair<double, double>> those;
    for (const auto& [at, values] : points) those.emplace_back(at, values[i]);
    single.push_back(fitted(those));
  }
  return {fitted(medians), least(single), greatest(single)};
}

void print_heading(const std::string& what) {
  std::cout << "| " << what << " | measured | least, greatest of its repetitions | goal | |\n|---|---|---|---|---|\n";
}

void print_goal(const std::string& what, const Figure& figure, Goal kind, double goal, const std::string& unit) {
  const double scale = unit == "%" ? 100.0 : 1.0;
  const auto number = [&](double value) {
    const double shown = value * scale;
    return shown >= 100.0 ? fmt::format("{:.0f}", shown) : fmt::format("{:.{}f}", shown, shown < 2.0 ? 2 : 1);
  };
  const std::string after = unit.empty() ? "" : " " + unit;
  const double by = kind == Goal::AtLeast ? 1.0 - figure.value / goal : figure.value / goal - 1.0;
  std::cout << fmt::format("| {} | {}{} | {}, {} | {} {:g}{} | {} |\n", what, number(figure.value), after,
                           number(figure.least), number(figure.greatest), kind == Goal::AtLeast ? "≥" : "≤",
                           goal * scale, after, by <= 0.0 ? "met" : fmt::format("missed by {:.0f} %", 100 * by));
}

}  // namespace fastsplat::bench
