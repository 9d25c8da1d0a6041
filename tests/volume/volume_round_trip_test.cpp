// SPDX-License-Identifier: Apache-2.0
// load_volume reads back what save_volume wrote, in every type and format.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <cstdio>
#include <limits>

#include "scene/volume/volume_file.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::volume {
namespace {

using ::testing::HasSubstr;

struct Case {
  VoxelType type;
  float low, high;  // the type's ends
};

class RoundTrip : public TemporaryFolder, public ::testing::WithParamInterface<std::tuple<Case, const char*>> {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("fastsplat-round-trip-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
};

TEST_P(RoundTrip, KeepsEveryVoxelAndTheSpacing) {
  // Separate names: Clang 14 captures no structured binding in a lambda.
  const auto& kind = std::get<0>(GetParam());
  const auto& ending = std::get<1>(GetParam());
  const float step = (kind.high - kind.low) / 59.0f;
  const Volume out = make_volume({3, 4, 5}, {0.5, 1.25, 3.0}, kind.type, [&](int i, int j, int k) {
    const int n = i + 3 * j + 12 * k;
    const float value = n == 59 ? kind.high : kind.low + static_cast<float>(n) * step;
    return kind.type == VoxelType::F32 ? value : std::floor(value);
  });
  const auto path = folder_ / (std::string("volume") + ending);
  save_volume(out, path, kind.type);
  const Volume in = load_volume(path.string());
  EXPECT_EQ(in.dims, out.dims);
  EXPECT_EQ(in.spacing, out.spacing);
  EXPECT_EQ(in.stored, kind.type);
  EXPECT_EQ(in.voxels, out.voxels);
  EXPECT_EQ(in.min, out.min);
  EXPECT_EQ(in.max, out.max);
  EXPECT_EQ(in.name, path.string());
  EXPECT_FALSE(in.placed) << "a file must not invent a placement";
  const Volume header = read_volume_header(path.string());
  EXPECT_EQ(header.dims, out.dims);
  EXPECT_EQ(header.spacing, out.spacing);
  EXPECT_EQ(header.stored, kind.type);
  EXPECT_TRUE(header.voxels.empty());
  for (const auto& entry : std::filesystem::directory_iterator(folder_))
    EXPECT_NE(entry.path().filename().string()[0], '.');
}

INSTANTIATE_TEST_SUITE_P(
    AllTypesAndFormats, RoundTrip,
    ::testing::Combine(::testing::Values(Case{VoxelType::U8, 0, 255}, Case{VoxelType::I8, -128, 127},
                                         Case{VoxelType::U16, 0, 65535}, Case{VoxelType::I16, -32768, 32767},
                                         Case{VoxelType::F32, -1e30f, 2e30f}),
                       ::testing::Values(".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd")),
    [](const auto& test) {
      std::string name = std::string(to_string(std::get<0>(test.param).type)) + std::get<1>(test.param);
      std::replace(name.begin(), name.end(), '.', '_');
      return name;
    });

class SaveVolume : public TemporaryFolder {
 protected:
  Volume with(float odd, VoxelType type) const {
    return make_volume({2, 2, 2}, glm::dvec3(1), type,
                       [odd](int i, int j, int k) { return i + j + k == 3 ? odd : 1.0f; });
  }
};

TEST_F(SaveVolume, RefusesValuesThatDoNotFit) {
  for (const auto& wrong : {std::pair{256.0f, VoxelType::U8},
                            {-1.0f, VoxelType::U8},
                            {0.5f, VoxelType::U16},
                            {128.0f, VoxelType::I8},
                            {65536.0f, VoxelType::U16},
                            {-32769.0f, VoxelType::I16}}) {
    const auto path = folder_ / "out.nrrd";
    EXPECT_THAT(refusal([&] { save_volume(with(wrong.first, VoxelType::F32), path, wrong.second); }),
                HasSubstr("at (1, 1, 1)"));
    EXPECT_FALSE(std::filesystem::exists(path));
  }
}

TEST_F(SaveVolume, RefusesUnknownEndingsAndBadPlaces) {
  EXPECT_THAT(refusal([&] { save_volume(with(1, VoxelType::U8), folder_ / "out.raw", VoxelType::U8); }),
              HasSubstr(".nrrd, .nhdr, .nii, .nii.gz, .mha or .mhd"));
  EXPECT_THAT(refusal([&] { save_volume(with(1, VoxelType::U8), folder_ / ".nrrd", VoxelType::U8); }),
              HasSubstr("unknown volume format"));
  EXPECT_THAT(refusal([&] { save_volume(with(1, VoxelType::U8), folder_ / "no" / "out.nrrd", VoxelType::U8); }),
              HasSubstr("folder"));
}

TEST_F(SaveVolume, AFullDiskLeavesNothingBehind) {
  // A limit on file size stands for the full disk; the voxels do not compress below it.
  unsigned state = 1;
  const Volume noise = make_volume({32, 32, 32}, glm::dvec3(1), VoxelType::U8, [&state](int, int, int) {
    state = state * 1664525u + 1013904223u;
    return state >> 24;
  });
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{.rlim_cur = 8192, .rlim_max = before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  std::vector<std::string> refusals;
  for (const char* name : {"v.nrrd", "v.nhdr", "v.nii", "v.nii.gz", "v.mha", "v.mhd"}) {
    refusals.push_back(refusal([&] { save_volume(noise, folder_ / name, VoxelType::U8); }));
  }
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  for (const auto& message : refusals) EXPECT_THAT(message, HasSubstr("cannot write"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

}  // namespace
}  // namespace fastsplat::volume
