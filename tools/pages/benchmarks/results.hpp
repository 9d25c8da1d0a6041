// SPDX-License-Identifier: Apache-2.0
// Reads Google Benchmark's JSON: lines by name, a value per repetition, and figures computed from them.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fastsplat::bench {

struct Line {
  std::vector<double> cpu, wall;                      ///< in the benchmark's unit, one per repetition
  std::map<std::string, double> counters;             ///< of the last repetition
  std::map<std::string, std::vector<double>> each{};  ///< the same, of each repetition
  std::string label;
};

struct Results {
  std::map<std::string, Line> lines;
  std::string machine;  ///< one line, without a name or a date
  std::string date;     ///< year, month, day

  std::size_t repetitions() const;  ///< the most of any line
  /// Null if it was not run.
  const Line* line(const std::string& name) const;
};

/// Merges the lines of all files; `machine` is the first file's. Skips files without runs; throws if all are.
Results read_results(std::span<const std::string> files);

double median(std::vector<double> values);

/// A figure and the spread of its repetitions.
struct Figure {
  double value = 0.0, least = 0.0, greatest = 0.0;
};
Figure only(double value);
/// Ratio of the medians; the spread is from least above / greatest below to greatest above / least below.
Figure ratio(const std::vector<double>& above, const std::vector<double>& below);
/// b of y = a x^b through the points (x, median y), by least squares of logarithms; the spread is that of fits to
/// single repetitions.
Figure exponent(const std::vector<std::pair<double, std::vector<double>>>& points);

enum class Goal { AtLeast, AtMost };

/// Prints the heading of the following rows.
void print_heading(const std::string& what);
/// Prints "| what | figure | spread | goal | met or missed by how much |"; "%" figures are given as shares of 1.
void print_goal(const std::string& what, const Figure& figure, Goal kind, double goal, const std::string& unit = "");

}  // namespace fastsplat::bench
