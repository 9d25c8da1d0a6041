// SPDX-License-Identifier: Apache-2.0
// NRRD files written by hand: byte orders, geometry, detached data, and refused ones.
#include <bzlib.h>
#include <gtest/gtest.h>
#include <zlib.h>

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

std::string bzip2(std::string text) {
  std::string out(text.size() + text.size() / 100 + 600, '\0');
  auto size = static_cast<unsigned>(out.size());
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(out.data(), &size, text.data(), static_cast<unsigned>(text.size()), 9, 0, 0),
            BZ_OK);
  out.resize(size);
  return out;
}

std::string hex(const std::string& bytes) {
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    char two[3];
    std::snprintf(two, sizeof(two), i % 2 ? "%02X" : "%02x", static_cast<unsigned char>(bytes[i]));
    out += two;
    if (i % 5 == 4) out += i % 10 == 4 ? "\n" : " ";
  }
  return out;
}

class Nrrd : public TemporaryFolder {
 protected:
  /// A header of these lines, with defaults for 2 x 2 x 2 uint8, raw.
  static std::string header(const std::string& lines, bool attached = true) {
    std::string text = "NRRD0004\n";
    for (const std::string line : {"type: uint8", "dimension: 3", "sizes: 2 2 2", "encoding: raw"}) {
      const std::string field = "\n" + line.substr(0, line.find(':') + 1);
      if (("\n" + lines).find(field) == std::string::npos) text += line + "\n";
    }
    return text + lines + (attached ? "\n" : "");
  }
  Volume load(const std::string& lines, const std::string& data) const {
    return load_volume(write("v.nrrd", header(lines) + data).string());
  }
  std::string refused(const std::string& lines, const std::string& data = "12345678") const {
    const auto path = write("v.nrrd", header(lines) + data);
    const std::string message = refusal([&] { load_volume(path.string()); });
    EXPECT_THAT(message, HasSubstr("v.nrrd"));
    return message;
  }
};

TEST_F(Nrrd, ReadsBothByteOrdersRawAndGzip) {
  for (const bool big : {false, true}) {
    const std::string endian = std::string("endian: ") + (big ? "big" : "little") + "\n";
    for (const bool packed : {false, true}) {
      const std::string encoding = std::string("encoding: ") + (packed ? "gzip" : "raw") + "\n";
      const auto data = [&](const std::string& raw) { return packed ? gzip(raw) : raw; };
      EXPECT_THAT(load("type: int16\n" + endian + encoding,
                       data(bytes_of<std::int16_t>({-2, 1, 258, 3, -32768, 32767, 6, 7}, big)))
                      .voxels,
                  ElementsAre(-2, 1, 258, 3, -32768, 32767, 6, 7));
      EXPECT_THAT(
          load("type: ushort\n" + endian + encoding, data(bytes_of<std::uint16_t>({0, 1, 258, 3, 4, 65535, 6, 7}, big)))
              .voxels,
          ElementsAre(0, 1, 258, 3, 4, 65535, 6, 7));
      EXPECT_THAT(
          load("type: float\n" + endian + encoding, data(bytes_of<float>({0, 1, 0.1f, 3, -4, 5, 6, 7}, big))).voxels,
          ElementsAre(0, 1, 0.1f, 3, -4, 5, 6, 7));
      EXPECT_THAT(
          load("type: double\n" + endian + encoding, data(bytes_of<double>({0, 1, 0.1, 3, -4, 5, 6, 7}, big))).voxels,
          ElementsAre(0, 1, 0.1f, 3, -4, 5, 6, 7));
    }
  }
  EXPECT_THAT(load("", "\x01\x02\x03\x04\x05\x06\x07\xff").voxels, ElementsAre(1, 2, 3, 4, 5, 6, 7, 255));
  EXPECT_THAT(load("type: signed char\n", "\x01\x02\x03\x04\x05\x06\x07\xff").voxels,
              ElementsAre(1, 2, 3, 4, 5, 6, 7, -1));
}

TEST_F(Nrrd, ReadsBzip2HexAndAsciiLikeRaw) {
  int read = 0;
  const auto same = [&](const std::string& type, const std::string& raw, const std::string& text) {
    const auto expected = load("type: " + type + "\nendian: big\n", raw).voxels;
    const auto got = [&](const std::string& encoding, const std::string& data) {
      ++read;
      EXPECT_EQ(load("type: " + type + "\nendian: big\nencoding: " + encoding + "\n", data).voxels, expected)
          << encoding;
    };
    got("bzip2", bzip2(raw));
    got("bz2", bzip2(raw.substr(0, 8)) + bzip2(raw.substr(8)));  // two members
    got("hex", hex(raw));
    got("ascii", text);
    got("text", text + "\n\n");
    got("txt", " \n" + text);
    EXPECT_EQ(load("type: " + type + "\nencoding: ascii\n", text).voxels, expected);  // text needs no byte order
  };
  same("int16", bytes_of<std::int16_t>({-2, 1, 258, 3, -32768, 32767, 6, 7}, true),
       "-2 1\n258 3\t-32768\r\n32767 +6 7");
  same("float", bytes_of<float>({0, 1, 0.1f, 3, -4, 5e20f, 6, 7}, true), "0 1 0.1 3e0\n-4 5e20 6.0 7");
  same("double", bytes_of<double>({0, 1, 0.1, 3, -4, 5e20, 6, 7}, true), "0 1 0.1 3e0\n-4 5e20 6.0 7");
  std::printf("[figure] encodings read like raw = %d\n", read);
  EXPECT_EQ(read, 18);
  // More than one chunk of text, numbers across its ends.
  std::string numbers;
  for (int i = 0; i < 60000; ++i) numbers += std::to_string(i % 251) + (i % 7 ? " " : "\n");
  const auto many = load("sizes: 60 50 20\nencoding: ascii\n", numbers).voxels;
  ASSERT_EQ(many.size(), 60000u);
  int wrong = 0;
  for (int i = 0; i < 60000; ++i) wrong += many[static_cast<std::size_t>(i)] != static_cast<float>(i % 251);
  EXPECT_EQ(wrong, 0);
}

TEST_F(Nrrd, DamagedBzip2HexAndAsciiAreNamed) {
  const std::string packed = bzip2("12345678");
  EXPECT_THAT(refused("encoding: bzip2\n", packed.substr(0, packed.size() - 3)), HasSubstr("truncated"));
  std::string flipped = packed;
  flipped[packed.size() / 2] = static_cast<char>(flipped[packed.size() / 2] ^ 16);
  EXPECT_THAT(refused("encoding: bzip2\n", flipped), HasSubstr("corrupt"));
  EXPECT_THAT(refused("encoding: bzip2\n", "not bzip2 at all"), HasSubstr("not bzip2 data"));
  EXPECT_THAT(refused("encoding: bzip2\n", bzip2("1234567")), HasSubstr("expected 8 bytes for 2 x 2 x 2"));
  EXPECT_THAT(refused("encoding: hex\n", "3132333435363g38"), HasSubstr("'g' is not a hexadecimal digit"));
  EXPECT_THAT(refused("encoding: hex\n", "31323334353637   8"), HasSubstr("ends within a byte"));
  EXPECT_THAT(refused("encoding: hex\n", "31323334353637"), HasSubstr("declares more"));
  EXPECT_THAT(refused("encoding: ascii\n", "1 2 3 4 5 6 banana 8"), HasSubstr("voxel 6 of the text is not a number"));
  EXPECT_THAT(refused("encoding: ascii\n", "1 2 3 4 5 6 7 256"), HasSubstr("not a value of the header's type"));
  EXPECT_THAT(refused("encoding: ascii\n", "1 2 3 4 5 6 7 7.5"), HasSubstr("not a value of the header's type"));
  EXPECT_THAT(refused("encoding: ascii\n", "1 2 3 4 5 6 77777"), HasSubstr("voxel 6"));
  EXPECT_THAT(refused("encoding: ascii\n", "1 2 3 4 5 6 7        "), HasSubstr("expected 8 numbers"));
  EXPECT_THAT(refused("encoding: ascii\n", std::string(100000, '1')), HasSubstr("voxel 0"));
  EXPECT_THAT(refused("type: float\nencoding: ascii\n", "1 2 3 nan 5 6 7 8"), HasSubstr("1 of 8 voxels"));
  EXPECT_THAT(refused("encoding: hex\nbyte skip: -1\n", hex("x12345678")), HasSubstr("byte skip -1"));
}

TEST_F(Nrrd, WideIntegersBecomeTheSmallestTypeThatHoldsThem) {
  const std::string lines = "type: int\nendian: little\n";
  EXPECT_EQ(load(lines, bytes_of<std::int32_t>({0, 1, 2, 3, 4, 5, 6, 255})).stored, VoxelType::U8);
  EXPECT_EQ(load(lines, bytes_of<std::int32_t>({0, 1, 2, 3, 4, 5, 6, 256})).stored, VoxelType::U16);
  EXPECT_EQ(load(lines, bytes_of<std::int32_t>({-1, 1, 2, 3, 4, 5, 6, 256})).stored, VoxelType::I16);
  EXPECT_EQ(load(lines, bytes_of<std::int32_t>({-1, 1, 2, 3, 4, 5, 6, 1 << 24})).stored, VoxelType::F32);
  EXPECT_THAT(load(lines, bytes_of<std::int32_t>({0, 1, 2, 3, 4, 5, (1 << 24) + 1, (1 << 24) + 3})).remarks,
              ElementsAre(HasSubstr("2 of 8 voxels have more digits than a float holds")));
  EXPECT_THAT(load("type: double\nendian: little\n", bytes_of<double>({0, 1, 2, 3, 4, 5, 0.5, 0.1})).remarks,
              ElementsAre(HasSubstr("1 of 8 voxels have more digits than a float holds")));
  EXPECT_THAT(load("type: longlong\nendian: little\n", bytes_of<std::int64_t>({0, 1, 2, 3, 4, -5, 6, 7})).voxels,
              ElementsAre(0, 1, 2, 3, 4, -5, 6, 7));
}

TEST_F(Nrrd, SpacingFromEitherField) {
  EXPECT_EQ(load("spacings: 0.5 1 2.5\n", "12345678").spacing, glm::dvec3(0.5, 1, 2.5));
  EXPECT_EQ(load("", "12345678").spacing, glm::dvec3(1.0));
  const Volume odd = load("spacings: nan 0 -2\n", "12345678");
  EXPECT_EQ(odd.spacing, glm::dvec3(1, 1, 2));
  EXPECT_THAT(odd.remarks,
              ElementsAre(HasSubstr("axis 1 is nan, which is not a length: 1 mm"), HasSubstr("axis 2 is 0"),
                          HasSubstr("axis 3 is -2, which is not a length: 2 mm")));
  EXPECT_EQ(load("space dimension: 3\nspace directions: (3,4,0) (0,0,2) (0,0.5,0)\n", "12345678").spacing,
            glm::dvec3(5, 2, 0.5));
}

TEST_F(Nrrd, AnatomicalAxesAreTurnedToRightAnteriorSuperior) {
  const std::string data = "\x01\x02\x03\x04\x05\x06\x07\x08";  // 1 at (0,0,0), x fastest
  const std::string straight = "space directions: (1,0,0) (0,1,0) (0,0,2)\n";
  EXPECT_THAT(load("space: right-anterior-superior\n" + straight, data).voxels, ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
  // +x is left, +y posterior: both are flipped.
  EXPECT_THAT(load("space: left-posterior-superior\n" + straight, data).voxels, ElementsAre(4, 3, 2, 1, 8, 7, 6, 5));
  // The fastest axis runs upwards, the slowest to the right.
  const Volume sagittal = load("space: RAS\nspace directions: (0,0,3) (0,1,0) (2,0,0)\n", data);
  EXPECT_THAT(sagittal.voxels, ElementsAre(1, 5, 3, 7, 2, 6, 4, 8));
  EXPECT_EQ(sagittal.spacing, glm::dvec3(2, 1, 3));
  // Spaces that are not a body's stay unchanged.
  EXPECT_THAT(load("space: scanner-xyz\nspace directions: (-1,0,0) (0,1,0) (0,0,2)\n", data).voxels,
              ElementsAre(1, 2, 3, 4, 5, 6, 7, 8));
}

TEST_F(Nrrd, AxesOfOneAreDropped) {
  EXPECT_EQ(load("dimension: 4\nsizes: 1 2 2 2\n", "12345678").dims, glm::ivec3(2));
  EXPECT_EQ(load("dimension: 5\nsizes: 2 2 2 1 1\nspacings: 1 2 3 nan nan\n", "12345678").spacing, glm::dvec3(1, 2, 3));
  EXPECT_EQ(load("sizes: 8 1 1\n", "12345678").dims, glm::ivec3(8, 1, 1));
  EXPECT_THAT(refused("dimension: 4\nsizes: 3 2 2 2\n"), HasSubstr("one scalar per voxel"));
  EXPECT_THAT(refused("dimension: 2\nsizes: 4 2\n"), HasSubstr("3 axes"));
}

TEST_F(Nrrd, DetachedData) {
  const auto nhdr = [&](const std::string& lines) { return write("v.nhdr", header(lines, false)).string(); };
  write("v.raw", "xx12345678");
  EXPECT_EQ(load_volume(nhdr("data file: v.raw\nbyte skip: 2\n")).at(0, 0, 0), '1');
  EXPECT_EQ(load_volume(nhdr("datafile: ./v.raw\nbyte skip: -1\n")).at(0, 0, 0), '1');
  fs::create_directory(folder_ / "sub");
  write("sub/v.gz", gzip("12345678"));
  EXPECT_EQ(load_volume(nhdr("encoding: gzip\ndata file: sub/v.gz\n")).at(1, 1, 1), '8');
}

TEST_F(Nrrd, DetachedDataMustStayInTheirFolder) {
  const fs::path inside = folder_ / "inside";
  fs::create_directory(inside);
  write("secret.raw", "12345678");
  const auto message = [&](const std::string& name) {
    std::ofstream(inside / "v.nhdr") << header("data file: " + name + "\n", false);
    return refusal([&] { load_volume((inside / "v.nhdr").string()); });
  };
  EXPECT_THAT(message("../secret.raw"), HasSubstr("must be in the header's folder"));
  EXPECT_THAT(message("sub/../../secret.raw"), HasSubstr("must be in the header's folder"));
  EXPECT_THAT(message((folder_ / "secret.raw").string()), HasSubstr("must be in the header's folder"));
  EXPECT_THAT(message("/etc/passwd"), HasSubstr("must be in the header's folder"));
  fs::create_symlink(folder_ / "secret.raw", inside / "link.raw");
  EXPECT_THAT(message("link.raw"), HasSubstr("link to outside"));
  fs::create_directory_symlink(folder_, inside / "up");
  EXPECT_THAT(message("up/secret.raw"), HasSubstr("link to outside"));
  EXPECT_THAT(message("missing.raw"), HasSubstr("no such file"));
  EXPECT_THAT(message("LIST"), HasSubstr("invalid length"));
  EXPECT_THAT(message("LIST\n../secret.raw"), HasSubstr("v.nhdr:7: the data file must be in the header's folder"));
  EXPECT_THAT(message("slice%03d.raw 1 2 1"), HasSubstr("slice001.raw: no such file"));
  EXPECT_THAT(message("slice%03d.raw 1 2 0"), HasSubstr("describe no files"));
  EXPECT_THAT(message("slice%03d.raw 1 -2 1"), HasSubstr("describe no files"));
  EXPECT_THAT(message("slice%03d.raw 5 4 3"), HasSubstr("describe no files"));
  EXPECT_THAT(message("slice%03d.raw -2147483648 2147483647 1"), HasSubstr("describe no files"));
  EXPECT_THAT(message("slice%05.raw 1 2 1"), HasSubstr("slice%05.raw 1 2 1: no such file"));
  EXPECT_THAT(message(std::string(900'000, 'a') + "%d.raw 1 2 1"), HasSubstr("File name too long"));
  EXPECT_THAT(message("../s%d.raw 1 2 1"), HasSubstr("must be in the header's folder"));
  EXPECT_THAT(message("."), HasSubstr("directory"));
  EXPECT_THAT(message(""), HasSubstr("header's folder"));
}

TEST_F(Nrrd, SizesAreCheckedBeforeAnythingIsAllocated) {
  EXPECT_THAT(refused("sizes: 100000000000000000000000000000000000000000000000000000 2 2\n"),
              HasSubstr("invalid size"));
  EXPECT_THAT(refused("sizes: 18446744073709551615 18446744073709551615 2\n"), HasSubstr("invalid number of voxels"));
  EXPECT_THAT(refused("sizes: 65535 65535 65535\n"), HasSubstr("too many voxels"));
  EXPECT_THAT(refused("sizes: 65535 32768 1\n"), HasSubstr("declares more than the file holds"));
  EXPECT_THAT(refused("sizes: 2 2 3\n"), HasSubstr("expected 12 bytes for 2 x 2 x 3 voxels, got 8 bytes"));
  EXPECT_THAT(refused("encoding: gzip\nsizes: 1000 1000 1000\n", gzip("12345678")),
              HasSubstr("declares more than the file holds"));
  EXPECT_THAT(refused("sizes: 2 0 2\n"), HasSubstr("invalid number of voxels"));
  EXPECT_THAT(refused("sizes: 2 -2 2\n"), HasSubstr("invalid size"));
  EXPECT_THAT(refused("sizes: 2 2\n"), HasSubstr("disagree"));
  EXPECT_THAT(refused("sizes: 2 2 2 2\n"), HasSubstr("disagree"));
  EXPECT_THAT(refused("dimension: 4294967297\n"), HasSubstr("dimension"));
  EXPECT_THAT(refused("byte skip: 18446744073709551615\n"), HasSubstr("exceeds the end"));
  EXPECT_THAT(refused("byte skip: 1\n"), HasSubstr("declares more"));
}

TEST_F(Nrrd, DamagedGzipIsNamed) {
  std::string noise(4096, '\0');
  unsigned state = 1;
  for (char& c : noise) c = static_cast<char>((state = state * 1664525u + 1013904223u) >> 24);
  const std::string lines = "encoding: gzip\nsizes: 16 16 16\n";
  const std::string good = gzip(noise);
  EXPECT_EQ(load(lines, good).voxels.size(), 4096u);
  EXPECT_THAT(refused(lines, good.substr(0, good.size() / 2)), HasSubstr("truncated"));
  EXPECT_THAT(refused(lines, good.substr(0, good.size() - 5)),
              HasSubstr("truncated"));  // all voxels are there, the checksum is not
  std::string flipped = good;
  flipped[good.size() - 6] = static_cast<char>(flipped[good.size() - 6] ^ 1);  // in the checksum
  EXPECT_THAT(refused(lines, flipped), HasSubstr("corrupt"));
  EXPECT_THAT(refused(lines, "this is not gzip data at all....."), HasSubstr("corrupt"));
  EXPECT_THAT(refused("encoding: gzip\nsizes: 16 16 17\n", good), HasSubstr("ends early"));
}

TEST_F(Nrrd, NotFiniteIsRefusedWithCountAndPlace) {
  const std::string lines = "type: float\nendian: little\n";
  EXPECT_THAT(refused(lines, bytes_of<float>({0, 1, 2, NAN, 4, INFINITY, 6, 7})),
              HasSubstr("2 of 8 voxels are not finite numbers (got nan first, at voxel (1, 1, 0))"));
  EXPECT_THAT(refused("type: double\nendian: little\n", bytes_of<double>({0, 1, 2, 3, 4, 1e39, 6, 7})),
              HasSubstr("1 of 8 voxels are too large for a float (got 1e+39 first, at voxel (1, 0, 1))"));
}

TEST_F(Nrrd, DamagedHeadersAreNamed) {
  EXPECT_THAT(refused("encoding: lzma\n"), HasSubstr("raw, gzip, bzip2, hex or ascii"));
  EXPECT_THAT(refused("type: block\nblock size: 1\n"), HasSubstr("v.nrrd"));
  EXPECT_THAT(refused("type: banana\n"), HasSubstr("banana"));
  EXPECT_THAT(refused("type: int16\n"), HasSubstr("no 'endian'"));
  EXPECT_THAT(refused("type: int16\nendian: middle\n"), HasSubstr("little or big"));
  EXPECT_THAT(refused("spacings: 1 1\n"), HasSubstr("v.nrrd:6: the number of values differs from the number of axes"));
  EXPECT_THAT(refused("sizes: 2 2 2\nsizes: 2 2 2\n"), HasSubstr("given twice"));
  EXPECT_THAT(refused("line skip: 1\n"), HasSubstr("fewer lines"));
  EXPECT_THAT(refused("no colon here\n"), HasSubstr("v.nrrd:6"));
  EXPECT_THAT(refused(std::string("content: a\0b\n", 13)), HasSubstr("binary data"));
  EXPECT_NO_THROW(load("# a comment\nkey:=value\ncontent: anything\n", "12345678"));
  const auto path = write("cut.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n");
  EXPECT_THAT(refusal([&] { load_volume(path.string()); }), HasSubstr("does not end"));
  EXPECT_THAT(refusal([&] { load_volume(write("x.nrrd", "NRRD0004").string()); }), HasSubstr("no 'dimension'"));
  EXPECT_THAT(refusal([&] { load_volume(write("x.nrrd", "NRRD0004\n" + std::string(2000000, 'x')).string()); }),
              HasSubstr("x.nrrd"));
}

}  // namespace
}  // namespace fastsplat::volume
