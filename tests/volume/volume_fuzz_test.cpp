// SPDX-License-Identifier: Apache-2.0
// Seeded damage to small volume files: each either loads or is a UserError on one line, and stderr stays empty.
#include <gtest/gtest.h>

#include <cstdio>
#include <random>
#include <sstream>

#include "scene/volume/volume_file.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::volume {
namespace {

class VolumeFuzz : public TemporaryFolder {
 protected:
  std::string saved(const char* name, VoxelType type) const {
    const Volume volume = make_volume({6, 5, 4}, {1.0, 1.5, 2.0}, type,
                                      [](int i, int j, int k) { return (i * 37 + j * 11 + k * 5) % 100; });
    save_volume(volume, folder_ / name, type);
    std::ostringstream bytes;
    bytes << std::ifstream(folder_ / name, std::ios::binary).rdbuf();
    return bytes.str();
  }
};

/// One to four changes: bytes, bits, digits of headers, cuts, repeats.
std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&random](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  for (std::size_t changes = 1 + below(4); changes-- > 0 && !bytes.empty();) {
    // Half of the damage hits the header, which decides most.
    const std::size_t at = below(below(2) == 0 ? std::min<std::size_t>(bytes.size(), 360) : bytes.size());
    switch (below(6)) {
      case 0:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes[at] = "0123456789-.en \n:%/"[below(19)];
        break;
      case 3:
        bytes.resize(at);
        break;
      case 4: {
        const std::size_t count = below(40);
        bytes.insert(at, bytes.substr(below(bytes.size()), count));
        break;
      }
      default:
        bytes.replace(at, std::min<std::size_t>(8, bytes.size() - at), std::string(8, below(2) == 0 ? '\xff' : '\x7f'));
        break;
    }
  }
  return bytes;
}

TEST_F(VolumeFuzz, LoadsOrRefuses) {
  constexpr unsigned kSeed = 20241;
  constexpr int kPerFile = 500;
  std::printf("[figure] fuzz seed = %u\n", kSeed);
  const std::string header =
      "NRRD0004\ntype: short\ndimension: 3\nspace: left-posterior-superior\nsizes: 6 5 4\nspace directions: (1,0,0) "
      "(0,1,0) (0,0,2)\n"
      "kinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: (0,0,0)\n\n" +
      std::string(240, 'a');
  const std::string metaimage =
      "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = True\nTransformMatrix = 1 0 0 0 0.8 "
      "0.6 0 -0.6 0.8\nOffset = 1 2 3\nElementSpacing = 1 1 2\nDimSize = 6 5 4\nElementType = MET_SHORT\n"
      "ElementDataFile = LOCAL\n" +
      std::string(240, 'a');
  std::string text = "NRRD0004\ntype: short\ndimension: 3\nsizes: 6 5 4\nencoding: ascii\n\n", numbers;
  for (int i = 0; i < 120; ++i) numbers += std::to_string(37 * i % 100 - 50) + (i % 10 == 9 ? "\n" : " ");
  text += numbers;
  const std::string hex =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 6 5 4\nencoding: hex\n\n" + std::string(240, '7');
  write("k1.raw", "#\n" + std::string(60, 'a'));
  write("k2.raw", "#\n" + std::string(60, 'b'));
  const std::string list =
      "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 6 5 4\nencoding: raw\nline skip: 1\nbyte skip: -1\n"
      "data file: LIST\nk1.raw\nk2.raw\n";
  const std::string full =
      "NRRD0005\ntype: uchar\ndimension: 4\nspace: left-posterior-superior-time\nsizes: 1 6 5 4\n"
      "space directions: none (1,0,0,0) (0,1,0,0) (0,0,2,0)\ncenterings: none cell cell cell\nkinds: list space space "
      "space\nspace units: \"um\" \"mm\" \"cm\" \"s\"\nspace origin: (0,0,0,0)\nencoding: raw\nkey:a:=b\n\n" +
      std::string(120, 'a');
  const std::vector<std::pair<const char*, std::string>> originals = {{"a.nrrd", saved("a.nrrd", VoxelType::U16)},
                                                                      {"b.nii", saved("b.nii", VoxelType::F32)},
                                                                      {"c.nii.gz", saved("c.nii.gz", VoxelType::I16)},
                                                                      {"d.nhdr", saved("d.nhdr", VoxelType::U8)},
                                                                      {"e.nrrd", header},
                                                                      {"f.mha", saved("f.mha", VoxelType::I16)},
                                                                      {"g.mhd", saved("g.mhd", VoxelType::U8)},
                                                                      {"h.mha", metaimage},
                                                                      {"i.nrrd", text},
                                                                      {"j.nrrd", hex},
                                                                      {"k.nhdr", list},
                                                                      {"l.nrrd", full}};
  std::mt19937 random(kSeed);
  int loaded = 0;
  int refused = 0;
  ::testing::internal::CaptureStderr();
  for (const auto& [name, bytes] : originals) {
    for (int i = 0; i < kPerFile; ++i) {
      const auto path = write(name, mutated(bytes, random));
      try {
        const Volume volume = load_volume(path.string());
        EXPECT_EQ(volume.voxels.size(), static_cast<std::size_t>(volume.dims.x) * volume.dims.y * volume.dims.z);
        ++loaded;
      } catch (const UserError& error) {
        EXPECT_EQ(error.code(), ExitCode::Input);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        ++refused;
      }
    }
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  std::printf("[figure] damaged files loaded = %d, refused = %d\n", loaded, refused);
  EXPECT_EQ(loaded + refused, kPerFile * static_cast<int>(originals.size()));
  EXPECT_GT(loaded, 100);  // damage without effect
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace fastsplat::volume
