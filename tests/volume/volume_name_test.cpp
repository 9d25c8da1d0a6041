// SPDX-License-Identifier: Apache-2.0
// Finding a volume by the user's name for it.
#include <gtest/gtest.h>

#include <cstdlib>

#include "scene/volume/volume_file.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class VolumeName : public TemporaryFolder {
 protected:
  void TearDown() override {
    ::unsetenv("FASTSPLAT_DATA");
    TemporaryFolder::TearDown();
  }
  static std::string message(const std::string& name) {
    return refusal([&] { load_volume(name); });
  }
};

TEST_F(VolumeName, BuiltInsByNameAndSize) {
  EXPECT_EQ(load_volume("shells:12").dims, glm::ivec3(12));
  EXPECT_EQ(load_volume("point").name, "point:9");
  EXPECT_EQ(read_volume_header("constant:1024").dims, glm::ivec3(1024));
  EXPECT_TRUE(read_volume_header("constant:1024").voxels.empty());
  for (const char* bad : {"shells:", "shells:x", "shells:12x", "shells:-4", "shells:99999999999"}) message(bad);
  EXPECT_THAT(message("shels:12"), HasSubstr("did you mean 'shells'?"));
  EXPECT_THAT(message("ch2bed"), HasSubstr("did you mean 'ch2bet'?"));
  EXPECT_THAT(message(""), HasSubstr("known: "));
}

TEST_F(VolumeName, FilesAndFolders) {
  EXPECT_THAT(message(folder_.string()), HasSubstr("directory"));
  EXPECT_THAT(message((folder_ / "none.nrrd").string()), HasSubstr("no such file"));
  EXPECT_THAT(message(write("empty.nii", "").string()), HasSubstr("empty"));
  EXPECT_THAT(message(write("text.nii", "hello").string()), HasSubstr("NRRD, NIfTI or MetaImage"));
  EXPECT_THAT(message(write("gaussians.ply", "ply\nformat ascii 1.0\n").string()), HasSubstr("with --gaussians"));
  EXPECT_THAT(message(write("alone.img", "hello").string()), HasSubstr("put the .hdr beside it"));
  if (::geteuid() == 0) {
    std::printf("[figure] permission denied: not tried, root may read everything\n");
  } else {
    const auto path = write("secret.nii", "x");
    fs::permissions(path, fs::perms::none);
    EXPECT_THAT(message(path.string()), HasSubstr("permission denied"));
  }
}

TEST_F(VolumeName, KnownScansComeFromTheUsersFolderFirst) {
  const Volume mine = make_volume({2, 3, 4}, glm::dvec3(1), VoxelType::U8, [](int i, int, int) { return i; });
  save_volume(mine, folder_ / "ch2bet.nii.gz", VoxelType::U8);
  ::setenv("FASTSPLAT_DATA", folder_.c_str(), 1);
  const Volume found = load_volume("ch2bet");
  EXPECT_EQ(found.dims, mine.dims);
  EXPECT_EQ(found.name, "ch2bet");
  EXPECT_EQ(found.source, (folder_ / "ch2bet.nii.gz").string());
}

TEST_F(VolumeName, KnownScansComeFromDebian) {
  if (!fs::exists("/usr/share/mricron/templates/ch2bet.nii.gz")) {
    EXPECT_THAT(message("ch2bet"), HasSubstr("apt-get install mricron-data"));
    GTEST_SKIP() << "mricron-data is not installed";
  }
  const Volume scan = load_volume("ch2bet");
  EXPECT_EQ(scan.dims, glm::ivec3(181, 217, 181));
  EXPECT_EQ(scan.spacing, glm::dvec3(1.0));
  EXPECT_EQ(scan.stored, VoxelType::U8);
}

}  // namespace
}  // namespace fastsplat::volume
