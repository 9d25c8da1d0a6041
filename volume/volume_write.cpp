#include <fmt/format.h>
#include <nifti1.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "volume/byte_reader.hpp"
#include "volume/volume_file.hpp"

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
                     .what = fmt::format("a voxel does not fit {}", to_string(type)),
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
    throw_input({.where = path.string(),
                 .what = std::string("cannot write: ") + std::strerror(errno),
                 .expected = {},
                 .got = {},
                 .fix = "choose a writable folder with enough free space"});
  }
  file.commit();
}

std::string nrrd_header(const Volume& volume, VoxelType type, const std::string& data_file) {
  const auto& d = volume.dims;
  const auto& s = volume.spacing;
  std::string text = fmt::format(
      "NRRD0004\n# written by fastsplat\ntype: {}\ndimension: 3\nsizes: {} {} {}\nspacings: {} {} {}\nunits: \"mm\" "
      "\"mm\" \"mm\"\n"
      "endian: little\nencoding: gzip\n",
      to_string(type), d.x, d.y, d.z, s.x, s.y, s.z);
  return text + (data_file.empty() ? "\n" : "data file: " + data_file + "\n");
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
  constexpr std::size_t kDataOffset = 352;  // the header and four bytes that say: no extensions
  nifti_1_header header{};
  header.sizeof_hdr = 348;
  header.dim[0] = 3;
  header.pixdim[0] = 1.0f;
  for (int a = 0; a < 3; ++a) {
    if (volume.dims[a] > std::numeric_limits<short>::max()) {
      throw_input({.where = path.string(),
                   .what = "too long an axis for NIfTI-1",
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
  header.sform_code = NIFTI_XFORM_ALIGNED_ANAT;
  const glm::dvec3 origin = volume.position(0, 0, 0);
  float* const rows[3] = {header.srow_x, header.srow_y, header.srow_z};
  for (int a = 0; a < 3; ++a) {
    rows[a][a] = static_cast<float>(volume.spacing[a]);
    rows[a][3] = static_cast<float>(origin[a]);
  }
  std::memcpy(header.magic, "n+1", 4);
  std::string text(kDataOffset, '\0');
  std::memcpy(text.data(), &header, sizeof(header));
  return text;
}

}  // namespace

fs::path data_file_of(const fs::path& nhdr) { return nhdr.parent_path() / (nhdr.stem().string() + ".raw.gz"); }

void save_volume(const Volume& volume, const fs::path& path, VoxelType type) {
  const std::string name = path.filename().string();
  const auto ends = [&name](const char* ending) { return name.size() > std::strlen(ending) && name.ends_with(ending); };
  if (!ends(".nrrd") && !ends(".nhdr") && !ends(".nii") && !ends(".nii.gz")) {
    throw_input({.where = path.string(),
                 .what = "unknown kind of volume file",
                 .expected = ".nrrd, .nhdr, .nii or .nii.gz",
                 .got = path.has_extension() ? path.extension().string() : "no extension",
                 .fix = "choose one of these endings"});
  }
  const std::string voxels = packed(volume, type);
  if (ends(".nrrd")) {
    write_whole(path, nrrd_header(volume, type, {}), voxels, false, Packing::Gzip);
  } else if (ends(".nhdr")) {
    // Data first: a header that exists always names data that exist.
    const fs::path data_file = data_file_of(path);
    write_whole(data_file, {}, voxels, false, Packing::Gzip);
    write_whole(path, nrrd_header(volume, type, data_file.filename().string()), {}, false, Packing::Plain);
  } else {
    const std::size_t width = voxels.size() / volume.voxels.size();
    write_whole(path, nifti_header(volume, type, width, path), voxels, true,
                ends(".gz") ? Packing::Gzip : Packing::Plain);
  }
}

}  // namespace fastsplat::volume
