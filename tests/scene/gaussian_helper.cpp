// SPDX-License-Identifier: Apache-2.0
#include "tests/scene/gaussian_helper.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/error.hpp"
#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {
namespace {

template <class T, class Word>
void append(std::string& to, T value, bool big) {
  const auto word = std::bit_cast<Word>(value);
  std::string bytes;
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes.push_back(static_cast<char>((word >> (8 * i)) & 0xFFU));
  if (big) std::ranges::reverse(bytes);
  to += bytes;
}

double relative_difference(float a, float b) {
  return std::abs(double(a) - double(b)) / std::max({1.0, std::abs(double(a)), std::abs(double(b))});
}

}  // namespace

TestFile::TestFile(const std::string& ending, const std::string& bytes) {
  static int number = 0;
  path_ = std::filesystem::temp_directory_path() /
          ("gaussians-" + std::to_string(::getpid()) + "-" + std::to_string(number++) + ending);
  std::ofstream(path_, std::ios::binary) << bytes;
}
TestFile::~TestFile() { std::filesystem::remove(path_); }

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

std::string PlyTable::text(const std::string& format, const std::string& type, const std::string& comment) const {
  std::string out =
      "ply\nformat " + format + " 1.0\n" + comment + "element vertex " + std::to_string(rows.size()) + "\n";
  for (const auto& name : names) out += "property " + type + " " + name + "\n";
  out += "end_header\n";
  const bool big = format == "binary_big_endian";
  for (const auto& row : rows) {
    if (format == "ascii") {
      std::ostringstream line;
      line.precision(std::numeric_limits<double>::max_digits10);
      for (const double value : row) line << value << ' ';
      out += line.str() + "\n";
      continue;
    }
    for (const double value : row) {
      if (type == "double" || type == "float64") {
        append<double, std::uint64_t>(out, value, big);
      } else {
        append<float, std::uint32_t>(out, static_cast<float>(value), big);
      }
    }
  }
  return out;
}

PlyTable PlyTable::with(const std::string& name, double value, std::size_t row) const {
  PlyTable out = *this;
  for (std::size_t i = 0; i < out.names.size(); ++i)
    if (out.names[i] == name) out.rows[row][i] = value;
  return out;
}

PlyTable PlyTable::without(const std::string& name) const {
  PlyTable out = *this;
  for (std::size_t i = 0; i < out.names.size(); ++i) {
    if (out.names[i] != name) continue;
    out.names.erase(out.names.begin() + static_cast<std::ptrdiff_t>(i));
    for (auto& row : out.rows) row.erase(row.begin() + static_cast<std::ptrdiff_t>(i));
    break;
  }
  return out;
}

PlyTable PlyTable::and_of(const std::string& name, double value) const {
  PlyTable out = *this;
  out.names.push_back(name);
  for (auto& row : out.rows) row.push_back(value);
  return out;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

PlyTable table_of(const GaussianCloud& cloud) {
  PlyTable table{.names = {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"}, .rows = {}};
  const int rest = harmonic_count(cloud.degree) - 1;
  for (int i = 0; i < 3 * rest; ++i) table.names.push_back("f_rest_" + std::to_string(i));
  for (const char* name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
    table.names.emplace_back(name);
  for (std::size_t i = 0; i < cloud.gaussians.size(); ++i) {
    const Gaussian& one = cloud.gaussians[i];
    std::vector<double> row{one.position.x, one.position.y, one.position.z, 0.0, 0.0, 1.0};
    for (int c = 0; c < 3; ++c) row.push_back(cloud.harmonics_of(i)[0][c]);
    for (int c = 0; c < 3; ++c)
      for (const auto& harmonic : cloud.harmonics_of(i).subspan(1)) row.push_back(harmonic[c]);
    row.push_back(std::log(double(one.opacity) / (1.0 - double(one.opacity))));
    for (int axis = 0; axis < 3; ++axis) row.push_back(std::log(double(one.scale[axis])));
    for (int k = 0; k < 4; ++k) row.push_back(3.0 * double(one.rotation[k]));  // a trainer's are of any length
    table.rows.push_back(row);
  }
  return table;
}

double difference(const GaussianCloud& a, const GaussianCloud& b) {
  EXPECT_EQ(a.gaussians.size(), b.gaussians.size());
  EXPECT_EQ(a.harmonics.size(), b.harmonics.size());
  EXPECT_EQ(a.degree, b.degree);
  double worst = 0.0;
  for (std::size_t i = 0; i < std::min(a.gaussians.size(), b.gaussians.size()); ++i) {
    const Gaussian &ours = a.gaussians[i], &theirs = b.gaussians[i];
    for (int axis = 0; axis < 3; ++axis) {
      worst = std::max(worst, relative_difference(ours.position[axis], theirs.position[axis]));
      worst = std::max(worst, relative_difference(ours.scale[axis], theirs.scale[axis]));
    }
    for (int k = 0; k < 4; ++k) worst = std::max(worst, relative_difference(ours.rotation[k], theirs.rotation[k]));
    worst = std::max(worst, relative_difference(ours.opacity, theirs.opacity));
  }
  for (std::size_t i = 0; i < std::min(a.harmonics.size(), b.harmonics.size()); ++i)
    for (int c = 0; c < 3; ++c) worst = std::max(worst, relative_difference(a.harmonics[i][c], b.harmonics[i][c]));
  return worst;
}

Apart apart(const GaussianCloud& a, const GaussianCloud& b) {
  EXPECT_EQ(a.gaussians.size(), b.gaussians.size());
  EXPECT_EQ(a.degree, b.degree);
  Apart worst;
  const auto note = [](double& most, double difference) { most = std::max(most, std::abs(difference)); };
  for (std::size_t i = 0; i < std::min(a.gaussians.size(), b.gaussians.size()); ++i) {
    const Gaussian &one = a.gaussians[i], &other = b.gaussians[i];
    const auto ours = a.harmonics_of(i), theirs = b.harmonics_of(i);
    for (int axis = 0; axis < 3; ++axis) {
      note(worst.position, double(one.position[axis]) - double(other.position[axis]));
      note(worst.scale, std::log(double(one.scale[axis])) - std::log(double(other.scale[axis])));
      note(worst.colour, kConstantHarmonic * (double(ours[0][axis]) - double(theirs[0][axis])));
      for (std::size_t k = 1; k < std::min(ours.size(), theirs.size()); ++k)
        note(k <= 3 ? worst.harmonic : worst.harmonics, double(ours[k][axis]) - double(theirs[k][axis]));
    }
    note(worst.rotation, 1.0 - std::abs(glm::dot(glm::dvec4(one.rotation), glm::dvec4(other.rotation))));
    note(worst.opacity, double(one.opacity) - double(other.opacity));
  }
  return worst;
}

void figure(const std::string& name, double value) { std::printf("[figure] %s = %.3g\n", name.c_str(), value); }

void print(const std::string& name, const Apart& apart) {
  std::printf(
      "[figure] %s: position %.2g, log scale %.2g, rotation %.2g, opacity %.2g, colour %.2g, harmonics %.2g and %.2g\n",
      name.c_str(), apart.position, apart.scale, apart.rotation, apart.opacity, apart.colour, apart.harmonic,
      apart.harmonics);
}

std::string refusal_of(const std::string& ending, const std::string& bytes) {
  const TestFile file(ending, bytes);
  try {
    load_gaussians(file.path());
  } catch (const UserError& error) {
    const std::string line = error.what();
    std::printf("%s\n", line.c_str());
    EXPECT_EQ(error.code(), ExitCode::Input);
    EXPECT_NE(line.find(file.path().string()), std::string::npos);
    EXPECT_EQ(line.find('\n'), std::string::npos);
    EXPECT_LT(line.size(), 400U);
    return line;
  }
  ADD_FAILURE() << "it was read";
  return {};
}

std::string number(std::uint64_t value, unsigned bytes) {
  std::string out;
  for (unsigned i = 0; i < bytes; ++i) out.push_back(static_cast<char>((value >> (8 * i)) & 0xFFU));
  return out;
}
std::string gzipped(const std::string& bytes) {
  std::string out(compressBound(bytes.size()) + 64, '\0');
  z_stream stream{};
  deflateInit2(&stream, 9, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

std::string patched(std::string bytes, std::size_t at, const std::string& others) {
  EXPECT_LE(at + others.size(), bytes.size());
  return bytes.replace(at, others.size(), others);
}

}  // namespace fastsplat::scene
