// SPDX-License-Identifier: Apache-2.0
// Shared by the tests of scene/volume/ and scene/: a folder that is removed, errors as text, small volumes.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "base/error.hpp"
#include "scene/volume/byte_reader.hpp"
#include "scene/volume/hounsfield.hpp"
#include "scene/volume/volume.hpp"

namespace fastsplat::volume {

class TemporaryFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / ("fastsplat-" + std::string(test->test_suite_name()) + "-" +
                                                        test->name() + "-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    std::filesystem::remove(folder_ / name);  // ext4 flushes a file that is truncated and written again
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }

  std::filesystem::path folder_;
};

inline std::string gzip(const std::string& text) {
  std::ostringstream out;
  write_gzip(out, text.data(), text.size());
  return out.str();
}

/// Values as stored in a file.
template <typename T>
std::string bytes_of(std::initializer_list<T> values, bool big_endian = false) {
  std::string out;
  for (const T value : values) {
    std::string one(sizeof(T), '\0');
    std::memcpy(one.data(), &value, sizeof(T));
    if (big_endian) std::reverse(one.begin(), one.end());
    out += one;
  }
  return out;
}

/// The message of the UserError that `call` must throw, with this exit code, on one line.
template <typename Call>
std::string refusal(Call&& call, ExitCode code = ExitCode::Input) {
  try {
    call();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    const std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_FALSE(error.parts().fix.empty()) << "no fix offered: " << text;
    return text;
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

/// Voxels from value(i,j,k); min, max and water are computed.
template <typename Value>
Volume make_volume(glm::ivec3 dims, glm::dvec3 spacing, VoxelType stored, Value&& value) {
  Volume volume;
  volume.name = "test";
  volume.dims = dims;
  volume.spacing = spacing;
  volume.stored = stored;
  for (int k = 0; k < dims.z; ++k) {
    for (int j = 0; j < dims.y; ++j) {
      for (int i = 0; i < dims.x; ++i) volume.voxels.push_back(static_cast<float>(value(i, j, k)));
    }
  }
  volume.min = *std::min_element(volume.voxels.begin(), volume.voxels.end());
  volume.max = *std::max_element(volume.voxels.begin(), volume.voxels.end());
  volume.water = find_water(volume);
  return volume;
}

}  // namespace fastsplat::volume
