// SPDX-License-Identifier: Apache-2.0
// Missing, truncated, corrupt and lying files: exit 3 (unknown names: 2), one line with the fix, no crash, nothing
// written.
#include <gtest/gtest.h>

#include "tests/process/process_helper.hpp"

namespace fastsplat::cli_test {
namespace {

// The arguments for the program, by the kind of file that it expects.
std::vector<std::string> reader_of(const std::string& kind, const std::string& path, const TempFolder& folder) {
  if (kind == "volume") return {"render", "--volume", path, "--size", "8", "-o", folder / "out.exr"};
  if (kind == "scene") return {"render", "--scene", path, "--size", "8", "-o", folder / "out.exr"};
  if (kind == "tf") return {"render", "--volume", "shells:8", "--tf", path, "--size", "8", "-o", folder / "out.exr"};
  if (kind == "config") {
    return {"render", "--volume", "shells:8", "--engine", "cmodel",          "--config",
            path,     "--size",   "8",        "-o",       folder / "out.exr"};
  }
  if (kind == "stream") return {"stream", "replay", path, "-o", folder / "out.exr"};
  return {"compare", path, path, "--map", folder / "out.png"};  // image
}

void expect_refused(const std::string& kind, const std::string& path, const TempFolder& folder,
                    const std::vector<std::string>& said, int code = 3) {
  SCOPED_TRACE(kind + " " + path);
  const auto before = folder.entries();
  expect_error(fastsplat(reader_of(kind, path, folder)), code, said);
  EXPECT_EQ(folder.entries(), before) << "files appeared or vanished";
}

const std::vector<std::string> kKinds{"volume", "scene", "tf", "config", "stream", "image"};
const std::vector<std::string> kNames{"in.nrrd", "in.toml", "in.toml", "in.toml", "in.fss", "in.exr"};

TEST(BadInput, MissingFiles) {
  const TempFolder folder;
  for (std::size_t i = 0; i < kKinds.size(); ++i) expect_refused(kKinds[i], folder / kNames[i], folder, {kNames[i]});
}

TEST(BadInput, DirectoriesInPlaceOfFiles) {
  const TempFolder folder;
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    std::filesystem::create_directory(folder / kNames[i]);
    expect_refused(kKinds[i], folder / kNames[i], folder, {kNames[i], "directory"});
    std::filesystem::remove(folder / kNames[i]);
  }
}

TEST(BadInput, EmptyFiles) {
  const TempFolder folder;
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    if (kKinds[i] == "scene") continue;  // an empty scene.toml is valid: all defaults
    folder.write(kNames[i], "");
    expect_refused(kKinds[i], folder / kNames[i], folder, {kNames[i]});
  }
  expect_refused("volume", folder.write("in.nii", ""), folder, {"in.nii"});
  expect_refused("volume", folder.write("in.nii.gz", ""), folder, {"in.nii.gz"});
  expect_refused("image", folder.write("in.png", ""), folder, {"in.png"});
  expect_refused("image", folder.write("in.tif", ""), folder, {"in.tif"});
}

TEST(BadInput, NoiseInPlaceOfFiles) {
  const TempFolder folder;
  std::string noise;
  for (unsigned i = 0, state = 12345; i < 3000; ++i) {
    state = state * 1664525u + 1013904223u;
    noise += static_cast<char>(state >> 24);
  }
  for (std::size_t i = 0; i < kKinds.size(); ++i) {
    expect_refused(kKinds[i], folder.write(kNames[i], noise), folder, {kNames[i]});
  }
  for (const std::string name : {"in.nii", "in.nii.gz", "in.nhdr"})
    expect_refused("volume", folder.write(name, noise), folder, {name});
  for (const std::string name : {"in.png", "in.tif"})
    expect_refused("image", folder.write(name, noise), folder, {name});
}

// Every kind of binary file, made by the program, cut in its header, in its middle and before its last byte.
TEST(BadInput, TruncatedFiles) {
  const TempFolder folder;
  const auto make = [&](const std::vector<std::string>& arguments) { expect_success(fastsplat(arguments)); };
  for (const std::string name : {"whole.nrrd", "whole.nii", "whole.nii.gz"})
    make({"volume", "convert", "shells:8", folder / name});
  make({"render", "--volume", "shells:8", "--size", "24", "-o", folder / "whole.exr", "-o", folder / "whole.png", "-o",
        folder / "whole.tif"});
  make({"stream", "record", "--volume", "shells:8", "--size", "24", "-o", folder / "whole.fss"});
  int cut = 0;
  for (const std::string name :
       {"whole.nrrd", "whole.nii", "whole.nii.gz", "whole.exr", "whole.png", "whole.tif", "whole.fss"}) {
    const auto bytes = read_bytes(folder / name);
    ASSERT_GT(bytes.size(), 100u) << name;
    const std::string kind = name.ends_with(".fss")                 ? "stream"
                             : name.find(".n") != std::string::npos ? "volume"
                                                                    : "image";
    for (const std::size_t length : {std::size_t{1}, std::size_t{20}, bytes.size() / 2, bytes.size() - 1}) {
      // The last byte of a PNG or TIFF may be padding of a chunk that readers skip; a file that still reads is valid.
      if (length + 1 == bytes.size() && kind == "image") continue;
      const auto path = folder.write("cut" + name.substr(5), bytes.substr(0, length));
      expect_refused(kind, path, folder, {"cut"});
      ++cut;
    }
  }
  std::printf("[figure] truncated_files = %d (limit > 0)\n", cut);
  ASSERT_GT(cut, 20);
}

TEST(BadInput, AVolumeOf1e53VoxelsIsRefusedBeforeAnyAllocation) {
  const TempFolder folder;
  const auto path = folder.write(
      "huge.nrrd",
      "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 464158883361277889 464158883361277889 464158883361277889\n"
      "encoding: raw\n\nabc");
  expect_refused("volume", path, folder, {"huge.nrrd"});
}

TEST(BadInput, HeadersThatDeclareMoreThanTheFileHolds) {
  const TempFolder folder;
  expect_refused(
      "volume", folder.write("a.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 100 100 100\nencoding: raw\n\nabc"),
      folder, {"a.nrrd"});
  expect_refused("volume",
                 folder.write("b.nrrd", "NRRD0004\ntype: uint8\ndimension: 3\nsizes: -4 4 4\nencoding: raw\n\nabc"),
                 folder, {"b.nrrd"});
  expect_refused(
      "volume",
      folder.write("c.nrrd", "NRRD0004\ntype: nonsense\ndimension: 3\nsizes: 2 2 2\nencoding: raw\n\n01234567"), folder,
      {"c.nrrd"});
  expect_refused(
      "volume",
      folder.write(
          "d.nhdr",
          "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: ../../../etc/passwd\n"),
      folder, {"d.nhdr"});
  expect_success(fastsplat({"volume", "convert", "shells:8", folder / "whole.nii"}));
  auto nifti = read_bytes(folder / "whole.nii");
  for (int axis = 1; axis <= 3; ++axis) {  // dim[1..3], little-endian int16 from byte 42 on
    nifti[static_cast<std::size_t>(40 + 2 * axis)] = '\xff';
    nifti[static_cast<std::size_t>(41 + 2 * axis)] = '\x7f';
  }
  expect_refused("volume", folder.write("lying.nii", nifti), folder, {"lying.nii"});
}

TEST(BadInput, VolumesThatDoNotExistByName) {
  const TempFolder folder;
  expect_refused("volume", "shels:32", folder, {"shells"}, 2);
  expect_refused("volume", "shells:0", folder, {"shells"}, 2);
  expect_refused("volume", "shells:99999", folder, {"1024"}, 2);
  expect_refused("volume", "shells:", folder, {"shells"}, 2);
  expect_refused("volume", "shells:8x", folder, {"shells"}, 2);
}

TEST(BadInput, TomlSaysFileLineAndHint) {
  const TempFolder folder;
  expect_refused("scene", folder.write("a.toml", "volume = \"shells:8\"\nmethod = \n"), folder, {"a.toml:2"});
  expect_refused("scene", folder.write("b.toml", "volume = \"shells:8\"\n\n[camera]\nazimut = 3.0\n"), folder,
                 {"b.toml:4", "did you mean 'azimuth'"});
  expect_refused("scene", folder.write("c.toml", "volume = 5\n"), folder, {"c.toml:1"});
  expect_refused("scene", folder.write("d.toml", "[camera]\nzoom = nan\n"), folder, {"d.toml:2"});
  // Keys that would be ignored; a flag may give or take their meaning.
  const auto idle = folder.write("idle.toml", "volume = \"shells:8\"\n[lens]\naperture = 3\n");
  expect_refused("scene", idle, folder, {"idle.toml:3:", "lens.aperture has no effect", "--depth-of-field splats"});
  const auto exposed = folder.write("exposed.toml", "volume = \"shells:8\"\n[xray]\nexposure = 0.1\n");
  expect_refused("scene", exposed, folder, {"exposed.toml:3:", "xray.exposure does not apply", "--method xray"});
  const std::vector<std::string> quietly{"--size", "8", "--json", "-", "--quiet"};
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--scene", exposed, "--method", "xray"},
                                                {"--scene", "demo:fire", "--splat-texture", "0"}}) {
    std::vector<std::string> all{"render"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), quietly.begin(), quietly.end());
    expect_success(fastsplat(all));
  }
  expect_refused("tf", folder.write("e.toml", "domian = \"value\"\n"), folder, {"e.toml"});
  expect_refused("tf", "mri-haed", folder, {"mri-head"}, 2);
}

TEST(BadInput, ConfigurationsNameKeyAndNumbers) {
  const TempFolder folder;
  const auto whole = fastsplat({"config", "show", "base"}).out;
  ASSERT_GT(whole.size(), 200u);
  const auto edited = [&](const std::string& from, const std::string& to) {
    auto text = whole;
    const auto at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return folder.write("edited.toml", text.replace(at, from.size(), to));
  };
  expect_success(fastsplat({"config", "check", folder.write("same.toml", whole)}));
  expect_refused("config", edited("phases = 64", "phases = 63"), folder, {"phases"});
  // N-2-2: a required key is missing, then a key is unknown.
  expect_refused("config", edited("phases = 64", ""), folder, {"phases", "missing"});
  expect_refused("config", edited("phases = 64", "phasis = 64"), folder, {"did you mean", "phases"});
  expect_refused("config", edited("lanes = 8", "lanes = \"8\""), folder, {"lanes"});
  expect_refused("config", edited("lanes = 8", "lanes = 8000"), folder, {"lanes", "8000"});
  expect_refused("config", "bse", folder, {"did you mean 'base'"}, 2);
}

TEST(BadInput, StreamsThatAreCorruptForeignOrForAnotherDevice) {
  const TempFolder folder;
  expect_success(fastsplat({"stream", "record", "--volume", "shells:8", "--size", "16", "-o", folder / "good.fss"}));
  const auto good = read_bytes(folder / "good.fss");
  expect_refused("stream",
                 folder.write("text.fss", "this is no stream, though it is long enough to hold one header or two\n"),
                 folder, {"text.fss"});
  int flipped = 0;
  for (const std::size_t at : {std::size_t{0}, std::size_t{3}, std::size_t{9}, good.size() / 2, good.size() - 1}) {
    auto bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x55);
    expect_refused("stream", folder.write("flipped.fss", bad), folder, {"flipped.fss"});
    ++flipped;
  }
  ASSERT_EQ(flipped, 5);
  const auto foreign =
      fastsplat({"stream", "replay", folder / "good.fss", "--config", "small", "-o", folder / "out.exr"});
  expect_error(foreign, 3, {"good.fss"});
  expect_refused("stream", folder.write("longer.fss", good + good), folder, {"longer.fss"});
}

TEST(BadInput, ControlCharactersInNamesStayOnOneLine) {
  const TempFolder folder;
  expect_refused("volume", folder / "two\nlines\033[31m.nrrd", folder, {"lines"});
}

}  // namespace
}  // namespace fastsplat::cli_test
