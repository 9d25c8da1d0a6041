// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/foreign_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>
#include <string_view>
#include <vector>

#include "base/lower_case.hpp"
#include "base/read_file.hpp"
#include "base/shell_word.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

struct Format {
  std::size_t at;
  std::string_view magic;
  const char* name;
  const char* way;
};

constexpr std::array<Format, 10> kFormats{
    {{0, "ply\n", "PLY: Gaussians or a mesh", "give 3-D Gaussians with --gaussians"},
     {0, "ply\r\n", "PLY: Gaussians or a mesh", "give 3-D Gaussians with --gaussians"},
     {128, "DICM", "DICOM", "convert the series to one file with dcm2niix -z y FOLDER"},
     {0, "\x89HDF", "HDF5 or MINC 2", "convert it to .nii.gz, for MINC with mnc2nii"},
     {0, "CDF\x01", "MINC 1", "convert it with mnc2nii"},
     {208, "MAP ", "MRC or CCP4", "convert it to .nrrd or .nii.gz"},
     {0, "\x93NUMPY", "a NumPy array", "write it as .nii.gz with nibabel or as .nrrd with pynrrd"},
     {0, "# vtk DataFile", "VTK", "write it as .mha with VTK (vtkMetaImageWriter)"},
     {0, "<?xml", "XML, perhaps from VTK", "write it as .mha with VTK (vtkMetaImageWriter)"},
     {0, "<VTKFile", "VTK", "write it as .mha with VTK (vtkMetaImageWriter)"}}};

const Format* format_of(const fs::path& path) {
  const std::string start = start_of(path, 256);
  const auto* const found = std::find_if(kFormats.begin(), kFormats.end(), [&start](const Format& format) {
    return start.size() > format.at && start.compare(format.at, format.magic.size(), format.magic) == 0;
  });
  return found == kFormats.end() ? nullptr : found;
}

/// Size and type of raw voxels, taken from a file name as open data sets use them.
struct RawName {
  std::string sizes = "X Y Z", type = "uint8";
  bool sized = false;
};

RawName raw_name(const fs::path& path) {
  static const std::regex kSizes(R"((\d{1,5})x(\d{1,5})x(\d{1,5}))");
  static const std::regex kType(R"((u?int(8|16|32)|float(32)?|double))");
  const std::string name = lower_case(path.filename().string());
  RawName raw;
  std::smatch part;
  if (std::regex_search(name, part, kSizes)) {
    raw.sizes = fmt::format("{} {} {}", part[1].str(), part[2].str(), part[3].str());
    raw.sized = true;
  }
  if (std::regex_search(name, part, kType)) raw.type = part[1].str() == "float32" ? "float" : part[1].str();
  return raw;
}

}  // namespace

std::string foreign_format(const fs::path& path) {
  const Format* format = format_of(path);
  return format != nullptr ? format->name : "";
}

std::string way_to_read(const fs::path& path) {
  if (const Format* format = format_of(path)) return format->way;
  const RawName raw = raw_name(path);
  const std::string ending = ending_of(path);
  if (ending == ".toml") return "give a scene with --scene, a transfer function with --tf";
  if (ending == ".img" || path.string().ends_with(".img.gz"))
    return "the voxels of a NIfTI pair need their header: put the .hdr beside it";
  if (!raw.sized && ending != ".raw" && ending != ".bin" && ending != ".dat" && ending != ".vol")
    return "convert it, for example to .nrrd (teem-unu) or .nii.gz";
  std::vector<std::string> lines{"NRRD0004",      "type: " + raw.type,
                                 "dimension: 3",  "sizes: " + raw.sizes,
                                 "encoding: raw", "data file: " + path.filename().string()};
  if (raw.type.find('8') == std::string::npos) lines.insert(lines.begin() + 4, "endian: little");
  std::string command = "printf '%s\\n'";
  for (const auto& line : lines) command += " " + shell_word(line);
  return "if these are raw voxels, write a header: " + command + " > " +
         shell_word(fs::path(path).replace_extension(".nhdr").string());
}

}  // namespace fastsplat::volume
