// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <nifti1.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/machine_error.hpp"
#include "scene/volume/byte_reader.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little,
              "files are written in the machine's byte order, announced as little");

template <typename T>
std::string packed_as(const Volume& volume, VoxelType type) {
  std::string bytes(volume.voxels.size() * sizeof(T), '\0');
  for (std::size_t i = 0; i < volume.voxels.size(); ++i) {
    const float value = volume.voxels[i];
    if constexpr (!std::is_same_v<T, float>) {
      const bool fits = value == std::floor(value) && value >= static_cast<float>(std::numeric_limits<T>::min()) &&
                        value <= static_cast<float>(std::numeric_limits<T>::max());
      if (!fits) {
        const auto nx = static_cast<std::size_t>(volume.dims.x);
        const auto ny = static_cast<std::size_t>(volume.dims.y);
        throw_input({.where = volume.name,
                     .what = fmt::format("a voxel does not fit into {}", to_string(type)),
                     .expected = fmt::format("whole numbers in {}..{}", std::numeric_limits<T>::min(),
                                             std::numeric_limits<T>::max()),
                     .got = fmt::format("{} at ({}, {}, {})", value, i % nx, i / nx % ny, i / nx / ny),
                     .fix = "write it as float"});
      }
    }
    const T voxel = static_cast<T>(value);
    std::memcpy(&bytes[i * sizeof(T)], &voxel, sizeof(T));
  }
  return bytes;
}

std::string packed(const Volume& volume, VoxelType type) {
  switch (type) {
    case VoxelType::U8:
      return packed_as<std::uint8_t>(volume, type);
    case VoxelType::I8:
      return packed_as<std::int8_t>(volume, type);
    case VoxelType::U16:
      return packed_as<std::uint16_t>(volume, type);
    case VoxelType::I16:
      return packed_as<std::int16_t>(volume, type);
    case VoxelType::F32:
      return packed_as<float>(volume, type);
  }
  return {};
}

void write_whole(const fs::path& path, const std::string& head, const std::string& body, bool compress_head,
                 Packing packing) {
  AtomicFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  if (packing == Packing::Plain) {
    out << head << body;
  } else if (compress_head) {
    const std::string all = head + body;
    write_gzip(out, all.data(), all.size());
  } else {
    out << head;
    write_gzip(out, body.data(), body.size());
  }
  out.close();
  if (!out) {
    throw_machine({.where = path.string(),
                   .what = std::string("cannot write: ") + std::strerror(errno),
                   .expected = {},
                   .got = {},
                   .fix = "choose a writable folder with enough free space"});
  }
  file.commit();
}

/// Step from a voxel to the next along grid axis `a`, mm; in the body's axes if the file declared them.
glm::dvec3 step(const Volume& volume, int a) {
  glm::dvec3 along(0.0);
  along[a] = volume.spacing[a];
  return volume.to_world(along);
}
glm::dvec3 first_voxel(const Volume& volume) { return volume.centre + volume.position(0, 0, 0); }

std::string nrrd_geometry(const Volume& volume) {
  const auto& s = volume.spacing;
  if (!volume.placed && !volume.oblique)
    return fmt::format("spacings: {} {} {}\nunits: \"mm\" \"mm\" \"mm\"\n", s.x, s.y, s.z);
  const auto vector = [](const glm::dvec3& v) { return fmt::format("({},{},{})", v.x, v.y, v.z); };
  return fmt::format(
      "space: right-anterior-superior\nspace directions: {} {} {}\nspace units: \"mm\" \"mm\" \"mm\"\nspace origin: "
      "{}\n",
      vector(step(volume, 0)), vector(step(volume, 1)), vector(step(volume, 2)), vector(first_voxel(volume)));
}

std::string nrrd_header(const Volume& volume, VoxelType type, const std::string& data_file) {
  const auto& d = volume.dims;
  std::string text = fmt::format(
      "NRRD0004\n# written by fastsplat\ntype: {}\ndimension: 3\nsizes: {} {} {}\n{}"
      "endian: little\nencoding: gzip\n",
      to_string(type), d.x, d.y, d.z, nrrd_geometry(volume));
  return text + (data_file.empty() ? "\n" : "data file: " + data_file + "\n");
}

const char* metaimage_type(VoxelType type) {
  switch (type) {
    case VoxelType::U8:
      return "MET_UCHAR";
    case VoxelType::I8:
      return "MET_CHAR";
    case VoxelType::U16:
      return "MET_USHORT";
    case VoxelType::I16:
      return "MET_SHORT";
    case VoxelType::F32:
      return "MET_FLOAT";
  }
  return "";
}

/// ITK's axes are +x left, +y posterior; each row of the matrix is the direction of one grid axis.
std::string metaimage_header(const Volume& volume, VoxelType type, std::size_t packed_size,
                             const std::string& data_file) {
  const auto& d = volume.dims;
  const auto& s = volume.spacing;
  const auto vector = [](const glm::dvec3& ras) {
    // Avoids -0.
    return fmt::format("{} {} {}", 0.0 - ras.x, 0.0 - ras.y, ras.z);
  };
  std::string place;
  if (volume.placed || volume.oblique) {
    for (int a = 0; a < 3; ++a) place += (a > 0 ? " " : "TransformMatrix = ") + vector(volume.axes[a]);
    place += fmt::format("\nOffset = {}\nCenterOfRotation = 0 0 0\n", vector(first_voxel(volume)));
  }
  return fmt::format(
      "ObjectType = Image\nNDims = 3\nComment = written by fastsplat\nBinaryData = True\nBinaryDataByteOrderMSB = "
      "False\nCompressedData = True\nCompressedDataSize = {}\n{}ElementSpacing = {} {} {}\nDimSize = {} {} "
      "{}\nElementType = {}\nElementDataFile = {}\n",
      packed_size, place, s.x, s.y, s.z, d.x, d.y, d.z, metaimage_type(type), data_file);
}

short nifti_type(VoxelType type) {
  switch (type) {
    case VoxelType::U8:
      return NIFTI_TYPE_UINT8;
    case VoxelType::I8:
      return NIFTI_TYPE_INT8;
    case VoxelType::U16:
      return NIFTI_TYPE_UINT16;
    case VoxelType::I16:
      return NIFTI_TYPE_INT16;
    case VoxelType::F32:
      return NIFTI_TYPE_FLOAT32;
  }
  return 0;
}

std::string nifti_header(const Volume& volume, VoxelType type, std::size_t bytes_per_voxel, const fs::path& path) {
  constexpr std::size_t kDataOffset = 352;  // the header, and four bytes for "no extensions"
  nifti_1_header header{};
  header.sizeof_hdr = 348;
  header.dim[0] = 3;
  header.pixdim[0] = 1.0f;
  for (int a = 0; a < 3; ++a) {
    if (volume.dims[a] > std::numeric_limits<short>::max()) {
      throw_input({.where = path.string(),
                   .what = "an axis is too long for NIfTI-1",
                   .expected = "at most 32767 voxels",
                   .got = fmt::format("{}", volume.dims[a]),
                   .fix = "write a .nrrd instead"});
    }
    header.dim[a + 1] = static_cast<short>(volume.dims[a]);
    header.pixdim[a + 1] = static_cast<float>(volume.spacing[a]);
  }
  for (int a = 4; a < 8; ++a) header.dim[a] = 1;
  header.datatype = nifti_type(type);
  header.bitpix = static_cast<short>(8 * bytes_per_voxel);
  header.vox_offset = static_cast<float>(kDataOffset);
  header.scl_slope = 1.0f;
  header.xyzt_units = NIFTI_UNITS_MM;
  if (volume.placed || volume.oblique) header.sform_code = NIFTI_XFORM_ALIGNED_ANAT;
  const glm::dvec3 origin = first_voxel(volume);
  float* const rows[3] = {header.srow_x, header.srow_y, header.srow_z};
  for (int a = 0; a < 3; ++a) {
    for (int grid = 0; grid < 3; ++grid) rows[a][grid] = static_cast<float>(step(volume, grid)[a]);
    rows[a][3] = static_cast<float>(origin[a]);
  }
  std::memcpy(header.magic, "n+1", 4);
  std::string text(kDataOffset, '\0');
  std::memcpy(text.data(), &header, sizeof(header));
  return text;
}

}  // namespace

fs::path data_file_of(const fs::path& header) {
  const fs::path beside = header.parent_path() / header.stem();
  if (header.extension() == ".nhdr") return beside.string() + ".raw.gz";
  if (header.extension() == ".mhd") return beside.string() + ".zraw";
  return {};
}

void save_volume(const Volume& volume, const fs::path& path, VoxelType type) {
  const std::string name = path.filename().string();
  const auto ends = [&name](const char* ending) { return name.size() > std::strlen(ending) && name.ends_with(ending); };
  const bool known = ends(".nrrd") || ends(".nhdr") || ends(".nii") || ends(".nii.gz") || ends(".mha") || ends(".mhd");
  if (!known) {
    throw_input({.where = path.string(),
                 .what = "unknown volume format",
                 .expected = ".nrrd, .nhdr, .nii, .nii.gz, .mha or .mhd",
                 .got = path.has_extension() ? path.extension().string() : "no extension",
                 .fix = "choose one of these extensions"});
  }
  const std::string voxels = packed(volume, type);
  if (ends(".nrrd")) {
    write_whole(path, nrrd_header(volume, type, {}), voxels, false, Packing::Gzip);
  } else if (ends(".nhdr")) {
    // Data first: a header that exists always names data that exist.
    const fs::path data_file = data_file_of(path);
    write_whole(data_file, {}, voxels, false, Packing::Gzip);
    write_whole(path, nrrd_header(volume, type, data_file.filename().string()), {}, false, Packing::Plain);
  } else if (ends(".mha") || ends(".mhd")) {
    std::ostringstream compressed;
    write_zlib(compressed, voxels.data(), voxels.size());
    const std::string body = std::move(compressed).str();
    const bool local = ends(".mha");
    const std::string data_file = local ? "LOCAL" : data_file_of(path).filename().string();
    if (!local) write_whole(data_file_of(path), {}, body, false, Packing::Plain);
    write_whole(path, metaimage_header(volume, type, body.size(), data_file), local ? body : "", false, Packing::Plain);
  } else {
    const std::size_t width = voxels.size() / volume.voxels.size();
    write_whole(path, nifti_header(volume, type, width, path), voxels, true,
                ends(".gz") ? Packing::Gzip : Packing::Plain);
  }
}

}  // namespace fastsplat::volume
