// What Google Benchmark wrote as JSON: lines by name, a value for each repetition, and figures that are made of them.
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace fastsplat::bench {

struct Line {
  std::vector<double> cpu, wall;                      ///< as the benchmark has its unit, one a repetition
  std::map<std::string, double> counters;             ///< of the last repetition
  std::map<std::string, std::vector<double>> each{};  ///< the same, of each
  std::string label;
};

struct Results {
  std::map<std::string, Line> lines;
  std::string machine;  ///< one line, without a name or a date
  std::string date;     ///< year, month, day

  std::size_t repetitions() const;  ///< the most of any line
  /// Null where it was not run.
  const Line* line(const std::string& name) const;
};

/// All files' lines together, the first file's machine. Files without a run are passed over; throws where all are.
Results read_results(std::span<const std::string> files);

double median(std::vector<double> values);

/// A figure and how far its repetitions lie apart.
struct Figure {
  double value = 0.0, least = 0.0, greatest = 0.0;
};
Figure only(double value);
/// Of medians; the spread is from the least above to the greatest below and the other way round.
Figure ratio(const std::vector<double>& above, const std::vector<double>& below);
/// b of y = a x^b through the points (x, median y), least squares of logarithms; the spread is of fits of single
/// repetitions.
Figure exponent(const std::vector<std::pair<double, std::vector<double>>>& points);

enum class Goal { AtLeast, AtMost };

/// The heading of the rows that follow.
void print_heading(const std::string& what);
/// "| what | figure | spread | goal | met or missed by how much |"; %-figures are given as shares of 1.
void print_goal(const std::string& what, const Figure& figure, Goal kind, double goal, const std::string& unit = "");

}  // namespace fastsplat::bench
