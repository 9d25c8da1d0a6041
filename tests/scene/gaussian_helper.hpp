// SPDX-License-Identifier: Apache-2.0
// Files of Gaussians written by tests, byte by byte.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/gaussians/gaussian_cloud.hpp"

namespace fastsplat::scene {

/// A file of the test that is running, gone at its end.
class TestFile {
 public:
  TestFile(const std::string& ending, const std::string& bytes);
  ~TestFile();
  TestFile(const TestFile&) = delete;
  TestFile& operator=(const TestFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string bytes_of(const std::filesystem::path& path);

/// Names of a PLY's properties and a row for each Gaussian, as a PLY of this format; `type`: float, float32, double or
/// float64.
struct PlyTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
  std::string text(const std::string& format, const std::string& type = "float", const std::string& comment = "") const;
  /// The same with another number in a row, without a property, and with one more of one value.
  PlyTable with(const std::string& name, double value, std::size_t row = 5) const;
  PlyTable without(const std::string& name) const;
  PlyTable and_of(const std::string& name, double value) const;
};
/// The text with `from`, which must exist, replaced by `to`.
std::string replaced(std::string text, const std::string& from, const std::string& to);
/// The properties that a trainer writes for it.
PlyTable table_of(const GaussianCloud& cloud);

/// The largest difference of any number, relative to 1 or to itself where it is larger.
double difference(const GaussianCloud& a, const GaussianCloud& b);

/// The largest difference of each attribute of two clouds of the same size and degree.
struct Apart {
  double position = 0.0;
  double scale = 0.0;     ///< of natural logarithms
  double rotation = 0.0;  ///< 1 minus the cosine of half the angle between
  double opacity = 0.0;
  double colour = 0.0;     ///< of 1/2 + the constant harmonic
  double harmonic = 0.0;   ///< of degree 1
  double harmonics = 0.0;  ///< of degrees above
};
Apart apart(const GaussianCloud& a, const GaussianCloud& b);
/// Prints a figure.
void figure(const std::string& name, double value);
/// Prints them as one figure.
void print(const std::string& name, const Apart& apart);

/// The message of the UserError (Input) with which a file of these bytes is refused. Fails the test if it is read, or
/// if the message is not one line that names the file.
std::string refusal_of(const std::string& ending, const std::string& bytes);

/// A whole number in `bytes` little-endian bytes.
std::string number(std::uint64_t value, unsigned bytes);
std::string gzipped(const std::string& bytes);

/// `bytes` at `at` replaced by others.
std::string patched(std::string bytes, std::size_t at, const std::string& others);

}  // namespace fastsplat::scene
