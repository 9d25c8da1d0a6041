// SPDX-License-Identifier: Apache-2.0
// MetaImage files written by hand: types, byte orders, compressed, text, separate data, axes, and refused ones.
#include <gtest/gtest.h>

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

std::string zlib(const std::string& text) {
  std::ostringstream out;
  write_zlib(out, text.data(), text.size());
  return out.str();
}

class MetaImage : public TemporaryFolder {
 protected:
  /// A header of these lines, with defaults for 2 x 2 x 2 MET_UCHAR, local.
  static std::string header(const std::string& lines) {
    std::string text = "ObjectType = Image\n";
    for (const std::string line : {"NDims = 3", "DimSize = 2 2 2", "ElementType = MET_UCHAR"}) {
      const std::string field = "\n" + line.substr(0, line.find('=') + 1);
      if (("\n" + lines).find(field) == std::string::npos) text += line + "\n";
    }
    const bool ends = lines.find("ElementDataFile") != std::string::npos;
    return text + lines + (ends ? "" : "ElementDataFile = LOCAL\n");
  }
  Volume load(const std::string& lines, const std::string& data = "12345678") const {
    return load_volume(write("v.mha", header(lines) + data).string());
  }
  std::string refused(const std::string& lines, const std::string& data = "12345678") const {
    const auto path = write("v.mha", header(lines) + data);
    const std::string message = refusal([&] { load_volume(path.string()); });
    EXPECT_THAT(message, HasSubstr("v.mha"));
    return message;
  }
};

TEST_F(MetaImage, ReadsTypesByteOrdersPlainAndCompressed) {
  int read = 0;
  for (const bool big : {false, true}) {
    for (const bool packed : {false, true}) {
      const auto values = [&](const std::string& type, const std::string& raw) {
        ++read;
        const std::string size = "CompressedDataSize = " + std::to_string(zlib(raw).size()) + "\n";
        return load("ElementType = MET_" + type + "\nBinaryData = True\nBinaryDataByteOrderMSB = " +
                        (big ? "True" : "False") + "\nCompressedData = " + (packed ? "True\n" + size : "False\n"),
                    packed ? zlib(raw) : raw)
            .voxels;
      };
      EXPECT_THAT(values("SHORT", bytes_of<std::int16_t>({-2, 1, 258, 3, -32768, 32767, 6, 7}, big)),
                  ElementsAre(-2, 1, 258, 3, -32768, 32767, 6, 7));
      EXPECT_THAT(values("USHORT", bytes_of<std::uint16_t>({0, 1, 258, 3, 4, 65535, 6, 7}, big)),
                  ElementsAre(0, 1, 258, 3, 4, 65535, 6, 7));
      EXPECT_THAT(values("CHAR", bytes_of<std::int8_t>({-128, 1, 2, 3, 4, 5, 6, 127}, big)),
                  ElementsAre(-128, 1, 2, 3, 4, 5, 6, 127));
      EXPECT_THAT(values("UCHAR", bytes_of<std::uint8_t>({0, 1, 2, 3, 4, 5, 6, 255}, big)),
                  ElementsAre(0, 1, 2, 3, 4, 5, 6, 255));
      for (const char* type : {"INT", "LONG"}) {
        EXPECT_THAT(values(type, bytes_of<std::int32_t>({-1, 1, 2, 3, 4, 5, 6, 70000}, big)),
                    ElementsAre(-1, 1, 2, 3, 4, 5, 6, 70000));
      }
      EXPECT_THAT(values("FLOAT", bytes_of<float>({0, 1, 0.1f, 3, -4, 5, 6, 7}, big)),
                  ElementsAre(0, 1, 0.1f, 3, -4, 5, 6, 7));
      EXPECT_THAT(values("DOUBLE", bytes_of<double>({0, 1, 0.1, 3, -4, 5, 6, 7}, big)),
                  ElementsAre(0, 1, 0.1f, 3, -4, 5, 6, 7));
    }
  }
  EXPECT_THAT(load("BinaryData = False\nElementType = MET_SHORT\n", "-1 2 3\n4 5 6 7 800").voxels,
              ElementsAre(-1, 2, 3, 4, 5, 6, 7, 800));
  std::printf("[figure] MetaImage types x byte orders x packings read = %d\n", read);
  EXPECT_EQ(read, 32);
}

TEST_F(MetaImage, SpacingAndPlace) {
  EXPECT_EQ(load("ElementSpacing = 0.5 1 2.5\n").spacing, glm::dvec3(0.5, 1, 2.5));
  EXPECT_EQ(load("ElementSize = 3 2 1\n").spacing, glm::dvec3(3, 2, 1));
  EXPECT_EQ(load("").spacing, glm::dvec3(1.0));
  EXPECT_FALSE(load("").placed);
  // ITK's +x is left, +y posterior: both are flipped, and the centre is the body's.
  const Volume plain = load("TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 10 20 30\nElementSpacing = 1 2 4\n");
  EXPECT_THAT(plain.voxels, ElementsAre('4', '3', '2', '1', '8', '7', '6', '5'));
  EXPECT_EQ(plain.centre, glm::dvec3(-10.5, -21, 32));
  EXPECT_FALSE(plain.oblique);
  EXPECT_THAT(load("Rotation = -1 0 0 0 -1 0 0 0 1\nPosition = 0 0 0\n").voxels,
              ElementsAre('1', '2', '3', '4', '5', '6', '7', '8'));
  // The matrix lists the direction of one grid axis after the other: the first axis runs upwards, the last to the left.
  EXPECT_THAT(load("TransformMatrix = 0 0 1 0 1 0 1 0 0\n").voxels,
              ElementsAre('7', '3', '5', '1', '8', '4', '6', '2'));
}

TEST_F(MetaImage, SeparateData) {
  const auto mhd = [&](const std::string& lines) { return write("v.mhd", header(lines)).string(); };
  write("v.raw", "xx12345678");
  EXPECT_EQ(load_volume(mhd("HeaderSize = 2\nElementDataFile = v.raw\n")).at(0, 0, 0), '1');
  EXPECT_EQ(load_volume(mhd("HeaderSize = -1\nElementDataFile = v.raw\n")).at(0, 0, 0), '1');
  write("v.zraw", zlib("12345678"));
  EXPECT_EQ(load_volume(mhd("CompressedData = True\nElementDataFile = v.zraw\n")).at(1, 1, 1), '8');
  const auto message = [&](const std::string& name) {
    return refusal([&] { load_volume(mhd("ElementDataFile = " + name + "\n")); });
  };
  EXPECT_THAT(message("../v.raw"), HasSubstr("must be in the header's folder"));
  EXPECT_THAT(message("/etc/passwd"), HasSubstr("must be in the header's folder"));
  EXPECT_THAT(message("LIST"), HasSubstr("invalid length"));
  EXPECT_THAT(message("slice%03d.raw 1 9 1"), HasSubstr("does not match the sizes (expected 2 files, got 9)"));
  EXPECT_THAT(message("missing.raw"), HasSubstr("no such file"));
  EXPECT_THAT(refusal([&] { load_volume(mhd("HeaderSize = 99\nElementDataFile = v.raw\n")); }),
              HasSubstr("declares more"));
}

// MetaIO inflates gzip too, and takes any field first; programs write private fields.
TEST_F(MetaImage, ReadsTheSameFilesAsMetaIo) {
  EXPECT_EQ(load("CompressedData = True\n", gzip("12345678")).voxels, load("", "12345678").voxels);
  const std::string rest = "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n12345678";
  for (const char* first : {"Modality = MET_MOD_CT\n", "0008|0060 = CT\n", "ITK_InputFilterName = NrrdImageIO\n"})
    EXPECT_EQ(load_volume(write("first.mha", first + rest).string()).dims, glm::ivec3(2)) << first;
  EXPECT_THAT(load("ElementType = MET_LONG_LONG\n", bytes_of<std::int64_t>({0, 1, 2, 3, 4, -5, 6, 70000})).voxels,
              ElementsAre(0, 1, 2, 3, 4, -5, 6, 70000));
}

TEST_F(MetaImage, MisspeltFieldsAreRefusedWithTheNearest) {
  for (const auto& [line, meant] : {std::pair{"ElementSpacng = 2 3 4\n", "ElementSpacing"},
                                    {"elementspacing = 2 3 4\n", "ElementSpacing"},
                                    {"TransformMatrx = 1 0 0 0 1 0 0 0 1\n", "TransformMatrix"},
                                    {"BinaryDataByteOrderMBS = True\n", "BinaryDataByteOrderMSB"}})
    EXPECT_THAT(refused(line), HasSubstr(std::string("did you mean '") + meant + "'"));
}

TEST_F(MetaImage, UnitsAndOddSpacingsAreFollowed) {
  const Volume microns = load("DistanceUnits = um\nElementSpacing = 500 1000 2000\nOffset = -1000 -2000 4000\n");
  EXPECT_EQ(microns.spacing, glm::dvec3(0.5, 1, 2));
  EXPECT_EQ(microns.centre, load("ElementSpacing = 0.5 1 2\nOffset = -1 -2 4\n").centre);
  EXPECT_THAT(load("DistanceUnits = ell\n").remarks, ElementsAre(HasSubstr("'ell' is unknown: mm is used")));
  const Volume odd = load("ElementSpacing = 0 nan -2\n");
  EXPECT_EQ(odd.spacing, glm::dvec3(1, 1, 2));
  EXPECT_THAT(odd.remarks,
              ElementsAre(HasSubstr("axis 1 is 0, which is not a length: 1 mm"), HasSubstr("axis 2 is nan"),
                          HasSubstr("axis 3 is -2, which is not a length: 2 mm")));
  EXPECT_THAT(load("AnatomicalOrientation = LPS\n").remarks, ElementsAre(HasSubstr("LPS has no TransformMatrix")));
  EXPECT_THAT(load("AnatomicalOrientation = RAI\n").remarks, ElementsAre());
}

TEST_F(MetaImage, EachFieldIsFollowedRefusedOrReported) {
  // MetaIO's own readings: ImagePosition is an offset, HeaderSize counts from the file's beginning.
  EXPECT_EQ(load("ImagePosition = 10 20 30\n").centre, load("Offset = 10 20 30\n").centre);
  EXPECT_TRUE(load("ImagePosition = 10 20 30\n").placed);
  EXPECT_THAT(load("HeaderSize = -1\n", "X12345678").voxels, ElementsAre('1', '2', '3', '4', '5', '6', '7', '8'));
  EXPECT_THAT(refused("HeaderSize = 3\n"), HasSubstr("the voxels would begin inside the header"));
  EXPECT_THAT(refused("HeaderSizePerSlice = 1\n"), HasSubstr("HeaderSizePerSlice is not supported"));
  EXPECT_THAT(refused("Spacing = 2 3 4\n"), HasSubstr("did you mean 'ElementSpacing'?"));
  EXPECT_THAT(refused("Offset = 1 2 3\nPosition = 1 2 4\n"), HasSubstr("v.mha:6: 'Position' contradicts line 5"));
  EXPECT_EQ(load("Offset = 1 2 3\nOrigin = 1  2 3\n").centre, load("Offset = 1 2 3\n").centre);
  EXPECT_THAT(load("ElementOrigin = 1 2 3\nElementDirection = -1 0 0 0 1 0 0 0 1\n").remarks,
              ElementsAre(HasSubstr("ElementOrigin 1 2 3 is not applied"), HasSubstr("ElementDirection -1 0 0")));
  EXPECT_THAT(load("Size = 3\nDirection = up\n").remarks, ElementsAre());  // a private field
}

TEST_F(MetaImage, DataInSeveralFiles) {
  write("a.raw", "x1234");
  write("b.raw", "x5678");
  const auto mhd = [&](const std::string& lines) { return load_volume(write("v.mhd", header(lines)).string()); };
  EXPECT_EQ(mhd("HeaderSize = 1\nElementDataFile = LIST\na.raw\nb.raw\n").voxels, load("").voxels);
  EXPECT_EQ(mhd("HeaderSize = -1\nElementDataFile = LIST 2D\na.raw\nb.raw\n").voxels, load("").voxels);
  write("s7.raw", "1234");
  write("s5.raw", "5678");
  EXPECT_EQ(mhd("ElementDataFile = s%d.raw 7 5 -2\n").voxels, load("").voxels);
}

TEST_F(MetaImage, RefusesFilesThatAreNotVolumes) {
  EXPECT_THAT(refused("ElementNumberOfChannels = 3\n"), HasSubstr("one scalar per voxel"));
  EXPECT_THAT(refused("NDims = 2\nDimSize = 4 2\n"), HasSubstr("3 dimensions"));
  EXPECT_THAT(refused("NDims = 4\nDimSize = 2 2 1 2\n"), HasSubstr("one scalar per voxel"));
  EXPECT_EQ(load("NDims = 4\nDimSize = 2 2 2 1\nElementSpacing = 1 2 3 4\n").spacing, glm::dvec3(1, 2, 3));
  EXPECT_THAT(refused("ElementType = MET_UCHAR_ARRAY\n"), HasSubstr("voxel type"));
  EXPECT_THAT(refused("DimSize = 2 2\n"), HasSubstr("disagree"));
  EXPECT_THAT(refused("DimSize = 2 -2 2\n"), HasSubstr("invalid size"));
  EXPECT_THAT(refused("DimSize = 2 0 2\n"), HasSubstr("invalid number of voxels"));
  EXPECT_THAT(refused("DimSize = 65535 65535 65535\n"), HasSubstr("too many voxels"));
  EXPECT_THAT(refused("DimSize = 2 2 3\n"), HasSubstr("expected 12 bytes for 2 x 2 x 3 voxels, got 8 bytes"));
  EXPECT_THAT(refused("CompressedData = True\nDimSize = 1000 1000 1000\n", zlib("12345678")),
              HasSubstr("declares more than the file holds"));
  EXPECT_THAT(refused("NDims = 99\n"), HasSubstr("number of dimensions"));
  EXPECT_THAT(refused("ElementSpacing = 1 1\n"), HasSubstr("number of values"));
  EXPECT_THAT(refused("ElementSpacing = 1 x 1\n"), HasSubstr("invalid number"));
  EXPECT_THAT(refused("Offset = 1 nan 1\n"), HasSubstr("finite number"));
  EXPECT_THAT(refused("TransformMatrix = 1 0 0 1 0 0 0 0 1\n"), HasSubstr("not independent"));
  EXPECT_THAT(refused("BinaryData = Perhaps\n"), HasSubstr("True or False"));
  EXPECT_THAT(refused("ElementToIntensityFunctionSlope = 2\n"), HasSubstr("not supported"));
  EXPECT_NO_THROW(
      load("ElementToIntensityFunctionSlope = 1\nElementToIntensityFunctionOffset = 0\nModality = MET_MOD_CT\n"));
  EXPECT_THAT(refused("DimSize = 2 2 2\nDimSize = 2 2 2\n"), HasSubstr("given twice"));
  EXPECT_THAT(refused("no equals sign\n"), HasSubstr("v.mha:5"));
  EXPECT_THAT(refused("CompressedData = True\n", zlib("12345678").substr(0, 12)), HasSubstr("truncated"));
  EXPECT_THAT(refused("CompressedData = True\n", "this is not zlib data"), HasSubstr("corrupt"));
  EXPECT_THAT(refused("BinaryData = False\n", "1 2 3 x 5 6 7 8"), HasSubstr("not a number"));
  EXPECT_THAT(refusal([&] { load_volume(write("c.mha", "ObjectType = Image\nNDims = 3\n").string()); }),
              HasSubstr("does not end"));
  EXPECT_THAT(
      refusal([&] { load_volume(write("t.mha", "ObjectType = Tube\nNDims = 3\nElementDataFile = LOCAL\n").string()); }),
      HasSubstr("not an image"));
}

}  // namespace
}  // namespace fastsplat::volume
