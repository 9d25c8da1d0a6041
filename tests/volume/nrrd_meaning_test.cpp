// SPDX-License-Identifier: Apache-2.0
// Meaning of the fields of NRRD headers: kinds, placement, units, min and max, several files, skipped bytes, unknown
// fields.
#include <gtest/gtest.h>

#include <sstream>

#include "scene/volume/byte_reader.hpp"
#include "scene/volume/volume_file.hpp"
#include "tests/volume/volume_testing.hpp"

namespace fastsplat::volume {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class NrrdMeaning : public TemporaryFolder {
 protected:
  /// uint8, raw; as many voxels as the largest test needs, 0, 1, 2...
  Volume load(const std::string& lines) const {
    return load_volume(write("v.nrrd", "NRRD0005\ntype: uint8\nencoding: raw\n" + lines + "\n" + voxels()).string());
  }
  std::string refused(const std::string& lines) const {
    return refusal([&] { load(lines); });
  }
  static std::string voxels() {
    std::string bytes(24, '\0');
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i);
    return bytes;
  }
};

TEST_F(NrrdMeaning, AxesThatAreNotOfSpaceAreNotTheVolumes) {
  const std::string four = "dimension: 4\nsizes: ", three = "dimension: 3\nsizes: ";
  EXPECT_EQ(load(four + "1 4 6 1\nkinds: list domain domain domain\n").dims, glm::ivec3(4, 6, 1));
  EXPECT_EQ(load(four + "4 6 1 1\nkinds: space space space time\n").dims, glm::ivec3(4, 6, 1));
  EXPECT_EQ(load(four + "1 4 1 3\nkinds: time space space space\n").dims, glm::ivec3(4, 1, 3));
  EXPECT_EQ(load(four + "1 4 1 3\nkinds: scalar space space space\n").dims, glm::ivec3(4, 1, 3));
  EXPECT_EQ(load(four + "1 4 3 1\nspace: RAS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\n").dims,
            glm::ivec3(4, 3, 1));
  int refusals = 0;
  for (const auto& lines :
       {three + "3 4 2\nkinds: RGB-color domain domain\n", three + "4 3 2\nkinds: space space time\n",
        three + "2 3 4\nkinds: complex space space\n", three + "2 3 4\nkinds: vector space space\n",
        three + "1 3 4\nkinds: list domain domain\n", four + "2 4 3 1\nkinds: time space space space\n",
        three + "3 4 2\nspace: RAS\nspace directions: none (1,0,0) (0,1,0)\n",
        three + "4 3 2\nspace: RAS\nspace directions: (1,0,0) (0,1,0) none\n"}) {
    EXPECT_THAT(refused(lines), HasSubstr("not a volume of one scalar per voxel")) << lines;
    ++refusals;
  }
  std::printf("[figure] headers of colours and films refused = %d\n", refusals);
}

TEST_F(NrrdMeaning, AnAxisAlongTimeAloneIsNotTheVolumes) {
  const Volume volume =
      load("dimension: 4\nspace: LPST\nsizes: 1 4 3 1\nspace directions: (0,0,0,1) (2,0,0,0) (0,3,0,0) (0,0,4,0)\n");
  EXPECT_EQ(volume.dims, glm::ivec3(4, 3, 1));
  EXPECT_EQ(volume.spacing, glm::dvec3(2, 3, 4));
  EXPECT_TRUE(volume.placed);
  EXPECT_THAT(volume.remarks, ElementsAre(HasSubstr("12 bytes more than needed for 4 x 3 x 1 voxels")));
}

TEST_F(NrrdMeaning, MissingPartsOfASpaceAreReported) {
  const auto remarks = [&](const std::string& lines) { return load("dimension: 3\nsizes: 4 3 2\n" + lines).remarks; };
  const std::string diagonal = "space directions: (2,0,0) (0,3,0) (0,0,4)\n";
  EXPECT_THAT(remarks("space: LPS\nspacings: 2 3 4\nspace origin: (1,2,3)\n"),
              ElementsAre(HasSubstr("the header's space has no space directions")));
  EXPECT_THAT(remarks("space dimension: 2\nspace directions: (2,0) (0,3) (1,1)\n"),
              ElementsAre(HasSubstr("the header's space has 2 dimensions")));
  EXPECT_THAT(remarks("space: 3D-left-handed\n" + diagonal), ElementsAre(HasSubstr("not anatomical")));
  EXPECT_THAT(remarks("space: scanner-xyz\n" + diagonal + "space origin: (1,2,3)\n"),
              ElementsAre(HasSubstr("not anatomical")));
  EXPECT_THAT(remarks("space: scanner-xyz\n" + diagonal), ElementsAre());
  EXPECT_THAT(remarks("space: LPS\n" + diagonal + "space origin: (nan,nan,nan)\n"),
              ElementsAre(HasSubstr("the header's space origin is not a place")));
  EXPECT_THAT(
      load("dimension: 3\nspace: LPST\nsizes: 4 3 2\nspace directions: (2,0,0,9) (0,3,0,0) (0,0,4,0)\n").remarks,
      ElementsAre(HasSubstr("the direction of axis 1 has a part along time")));
}

TEST_F(NrrdMeaning, ASpacingBesideADirectionSaysTheSame) {
  const std::string lines = "dimension: 3\nsizes: 4 3 2\nspace: LPS\nspace directions: (2,0,0) (0,3,0) (0,0,4)\n";
  EXPECT_EQ(load(lines + "spacings: 2 3 nan\n").spacing, glm::dvec3(2, 3, 4));
  EXPECT_EQ(load(lines + "spacings: 2 3 4\nspace units: \"cm\" \"cm\" \"cm\"\n").spacing, glm::dvec3(20, 30, 40));
  EXPECT_THAT(refused(lines + "spacings: 2 9 4\n"),
              HasSubstr("v.nrrd:8: axis 2 has a spacing and a space direction of another length (expected 3"));
}

TEST_F(NrrdMeaning, FilesThatTeemRefusesAreRefused) {
  EXPECT_THAT(refused("dimension: 3\nsizes: 4 3 2\nkinds: domain domian domain\n"),
              HasSubstr("v.nrrd:6: not a valid NRRD header: 'kinds': couldn't parse"));
}

TEST_F(NrrdMeaning, SpacesWithTimePlaceAsThoseWithout) {
  int compared = 0;
  for (const std::string space : {"left-posterior-superior", "right-anterior-superior", "left-anterior-superior"}) {
    const Volume with = load("dimension: 4\nspace: " + space +
                             "-time\nsizes: 4 3 2 1\nspace directions: (2,0,0,0) "
                             "(0,3,0,0) (0,0,4,0) (0,0,0,1)\nspace origin: (-7,5,11,0)\n");
    const Volume without = load("dimension: 3\nspace: " + space +
                                "\nsizes: 4 3 2\nspace directions: (2,0,0) (0,3,0) "
                                "(0,0,4)\nspace origin: (-7,5,11)\n");
    EXPECT_TRUE(with.placed);
    EXPECT_EQ(with.voxels, without.voxels);
    EXPECT_EQ(with.centre, without.centre);
    EXPECT_EQ(with.spacing, glm::dvec3(2, 3, 4));
    ++compared;
  }
  std::printf("[figure] spaces with time compared = %d\n", compared);
}

TEST_F(NrrdMeaning, APlacementThatIsNotUsedIsReported) {
  const std::string three = "dimension: 3\nsizes: 4 3 2\n";
  EXPECT_THAT(load(three + "space: RAS\nspace directions: (1,0,0) (1,0,0) (0,0,1)\n").remarks,
              ElementsAre(HasSubstr("space directions are not independent")));
  EXPECT_THAT(load(three + "space: scanner-xyz\nspace directions: (-1,0,0) (0,1,0) (0,0,1)\n").remarks,
              ElementsAre(HasSubstr("not anatomical")));
  EXPECT_THAT(load(three + "space dimension: 3\nspace directions: (0,1,0) (1,0,0) (0,0,1)\n").remarks,
              ElementsAre(HasSubstr("not anatomical")));
  EXPECT_THAT(load(three + "space dimension: 3\nspace directions: (2,0,0) (0,1,0) (0,0,1)\n").remarks, ElementsAre());
}

TEST_F(NrrdMeaning, UnitsOfLengthBecomeMillimetres) {
  const std::string three = "dimension: 3\nsizes: 4 3 2\n";
  const Volume mm = load(three + "space: LPS\nspace directions: (2,0,0) (0,3,0) (0,0,4)\nspace origin: (-7,5,11)\n");
  int read = 0;
  for (const auto& [unit, directions, origin] :
       {std::tuple{"um", "(2000,0,0) (0,3000,0) (0,0,4000)", "(-7000,5000,11000)"},
        {"\u00b5m", "(2000,0,0) (0,3000,0) (0,0,4000)", "(-7000,5000,11000)"},
        {"microns", "(2000,0,0) (0,3000,0) (0,0,4000)", "(-7000,5000,11000)"},
        {"cm", "(0.2,0,0) (0,0.3,0) (0,0,0.4)", "(-0.7,0.5,1.1)"},
        {"mm", "(2,0,0) (0,3,0) (0,0,4)", "(-7,5,11)"},
        {"Meters", "(0.002,0,0) (0,0.003,0) (0,0,0.004)", "(-0.007,0.005,0.011)"}}) {
    const std::string quoted = std::string(" \"") + unit + "\"";
    const Volume read_in = load(three + "space: LPS\nspace directions: " + directions + "\nspace origin: " + origin +
                                "\nspace units:" + quoted + quoted + quoted + "\n");
    for (int a = 0; a < 3; ++a) {
      EXPECT_DOUBLE_EQ(read_in.spacing[a], mm.spacing[a]) << unit;
      EXPECT_DOUBLE_EQ(read_in.centre[a], mm.centre[a]) << unit;
    }
    EXPECT_THAT(read_in.remarks, ElementsAre()) << unit;
    ++read;
  }
  std::printf("[figure] units read = %d\n", read);
  EXPECT_EQ(load(three + "spacings: 2000 3 0.4\nunits: \"um\" \"mm\" \"cm\"\n").spacing, glm::dvec3(2, 3, 4));
  EXPECT_THAT(refused(three + "units: \"mm\" \"mm\" \"mm\n"), HasSubstr("'units' has an unpaired quotation mark"));
  const Volume unknown = load(three + "spacings: 2 3 4\nunits: \"ell\" \"mm\" \"\"\n");
  EXPECT_EQ(unknown.spacing, glm::dvec3(2, 3, 4));
  EXPECT_THAT(unknown.remarks, ElementsAre(HasSubstr("unit 'ell' is unknown: mm is used")));
}

TEST_F(NrrdMeaning, AxisMinsAndMaxsGiveSpacings) {
  const std::string axes = "dimension: 3\nsizes: 4 3 2\naxis mins: 0 1 0\naxis maxs: 8 10 8\n";
  EXPECT_EQ(load(axes + "centers: cell cell cell\n").spacing, glm::dvec3(2, 3, 4));
  EXPECT_EQ(load(axes).spacing, glm::dvec3(2, 3, 4));  // cells, as teem takes it
  EXPECT_EQ(load(axes + "centerings: node node node\n").spacing, glm::dvec3(8.0 / 3, 4.5, 8));
  EXPECT_EQ(load(axes + "spacings: 5 6 7\n").spacing, glm::dvec3(5, 6, 7));
  EXPECT_EQ(load("dimension: 3\nsizes: 4 3 2\naxis mins: 0 nan 8\naxis maxs: 8 10 0\n").spacing, glm::dvec3(2, 1, 4));
}

TEST_F(NrrdMeaning, UnknownFieldsAndVersionsAreRefused) {
  const std::string three = "dimension: 3\nsizes: 4 3 2\n";
  EXPECT_THAT(refused(three + "spacing: 2 3 4\n"),
              HasSubstr("v.nrrd:6: unknown field 'spacing'; did you mean 'spacings'?"));
  EXPECT_THAT(refused(three + "space direction: (1,0,0) (0,1,0) (0,0,1)\n"),
              HasSubstr("did you mean 'space directions'?"));
  EXPECT_THAT(refused(three + "banana: 1\n"), HasSubstr("unknown field 'banana'"));
  for (const char* version : {"NRRD1004", "NRRD0006", "NRRD", "NRRD00045"}) {
    const auto path =
        write("x.nrrd", std::string(version) + "\ntype: uint8\nencoding: raw\n" + three + "\n" + voxels());
    EXPECT_THAT(refusal([&] { load_volume(path.string()); }), HasSubstr("x.nrrd:1: unsupported NRRD version"))
        << version;
  }
  // Keys of the user's hold colons; all of teem's fields and spellings are known.
  EXPECT_EQ(load(three +
                 "note:=time: 12:30\ndicom:PatientID:=x\nsizes:=9\n# sizes: 1 1 1\ncontent: a: b\nThicknesses: 1 1 1\n"
                 "sampleunits: \"HU\"\nmeasurement frame: none\nmin: 0\n")
                .dims,
            glm::ivec3(4, 3, 2));
  EXPECT_THAT(load(three + "old min: -1\nold max: 1\n").remarks, ElementsAre(HasSubstr("quantised")));
}

TEST_F(NrrdMeaning, DataInSeveralFiles) {
  const std::string all = voxels(), lines = "dimension: 3\nsizes: 4 3 2\n";
  const Volume whole = load(lines);
  const auto nhdr = [&](const std::string& more, const char* encoding = "raw") {
    return load_volume(
        write("v.nhdr", std::string("NRRD0004\ntype: uint8\nencoding: ") + encoding + "\n" + lines + more).string());
  };
  for (const bool packed : {false, true}) {
    const auto part = [&](const char* name, std::size_t from, std::size_t size) {
      write(name, packed ? gzip(all.substr(from, size)) : all.substr(from, size));
    };
    part("s001.raw", 0, 12), part("s003.raw", 12, 12);
    const char* encoding = packed ? "gzip" : "raw";
    EXPECT_EQ(nhdr("data file: LIST\ns001.raw\ns003.raw\n", encoding).voxels, whole.voxels);
    EXPECT_EQ(nhdr("data file: s%03d.raw 1 3 2\n", encoding).voxels, whole.voxels);
    part("s3.raw", 0, 12), part("s2.raw", 12, 12);
    EXPECT_EQ(nhdr("data file: s%d.raw 3 2 -1 2\n", encoding).voxels, whole.voxels);
  }
  for (int i = 0; i < 6; ++i) write("row" + std::to_string(i), "#\n" + all.substr(4 * static_cast<std::size_t>(i), 4));
  EXPECT_EQ(nhdr("line skip: 1\ndata file: LIST 1\nrow0\nrow1\nrow2\nrow3\nrow4\nrow5\n").voxels, whole.voxels);
  EXPECT_EQ(files_of((folder_ / "v.nhdr").string()).size(), 7U);
  EXPECT_THAT(refusal([&] { nhdr("data file: LIST\nrow0\n"); }), HasSubstr("declares more"));
  EXPECT_THAT(refusal([&] { nhdr("data file: LIST\nrow0\nrow1\nrow2\nrow3\nrow4\n"); }),
              HasSubstr("v.nhdr:6: the number of data files does not match the sizes (expected 2 files, got 5)"));
  EXPECT_THAT(refusal([&] { nhdr("data file: s%03d.raw 1 3 1\n"); }), HasSubstr("expected 2 files, got 3"));
}

TEST_F(NrrdMeaning, LinesAndBytesAreSkipped) {
  const Volume whole = load("dimension: 3\nsizes: 4 3 2\n");
  const std::string all = voxels();
  int read = 0;
  const auto same = [&](const std::string& bytes, const std::string& more) {
    write("v.raw", bytes);
    const auto path = write("v.nhdr", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 3 2\ndata file: v.raw\n" + more);
    EXPECT_EQ(load_volume(path.string()).voxels, whole.voxels) << more;
    ++read;
  };
  same("one\ntwo\n" + all, "encoding: raw\nline skip: 2\n");
  same("one\nxx" + all, "encoding: raw\nline skip: 1\nbyte skip: 2\n");
  same("one\nany" + all, "encoding: raw\nline skip: 1\nbyte skip: -1\n");
  same("line\n" + gzip("xx" + all), "encoding: gzip\nline skip: 1\nbyte skip: 2\n");
  same(gzip(std::string(352, 'h') + all), "encoding: gzip\nbyte skip: -1\n");
  std::printf("[figure] skips read = %d\n", read);
  // More bytes than the sizes need are accepted with a warning: the sizes may be wrong.
  EXPECT_THAT(load("dimension: 3\nsizes: 4 3 1\n").remarks,
              ElementsAre(HasSubstr("12 bytes more than needed for 4 x 3 x 1 voxels")));
  EXPECT_THAT(load("dimension: 3\nsizes: 4 5 1\n").remarks, ElementsAre(HasSubstr("4 bytes more")));
  EXPECT_THAT(whole.remarks, ElementsAre());
}

TEST_F(NrrdMeaning, FilesOfOtherFormatsAreNamed) {
  const auto message = [&](const char* name, const std::string& bytes) {
    return refusal([&] { load_volume(write(name, bytes).string()); });
  };
  EXPECT_THAT(message("a.dcm", std::string(128, '\0') + "DICM"),
              HasSubstr("got DICOM); convert the series to one file with dcm2niix"));
  EXPECT_THAT(message("a.vti", "<VTKFile type=\"ImageData\">"), HasSubstr("got VTK"));
  const std::string raw = message("engine_4x3x2_uint16.raw", voxels() + voxels());
  EXPECT_THAT(raw, HasSubstr("NRRD0004 'type: uint16' 'dimension: 3' 'sizes: 4 3 2' 'endian: little' 'encoding: raw'"));
  // The command in the message makes the file readable.
  const auto command = raw.substr(raw.find("printf"));
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
  EXPECT_EQ(load_volume((folder_ / "engine_4x3x2_uint16.raw").string()).dims, glm::ivec3(4, 3, 2));
  // A name is data there, not a command.
  const std::string odd = message("4x3x2 '; touch broken; '%n.raw", voxels());
  ASSERT_EQ(std::system(("cd " + folder_.string() + " && " + odd.substr(odd.find("printf"))).c_str()), 0) << odd;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "broken"));
  EXPECT_EQ(load_volume((folder_ / "4x3x2 '; touch broken; '%n.raw").string()).dims, glm::ivec3(4, 3, 2));
}

}  // namespace
}  // namespace fastsplat::volume
