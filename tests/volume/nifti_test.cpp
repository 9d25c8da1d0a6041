// SPDX-License-Identifier: Apache-2.0
// NIfTI files written by hand: versions, byte orders, scaling, axes, pairs, and refused ones.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <sstream>

#include "scene/volume/byte_reader.hpp"
#include "scene/volume/volume_file.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// The few header fields the tests vary, laid out by the offsets of the NIfTI standards.
struct Header {
  int version = 1;
  bool big_endian = false;
  std::array<std::int64_t, 8> dim{3, 2, 2, 2, 1, 1, 1, 1};
  std::array<double, 8> pixdim{1, 1, 1, 1, 1, 1, 1, 1};
  int datatype = 2;
  double offset = -1.0;  // default of the version
  double slope = 0.0, intercept = 0.0;
  int units = 2;
  int sform = 0;
  std::array<double, 12> rows{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  int qform = 0;
  std::array<double, 3> quaternion{};
  std::string magic{};

  std::string bytes() const {
    const bool one = version == 1;
    std::string out(one ? 352 : 544, '\0');
    const auto put = [&](std::size_t at, auto value) {
      std::string raw(sizeof(value), '\0');
      std::memcpy(raw.data(), &value, sizeof(value));
      if (big_endian) std::reverse(raw.begin(), raw.end());
      out.replace(at, raw.size(), raw);
    };
    const double data = offset >= 0.0 || std::isnan(offset) ? offset : static_cast<double>(out.size());
    if (one) {
      put(0, std::int32_t{348});
      for (std::size_t i = 0; i < 8; ++i) put(40 + 2 * i, static_cast<std::int16_t>(dim[i]));
      put(70, static_cast<std::int16_t>(datatype));
      for (std::size_t i = 0; i < 8; ++i) put(76 + 4 * i, static_cast<float>(pixdim[i]));
      put(108, static_cast<float>(data));
      put(112, static_cast<float>(slope));
      put(116, static_cast<float>(intercept));
      out[123] = static_cast<char>(units);
      put(252, static_cast<std::int16_t>(qform));
      put(254, static_cast<std::int16_t>(sform));
      for (std::size_t i = 0; i < 3; ++i) put(256 + 4 * i, static_cast<float>(quaternion[i]));
      for (std::size_t i = 0; i < 12; ++i) put(280 + 4 * i, static_cast<float>(rows[i]));
      out.replace(344, 4, magic.empty() ? std::string("n+1\0", 4) : magic);
    } else {
      put(0, std::int32_t{540});
      out.replace(4, 8, magic.empty() ? std::string("n+2\0\r\n\032\n", 8) : magic);
      put(12, static_cast<std::int16_t>(datatype));
      for (std::size_t i = 0; i < 8; ++i) put(16 + 8 * i, dim[i]);
      for (std::size_t i = 0; i < 8; ++i) put(104 + 8 * i, pixdim[i]);
      put(168, static_cast<std::int64_t>(data));
      put(176, slope);
      put(184, intercept);
      put(344, std::int32_t{qform});
      put(348, std::int32_t{sform});
      for (std::size_t i = 0; i < 3; ++i) put(352 + 8 * i, quaternion[i]);
      for (std::size_t i = 0; i < 12; ++i) put(400 + 8 * i, rows[i]);
      put(500, std::int32_t{units});
    }
    return out;
  }
};

class Nifti : public TemporaryFolder {
 protected:
  Volume load(const Header& header, const std::string& data, const char* name = "v.nii") const {
    return load_volume(write(name, header.bytes() + data).string());
  }
  std::string refused(const Header& header, const std::string& data = "12345678") const {
    const auto path = write("v.nii", header.bytes() + data);
    ::testing::internal::CaptureStderr();
    const std::string message = refusal([&] { load_volume(path.string()); });
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
    EXPECT_THAT(message, HasSubstr("v.nii"));
    return message;
  }
};

const std::string kBytes = "\x01\x02\x03\x04\x05\x06\x07\x08";

TEST_F(Nifti, ReadsBothVersionsBothByteOrdersPlainAndGzip) {
  int read = 0;
  for (const int version : {1, 2}) {
    for (const bool big : {false, true}) {
      const Header header{
          .version = version, .big_endian = big, .pixdim = {1, 0.5, 1.25, 3, 1, 1, 1, 1}, .datatype = 4};
      std::string data;
      for (const int v : {-2, 1, 258, 3, -32768, 32767, 6, 7}) {
        const auto u = static_cast<std::uint16_t>(v);
        const std::string pair{static_cast<char>(u & 0xff), static_cast<char>(u >> 8)};
        data += big ? std::string(pair.rbegin(), pair.rend()) : pair;
      }
      for (const bool packed : {false, true}) {
        const std::string bytes = header.bytes() + data;
        const Volume volume =
            load_volume(write("v.nii", packed ? gzip(bytes) : bytes).string());  // by content, not name
        EXPECT_THAT(volume.voxels, ElementsAre(-2, 1, 258, 3, -32768, 32767, 6, 7));
        EXPECT_EQ(volume.spacing, glm::dvec3(0.5, 1.25, 3));
        EXPECT_EQ(volume.stored, VoxelType::I16);
        ++read;
      }
    }
  }
  EXPECT_EQ(read, 8);
}

TEST_F(Nifti, ScalingIsApplied) {
  const Volume scaled = load({.slope = 0.5, .intercept = -10.0}, kBytes);
  EXPECT_THAT(scaled.voxels, ElementsAre(-9.5, -9, -8.5, -8, -7.5, -7, -6.5, -6));
  EXPECT_EQ(scaled.stored, VoxelType::F32);
  const Volume unscaled = load({.slope = 0.0, .intercept = 5.0}, kBytes);  // slope 0: the standard says ignore both
  EXPECT_EQ(unscaled.at(0, 0, 0), 1.0f);
  EXPECT_EQ(unscaled.stored, VoxelType::U8);
}

TEST_F(Nifti, InvalidScalingIsIgnored) {
  // Some writers put NaN into unused fields.
  EXPECT_THAT(load({.slope = NAN, .intercept = NAN}, kBytes).voxels, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
}

TEST_F(Nifti, UnitsBecomeMillimetres) {
  const std::array<double, 8> pixdim{1, 0.002, 0.001, 0.001, 1, 1, 1, 1};
  EXPECT_NEAR(load({.pixdim = pixdim, .units = 1}, kBytes).spacing.x, 2.0, 1e-6);
  EXPECT_NEAR(load({.pixdim = {1, 500, 500, 500, 1, 1, 1, 1}, .units = 3}, kBytes).spacing.x, 0.5, 1e-6);
  EXPECT_NEAR(load({.pixdim = {1, -2, 1, 1, 1, 1, 1, 1}, .units = 0}, kBytes).spacing.x, 2.0, 1e-6);
}

TEST_F(Nifti, AxesAreTurnedToRightAnteriorSuperior) {
  EXPECT_THAT(load({.sform = 1}, kBytes).voxels, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  // x runs to the left, the radiological convention.
  EXPECT_THAT(load({.sform = 1, .rows = {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0}}, kBytes).voxels,
              ElementsAre(2, 1, 4, 3, 6, 5, 8, 7));
  // i runs up, k to the right.
  const Volume sagittal =
      load({.pixdim = {1, 3, 1, 2, 1, 1, 1, 1}, .sform = 1, .rows = {0, 0, 2, 0, 0, 1, 0, 0, 3, 0, 0, 0}}, kBytes);
  EXPECT_THAT(sagittal.voxels, ElementsAre(1, 5, 3, 7, 2, 6, 4, 8));
  EXPECT_EQ(sagittal.spacing, glm::dvec3(2, 1, 3));
}

TEST_F(Nifti, AnUnusableFormIsReportedAndTheOtherUsed) {
  for (const std::array<double, 12>& rows : {std::array<double, 12>{},
                                             {NAN, 0, 0, 0, 0, INFINITY, 0, 0, 0, 0, 1, 0},
                                             {1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0}}) {
    const Volume neither = load({.sform = 1, .rows = rows}, kBytes);
    EXPECT_THAT(neither.voxels, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
    EXPECT_FALSE(neither.placed);
    EXPECT_THAT(
        neither.remarks,
        ElementsAre(HasSubstr("sform needs three independent axes and a finite origin: axes are drawn as stored")));
    // A half turn about z: x runs to the left, y to the back.
    const Volume by_qform = load({.sform = 1, .rows = rows, .qform = 1, .quaternion = {0, 0, 1}}, kBytes);
    EXPECT_THAT(by_qform.voxels, ElementsAre(4, 3, 2, 1, 8, 7, 6, 5));
    EXPECT_THAT(
        by_qform.remarks,
        ElementsAre(HasSubstr("sform needs three independent axes and a finite origin: its qform is used instead")));
  }
}

// libnifti2 makes non-finite values 0, and shortens a rotation that is too long.
TEST_F(Nifti, AQformThatIsNotARotationIsNotUsed) {
  int unusable = 0;
  for (const int version : {1, 2}) {
    for (const auto& quaternion : {std::array<double, 3>{NAN, 0.0, 1.0}, {0.0, INFINITY, 0.0}, {2.0, 2.0, 2.0}}) {
      const Volume volume = load({.version = version, .qform = 1, .quaternion = quaternion}, kBytes);
      EXPECT_FALSE(volume.placed);
      EXPECT_THAT(volume.remarks, ElementsAre(HasSubstr("the header's qform needs three independent axes")));
      ++unusable;
    }
    EXPECT_TRUE(load({.version = version, .qform = 1, .quaternion = {0, 0, 1.00001}}, kBytes).placed);
  }
  std::printf("[figure] invalid qforms not used = %d\n", unusable);
}

TEST_F(Nifti, ScalingIsNotHalfApplied) {
  EXPECT_THAT(refused({.slope = 2.0, .intercept = NAN}), HasSubstr("the header's value scaling is not a number"));
  EXPECT_THAT(refused({.slope = INFINITY}), HasSubstr("the header's value scaling is not a number"));
}

TEST_F(Nifti, AnUnknownUnitIsReported) {
  EXPECT_THAT(load({.units = 7}, kBytes).remarks, ElementsAre(HasSubstr("unit of length, code 7, is unknown: mm")));
}

TEST_F(Nifti, WideIntegersAreRead) {
  const Volume labels = load({.datatype = 1024}, bytes_of<std::int64_t>({0, 1, 2, 3, 4, -5, 6, 7}));
  EXPECT_THAT(labels.voxels, ElementsAre(0, 1, 2, 3, 4, -5, 6, 7));
  EXPECT_EQ(labels.stored, VoxelType::I8);
  EXPECT_THAT(load({.datatype = 1280}, bytes_of<std::uint64_t>({0, 1, 2, 3, 4, 5, 6, 70000})).voxels,
              ElementsAre(0, 1, 2, 3, 4, 5, 6, 70000));
  // Scaled counts are floats like any other; the rounding of the scale is not reported.
  const Volume counts =
      load({.datatype = 8, .slope = 0.1}, bytes_of<std::int32_t>({0, 1, 2, 3, 4, 5, 16777217, 100000001}));
  EXPECT_FLOAT_EQ(counts.at(1, 1, 1), 1e7f);
  EXPECT_THAT(counts.remarks, ElementsAre());
  const Volume large = load({.datatype = 1024}, bytes_of<std::int64_t>({0, 1, 2, 3, 4, 5, 6, (1LL << 53) + 1}));
  EXPECT_THAT(large.remarks, ElementsAre(HasSubstr("1 of 8 voxels have more digits than a float holds")));
}

TEST_F(Nifti, PairsReadTheImgBesideTheHdr) {
  const Header header{.offset = 0.0, .magic = std::string("ni1\0", 4)};
  write("v.img", kBytes);
  EXPECT_THAT(load(header, "", "v.hdr").voxels, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  fs::remove(folder_ / "v.img");
  write("v.img.gz", gzip(kBytes));
  EXPECT_THAT(load(header, "", "v.hdr").voxels, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  fs::remove(folder_ / "v.img.gz");
  EXPECT_THAT(refusal([&] { load(header, "", "v.hdr"); }), HasSubstr(".img"));
  EXPECT_THAT(refusal([&] { load(header, "", "v.nii"); }), HasSubstr(".hdr"));
  write("v.hdr", header.bytes());
  for (const char* name : {"v.img", "v.img.gz"}) {  // named by its data
    const auto data = write(name, name == std::string("v.img") ? kBytes : gzip(kBytes));
    EXPECT_THAT(load_volume(data.string()).voxels, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8)) << name;
    EXPECT_EQ(files_of(data.string()).size(), 2U);
    fs::remove(data);
  }
  fs::create_directory(folder_ / "inside");
  write("secret.img", kBytes);
  fs::create_symlink(folder_ / "secret.img", folder_ / "inside" / "v.img");
  EXPECT_THAT(refusal([&] { load(header, "", "inside/v.hdr"); }), HasSubstr("link to outside"));
}

TEST_F(Nifti, RefusesFilesThatAreNotVolumes) {
  EXPECT_THAT(refused({.dim = {4, 2, 2, 2, 2, 1, 1, 1}}), HasSubstr("got 2 x 2 x 2 x 2"));
  EXPECT_THAT(refused({.dim = {2, 4, 2, 1, 1, 1, 1, 1}}), HasSubstr("3 dimensions"));
  EXPECT_THAT(refused({.datatype = 128}), HasSubstr("voxel type"));  // RGB
  EXPECT_THAT(refused({.datatype = 32}), HasSubstr("voxel type"));   // complex
  EXPECT_EQ(load({.dim = {5, 2, 2, 2, 1, 1, 0, 0}}, kBytes).dims, glm::ivec3(2));
  EXPECT_THAT(refused({.magic = std::string(4, '\0')}), HasSubstr("ANALYZE"));
}

TEST_F(Nifti, SizesAreCheckedBeforeAnythingIsAllocated) {
  EXPECT_THAT(refused({.dim = {3, 32767, 32767, 2, 1, 1, 1, 1}}), HasSubstr("declares more than the file holds"));
  EXPECT_THAT(refused({.dim = {3, 32767, 32767, 32767, 1, 1, 1, 1}}), HasSubstr("too many voxels"));
  EXPECT_THAT(refused({.version = 2, .dim = {3, 1LL << 62, 1LL << 62, 1LL << 62, 1, 1, 1, 1}}),
              HasSubstr("invalid dimension 1"));
  EXPECT_THAT(refused({.dim = {3, -2, 2, 2, 1, 1, 1, 1}}), HasSubstr("invalid dimension"));
  EXPECT_THAT(refused({.dim = {3, 0, 2, 2, 1, 1, 1, 1}}), HasSubstr("invalid dimension"));
  EXPECT_THAT(refused({.dim = {0, 2, 2, 2, 1, 1, 1, 1}}), HasSubstr("number of dimensions"));
  EXPECT_THAT(refused({.dim = {8, 2, 2, 2, 1, 1, 1, 1}}), HasSubstr("number of dimensions"));
  EXPECT_THAT(refused({}, "1234567"), HasSubstr("declares more"));
  EXPECT_THAT(refused({.offset = 100.0}), HasSubstr("offset"));
  EXPECT_THAT(refused({.offset = NAN}), HasSubstr("offset"));
  EXPECT_THAT(refused({.offset = 1e30}), HasSubstr("offset"));
}

TEST_F(Nifti, DamageIsNamed) {
  const std::string whole = gzip(Header{.dim = {3, 16, 16, 16, 1, 1, 1, 1}}.bytes() + [] {
    std::string noise(4096, '\0');
    unsigned state = 1;
    for (char& c : noise) c = static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
    return noise;
  }());
  const auto message = [&](const std::string& bytes) {
    const auto path = write("v.nii.gz", bytes);
    return refusal([&] { load_volume(path.string()); });
  };
  EXPECT_THAT(message(whole.substr(0, whole.size() / 2)), HasSubstr("truncated"));
  EXPECT_THAT(message(whole.substr(0, whole.size() - 3)), HasSubstr("truncated"));
  EXPECT_THAT(message(whole.substr(0, 20)), HasSubstr("truncated"));
  std::string flipped = whole;
  flipped[whole.size() - 5] = static_cast<char>(flipped[whole.size() - 5] ^ 4);
  EXPECT_THAT(message(flipped), HasSubstr("corrupt"));
  EXPECT_THAT(message(Header{}.bytes().substr(0, 200)), HasSubstr("header is truncated"));
  EXPECT_THAT(message("not a volume"), HasSubstr("NRRD, NIfTI or MetaImage"));
  const std::string nan("\0\0\xc0\x7f", 4);
  EXPECT_THAT(refused({.datatype = 16}, nan + nan + std::string(24, '\0')),
              HasSubstr("2 of 8 voxels are not finite numbers (got nan first, at voxel (0, 0, 0))"));
}

}  // namespace
}  // namespace fastsplat::volume
