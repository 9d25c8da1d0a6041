// SPDX-License-Identifier: Apache-2.0
// libnifti2 interprets the header (byte order, scaling, axes), after checks of everything it would trust. It never
// opens a file, since it prints errors and replaces NaN by 0 when it reads.
#include "scene/volume/nifti_file.hpp"

#include <fmt/format.h>
#include <nifti2_io.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <tuple>
#include <vector>

#include "base/error.hpp"
#include "scene/volume/lengths.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

static_assert(sizeof(nifti_1_header) == 348 && sizeof(nifti_2_header) == 540);

[[noreturn]] void refuse(const fs::path& path, std::string what, std::string expected, std::string got,
                         std::string fix) {
  throw_input({.where = path.string(),
               .what = std::move(what),
               .expected = std::move(expected),
               .got = std::move(got),
               .fix = std::move(fix)});
}

enum class Version { None, One, Two };

struct RawHeader {
  std::vector<unsigned char> bytes;
  Version version = Version::None;
  bool swapped = false;
};

template <typename T>
T field_at(const RawHeader& header, std::size_t offset) {
  std::array<unsigned char, sizeof(T)> bytes;
  std::copy_n(header.bytes.begin() + static_cast<std::ptrdiff_t>(offset), sizeof(T), bytes.begin());
  if (header.swapped) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

/// Number `index` of several that lie one after another in the header.
double number_at(const RawHeader& header, std::size_t offset_one, std::size_t offset_two, std::size_t index = 0) {
  return header.version == Version::One ? static_cast<double>(field_at<float>(header, offset_one + 4 * index))
                                        : field_at<double>(header, offset_two + 8 * index);
}

RawHeader read_raw(const fs::path& path) {
  RawHeader header;
  header.bytes.resize(sizeof(nifti_2_header));
  ByteReader reader(path, 0, packing_of(path));
  header.bytes.resize(reader.read(header.bytes.data(), header.bytes.size()));
  if (header.bytes.size() < 4) return header;
  for (const bool swapped : {false, true}) {
    header.swapped = swapped;
    const auto size = field_at<std::int32_t>(header, 0);
    if (size == 348) header.version = Version::One;
    if (size == 540) header.version = Version::Two;
    if (header.version != Version::None) break;
  }
  return header;
}

/// The parts of the header that determine memory and files, checked before libnifti2 sees it.
struct Checked {
  std::array<std::int64_t, 8> dim{};
  int datatype = 0;
  std::array<double, 3> pixdim{};
  bool pair = false;
  double offset = 0.0;
};

Checked check(const fs::path& path, const RawHeader& header) {
  const bool one = header.version == Version::One;
  const std::size_t length = one ? sizeof(nifti_1_header) : sizeof(nifti_2_header);
  if (header.bytes.size() < length) {
    refuse(path, "the NIfTI header is truncated", fmt::format("{} bytes", length),
           fmt::format("{}", header.bytes.size()), "download or copy the file again");
  }
  const std::string magic(reinterpret_cast<const char*>(
                              &header.bytes[one ? offsetof(nifti_1_header, magic) : offsetof(nifti_2_header, magic)]),
                          4);
  const std::string single = one ? std::string("n+1\0", 4) : std::string("n+2\0", 4);
  const std::string pair = one ? std::string("ni1\0", 4) : std::string("ni2\0", 4);
  if (magic != single && magic != pair) {
    refuse(path, "not a NIfTI header: the magic is missing (an ANALYZE file?)", "n+1, ni1, n+2 or ni2", {},
           "convert it to NIfTI");
  }
  Checked checked;
  checked.pair = magic == pair;
  for (std::size_t i = 0; i < 8; ++i) {
    checked.dim[i] = one ? field_at<std::int16_t>(header, offsetof(nifti_1_header, dim) + 2 * i)
                         : field_at<std::int64_t>(header, offsetof(nifti_2_header, dim) + 8 * i);
  }
  for (std::size_t a = 0; a < 3; ++a) {
    checked.pixdim[a] = number_at(header, offsetof(nifti_1_header, pixdim), offsetof(nifti_2_header, pixdim), a + 1);
  }
  checked.datatype =
      field_at<std::int16_t>(header, one ? offsetof(nifti_1_header, datatype) : offsetof(nifti_2_header, datatype));
  checked.offset = one ? static_cast<double>(field_at<float>(header, offsetof(nifti_1_header, vox_offset)))
                       : static_cast<double>(field_at<std::int64_t>(header, offsetof(nifti_2_header, vox_offset)));
  const std::int64_t axes = checked.dim[0];
  if (axes < 1 || axes > 7)
    refuse(path, "invalid number of dimensions", "1..7", fmt::format("{}", axes),
           "the header is damaged: copy the file again");
  std::string shown;
  bool volume = axes >= 3;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(axes); ++i) {
    if (checked.dim[i] < 1 || checked.dim[i] > 65535) {
      refuse(path, fmt::format("invalid dimension {}", i), "1..65535 voxels", fmt::format("{}", checked.dim[i]),
             "the header is damaged: copy the file again");
    }
    if (i > 3 && checked.dim[i] != 1) volume = false;
    shown += fmt::format("{}{}", i > 1 ? " x " : "", checked.dim[i]);
  }
  if (!volume) {
    refuse(path, "not a volume of one scalar per voxel", "3 dimensions (further ones of size 1)", shown,
           "extract one component or time step first (fslroi, nifti_tool -cbl)");
  }
  const double least = checked.pair ? 0.0 : static_cast<double>(length);
  if (!(checked.offset >= least && checked.offset <= 1e12)) {
    refuse(path, "invalid data offset", fmt::format("at least {}", least), fmt::format("{}", checked.offset),
           "the header is damaged: copy the file again");
  }
  return checked;
}

Component component_of(const fs::path& path, int datatype) {
  switch (datatype) {
    case NIFTI_TYPE_UINT8:
      return Component::U8;
    case NIFTI_TYPE_INT8:
      return Component::I8;
    case NIFTI_TYPE_UINT16:
      return Component::U16;
    case NIFTI_TYPE_INT16:
      return Component::I16;
    case NIFTI_TYPE_UINT32:
      return Component::U32;
    case NIFTI_TYPE_INT32:
      return Component::I32;
    case NIFTI_TYPE_UINT64:
      return Component::U64;
    case NIFTI_TYPE_INT64:
      return Component::I64;
    case NIFTI_TYPE_FLOAT32:
      return Component::F32;
    case NIFTI_TYPE_FLOAT64:
      return Component::F64;
    default:
      refuse(path, "unsupported voxel type", "integers, float or double", fmt::format("NIfTI datatype {}", datatype),
             "convert it (fslmaths IN OUT -odt float)");
  }
}

using ImagePointer = std::unique_ptr<nifti_image, decltype(&nifti_image_free)>;

ImagePointer interpret(const fs::path& path, const RawHeader& header) {
  nifti_set_debug_level(0);
  const std::string name = path.string();
  nifti_image* image = nullptr;
  if (header.version == Version::One) {
    nifti_1_header raw;
    std::memcpy(&raw, header.bytes.data(), sizeof(raw));
    image = nifti_convert_n1hdr2nim(raw, name.c_str());
  } else {
    nifti_2_header raw;
    std::memcpy(&raw, header.bytes.data(), sizeof(raw));
    image = nifti_convert_n2hdr2nim(raw, name.c_str());
  }
  if (image == nullptr) refuse(path, "not a valid NIfTI header", {}, {}, "download or copy the file again");
  return {image, &nifti_image_free};
}

double mm_of_units(int units, std::vector<std::string>& remarks) {
  if (units == NIFTI_UNITS_METER) return 1000.0;
  if (units == NIFTI_UNITS_MICRON) return 0.001;
  if (units != NIFTI_UNITS_UNKNOWN && units != NIFTI_UNITS_MM)
    remarks.push_back(fmt::format("the header's unit of length, code {}, is unknown: mm is used", units));
  return 1.0;
}

/// Whether the qform's rotation and offset are numbers, and the rotation is one; libnifti2 makes others 0.
bool usable_qform(const RawHeader& header) {
  constexpr double kMostSquare = 1.001;  // the rotation's scalar part completes the norm to 1
  double square = 0.0;
  bool finite = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = number_at(header, offsetof(nifti_1_header, quatern_b), offsetof(nifti_2_header, quatern_b), i);
    square += part * part;
    finite = finite && std::isfinite(number_at(header, offsetof(nifti_1_header, qoffset_x),
                                               offsetof(nifti_2_header, qoffset_x), i));
  }
  return finite && square <= kMostSquare;
}

std::optional<Placement> placement_by(const nifti_dmat44& matrix, double mm) {
  Placement placement;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const double value = matrix.m[row][column];
      if (!(std::abs(value) < 1e9)) return std::nullopt;
      (column < 3 ? placement.direction[static_cast<std::size_t>(column)] : placement.origin)[row] = value * mm;
    }
  }
  if (!spans_space(placement.direction)) return std::nullopt;
  return placement;
}

/// Placement by the header's sform, else its qform; nullopt if neither is usable.
std::optional<Placement> placement_of(const nifti_image& image, bool usable_qform, double mm,
                                      std::vector<std::string>& remarks) {
  std::string unusable;
  for (const auto& [name, code, matrix] :
       {std::tuple{"sform", image.sform_code, &image.sto_xyz}, {"qform", image.qform_code, &image.qto_xyz}}) {
    if (code <= 0) continue;
    auto placement = placement_by(*matrix, mm);
    if (!placement || (matrix == &image.qto_xyz && !usable_qform)) {
      unusable += fmt::format("{}{}", unusable.empty() ? "" : " and ", name);
      continue;
    }
    if (!unusable.empty())
      remarks.push_back(fmt::format(
          "the header's {} needs three independent axes and a finite origin: its {} is used instead", unusable, name));
    return placement;
  }
  if (!unusable.empty()) {
    remarks.push_back(fmt::format(
        "the header's {} needs three independent axes and a finite origin: axes are drawn as stored", unusable));
  }
  return std::nullopt;
}

/// The voxels of NAME.hdr are in NAME.img or NAME.img.gz beside it; links to elsewhere are refused.
fs::path paired_data(const fs::path& path) {
  fs::path stem = path;
  if (stem.extension() == ".gz") stem.replace_extension();
  if (stem.extension() != ".hdr")
    refuse(path, "the header of a NIfTI pair has the wrong extension", "a name ending in .hdr", {},
           "rename it to end in .hdr, with its .img beside it");
  for (const char* ending : {".img", ".img.gz"}) {
    fs::path data = stem;
    data.replace_extension(ending);
    std::error_code error;
    if (!fs::exists(data, error)) continue;
    if (fs::canonical(data, error).parent_path() != fs::canonical(path, error).parent_path()) {
      refuse(path, "the data file is a link to outside the header's folder", {}, data.string(),
             "keep the .img file beside its .hdr");
    }
    return data;
  }
  refuse(path, "the .img file of this NIfTI pair is missing", {}, {}, "put it beside the .hdr");
}

}  // namespace

bool is_nifti(const fs::path& path) { return read_raw(path).version != Version::None; }

VoxelSource read_nifti_header(const fs::path& path) {
  const RawHeader header = read_raw(path);
  const Checked checked = check(path, header);
  VoxelSource source;
  source.header = path;
  source.component = component_of(path, checked.datatype);
  const ImagePointer image = interpret(path, header);
  DataFile file{.path = checked.pair ? paired_data(path) : path};
  source.packing = packing_of(file.path);
  (source.packing == Packing::Gzip ? file.stream_offset : file.file_offset) =
      static_cast<std::uint64_t>(checked.offset);
  source.files = {std::move(file)};
  const bool little = (std::endian::native == std::endian::little) != header.swapped;
  source.order = little ? std::endian::little : std::endian::big;
  const double mm = mm_of_units(image->xyz_units, source.remarks);
  for (std::size_t a = 0; a < 3; ++a) {
    source.extents[a] = static_cast<std::uint64_t>(checked.dim[a + 1]);
    source.spacing[a] = usable_length(checked.pixdim[a]) * mm;
  }
  // From the header itself: libnifti2 sets non-finite values to 0.
  const double slope = number_at(header, offsetof(nifti_1_header, scl_slope), offsetof(nifti_2_header, scl_slope));
  if (slope != 0.0 && !std::isnan(slope)) {  // either means unscaled
    source.slope = slope;
    source.intercept = number_at(header, offsetof(nifti_1_header, scl_inter), offsetof(nifti_2_header, scl_inter));
  }
  source.placement = placement_of(*image, usable_qform(header), mm, source.remarks);
  if (source.placement) {
    // The matrix defines the places of the voxels; pixdim is kept if it agrees up to rounding.
    constexpr double kRounding = 1e-3;
    for (std::size_t a = 0; a < 3; ++a) {
      const double step = glm::length(source.placement->direction[a]);
      if (!(std::abs(step - source.spacing[a]) <= kRounding * step)) source.spacing[a] = step;
    }
  }
  for (std::size_t a = 0; a < 3; ++a)
    note_unusable_length(fmt::format("pixdim[{}]", a + 1), checked.pixdim[a], source.spacing[a], source.remarks);
  return source;
}

}  // namespace fastsplat::volume
