// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/voxel_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "base/machine_error.hpp"
#include "base/read_file.hpp"
#include "scene/volume/hounsfield.hpp"

namespace fastsplat::volume {
namespace {

constexpr std::uint64_t kMaxExtent = 65535;                   // sheet numbers have 16 bits
constexpr std::uint64_t kMaxVoxels = std::uint64_t{1} << 31;  // 8 GiB of voxels in memory
constexpr std::uint64_t kGzipLimit = 1032;                    // deflate cannot shrink more
constexpr std::uint64_t kOverhead = 4096;                     // generous, for the few bytes of a tiny file
constexpr std::uint64_t kBzip2Limit = 2'000'000;              // a block of 900,000 runs of 255 takes some 40 bytes

[[noreturn]] void refuse(const VoxelSource& source, std::string what, std::string expected, std::string got,
                         std::string fix) {
  throw_input({.where = source.header.string(),
               .what = std::move(what),
               .expected = std::move(expected),
               .got = std::move(got),
               .fix = std::move(fix)});
}

std::string extents_text(const VoxelSource& source) {
  return fmt::format("{} x {} x {}", source.extents[0], source.extents[1], source.extents[2]);
}

/// Describes the voxels of one data file, for messages.
std::string voxels_text(const VoxelSource& source) {
  return extents_text(source) + " voxels" +
         (source.files.size() > 1 ? fmt::format(" in {} files", source.files.size()) : "");
}

bool is_wide_integer(Component component) {
  return component == Component::U32 || component == Component::I32 || component == Component::U64 ||
         component == Component::I64;
}
bool is_scaled(const VoxelSource& source) { return source.slope != 1.0 || source.intercept != 0.0; }

VoxelType announced_type(const VoxelSource& source) {
  if (is_scaled(source)) return VoxelType::F32;
  switch (source.component) {
    case Component::U8:
      return VoxelType::U8;
    case Component::I8:
      return VoxelType::I8;
    case Component::U16:
      return VoxelType::U16;
    case Component::I16:
      return VoxelType::I16;
    default:
      return VoxelType::F32;
  }
}

/// The smallest type that holds whole numbers in [min,max].
VoxelType integer_type(float min, float max) {
  if (min >= 0.0f && max <= 255.0f) return VoxelType::U8;
  if (min >= -128.0f && max <= 127.0f) return VoxelType::I8;
  if (min >= 0.0f && max <= 65535.0f) return VoxelType::U16;
  if (min >= -32768.0f && max <= 32767.0f) return VoxelType::I16;
  return VoxelType::F32;
}

/// Values that must not enter a volume: counted while reading, reported afterwards.
struct Trouble {
  std::uint64_t count = 0;
  std::uint64_t first = 0;
  double value = 0.0;

  void note(std::uint64_t at, double what) {
    if (count++ == 0) first = at, value = what;
  }
};

void refuse_trouble(const VoxelSource& source, const Trouble& trouble, const char* what, const std::string& fix) {
  if (trouble.count == 0) return;
  const auto [nx, ny, nz] = source.extents;
  refuse(source, fmt::format("{} of {} voxels {}", trouble.count, source.voxels(), what), {},
         fmt::format("{} first, at voxel ({}, {}, {})", trouble.value, trouble.first % nx, trouble.first / nx % ny,
                     trouble.first / nx / ny),
         fix);
}

[[noreturn]] void refuse_end(const VoxelSource& source, std::uint64_t found, std::size_t rest) {
  const std::uint64_t width = source.packing == Packing::Text ? 1 : size_of(source.component);
  const char* unit = source.packing == Packing::Text ? "numbers" : "bytes";
  refuse(source, "the data ends early: the file is truncated or its header is wrong",
         fmt::format("{} {} for {}", source.voxels_per_file() * width, unit, voxels_text(source)),
         fmt::format("{} {}", found * width + rest, unit), "download or copy the file again");
}

/// Upper bound on the unpacked size of `on_disk` bytes.
std::uint64_t most_unpacked(const VoxelSource& source, std::uint64_t on_disk) {
  switch (source.packing) {
    case Packing::Plain:
      break;
    case Packing::Gzip:
    case Packing::Zlib:
      return on_disk > 0 ? (on_disk + 8) * kGzipLimit + kOverhead : 0;
    case Packing::Bzip2:
      return std::min(on_disk, std::uint64_t{1} << 40) * kBzip2Limit;
    case Packing::Hex:
      return on_disk / 2;
    case Packing::Text:  // at least a digit and a blank each
      return (on_disk + 1) / 2 * size_of(source.component);
  }
  return on_disk;
}

/// Values found besides valid numbers.
struct Findings {
  Trouble infinite;
  std::uint64_t replaced = 0;  ///< voxels that became `nan_as`
  std::uint64_t rounded = 0;   ///< stored numbers that a float cannot hold
};

float voxel_from(double number, const VoxelSource& source, std::optional<float> nan_as, std::size_t at,
                 Findings& findings) {
  if (nan_as && !std::isfinite(number)) {
    ++findings.replaced;
    return *nan_as;
  }
  constexpr double kLargest = 3.4028234663852886e38;
  constexpr double kExact = 9007199254740992.0;  // 2^53: a double holds any whole number below
  const double value = is_scaled(source) ? source.slope * number + source.intercept : number;
  const auto voxel =
      std::abs(value) <= kLargest ? static_cast<float>(value) : static_cast<float>(std::copysign(INFINITY, value));
  if (!std::isfinite(value) || std::isinf(voxel)) {
    findings.infinite.note(at, value);
  } else if (!is_scaled(source)) {
    const bool cut = is_wide_integer(source.component) && std::abs(number) >= kExact;
    findings.rounded += cut || static_cast<double>(voxel) != number ? 1 : 0;
  }
  return voxel;
}

std::vector<float> read_voxels(const VoxelSource& source, std::optional<float> nan_as, Findings& findings) {
  const std::uint64_t count = source.voxels();
  std::vector<float> voxels;
  try {
    voxels.reserve(count);  // untouched until data arrives, so that a false gzip header costs nothing
  } catch (const std::bad_alloc&) {
    throw_machine({.where = source.header.string(),
                   .what = "not enough memory for its voxels",
                   .expected = {},
                   .got = extents_text(source),
                   .fix = "downsample the volume (teem-unu resample)"});
  }
  for (const DataFile& file : source.files) {
    StoredValues stored(file.path, file.file_offset, file.stream_offset, source.packing, source.component,
                        source.order);
    for (std::uint64_t left = source.voxels_per_file(); left > 0;) {
      const auto numbers = stored.next(left);
      for (const double number : numbers) voxels.push_back(voxel_from(number, source, nan_as, voxels.size(), findings));
      if (numbers.empty()) refuse_end(source, source.voxels_per_file() - left, stored.rest());
      left -= numbers.size();
    }
    stored.verify_rest();
  }
  const bool large = std::isfinite(findings.infinite.value);
  refuse_trouble(source, findings.infinite, large ? "are too large for a float" : "are not finite numbers",
                 "add --nan-as 0 (or another value) to replace them");
  return voxels;
}

Volume empty_volume(const VoxelSource& source) {
  Volume volume;
  for (int a = 0; a < 3; ++a) {
    volume.dims[a] = static_cast<int>(source.extents[static_cast<std::size_t>(a)]);
    volume.spacing[a] = source.spacing[static_cast<std::size_t>(a)];
  }
  volume.stored = announced_type(source);
  volume.remarks = source.remarks;
  return volume;
}

void note_shear(Volume& volume) {
  constexpr double kWorthAWord = 0.1;  // degrees
  const double shear = turn_of(volume).shear;
  if (!(shear > kWorthAWord)) return;
  volume.remarks.push_back(
      fmt::format("the grid is sheared and drawn so: two axes are {:.1f} degrees off a right angle", shear));
}

}  // namespace

void check_source(const VoxelSource& source) {
  std::uint64_t count = 1;
  for (const std::uint64_t extent : source.extents) {
    if (extent < 1 || extent > kMaxExtent) {
      refuse(source, "invalid number of voxels along an axis", fmt::format("1..{}", kMaxExtent), extents_text(source),
             "check the header's sizes");
    }
    count *= extent;  // at most 65535^3: no overflow
  }
  if (count > kMaxVoxels) {
    refuse(source, "too many voxels", fmt::format("at most {}", kMaxVoxels), extents_text(source),
           "downsample the volume (teem-unu resample)");
  }
  for (const double spacing : source.spacing) {
    if (!(spacing >= 1e-6 && spacing <= 1e6)) {
      refuse(source, "invalid voxel spacing", "1e-6..1e6 mm", fmt::format("{}", spacing),
             "correct the header's spacing");
    }
  }
  if (!std::isfinite(source.slope) || !std::isfinite(source.intercept)) {
    refuse(source, "the header's value scaling is not a number", "finite scl_slope and scl_inter",
           fmt::format("{} and {}", source.slope, source.intercept), "correct the header");
  }
  const std::uint64_t bytes = source.voxels_per_file() * size_of(source.component);
  for (const DataFile& file : source.files) {
    require_readable_file(file.path);
    std::error_code error;
    const std::uint64_t file_size = std::filesystem::file_size(file.path, error);
    if (error) {
      throw_machine({.where = file.path.string(),
                     .what = "cannot read: " + error.message(),
                     .expected = {},
                     .got = {},
                     .fix = "check the path"});
    }
    const std::uint64_t on_disk = file_size > file.file_offset ? file_size - file.file_offset : 0;
    const std::uint64_t need = bytes + std::min(file.stream_offset, std::uint64_t{1} << 62);
    const std::uint64_t can_hold = most_unpacked(source, on_disk);
    if (need > can_hold) {
      refuse(source, "the header declares more than the file holds",
             fmt::format("{} bytes for {}", need, voxels_text(source)),
             fmt::format("{}{} bytes", source.packing == Packing::Plain ? "" : "at most ", can_hold),
             "download or copy the file again, or correct the header's sizes");
    }
  }
}

namespace {

/// Adds a remark about surplus data: the declared sizes may be too small. Ignores a few bytes.
void note_surplus(const VoxelSource& source, Volume& volume) {
  if (source.packing != Packing::Plain) return;
  const std::uint64_t size = size_of(source.component), need = source.voxels_per_file() * size;
  for (const DataFile& file : source.files) {
    const std::uint64_t surplus = std::filesystem::file_size(file.path) - file.file_offset - file.stream_offset - need;
    if (surplus < source.extents[0] * size) continue;
    volume.remarks.push_back(
        fmt::format("the data file holds {} bytes more than needed for {}", surplus, voxels_text(source)));
    return;
  }
}

}  // namespace

Volume describe_source(const VoxelSource& source) {
  check_source(source);
  Volume volume = empty_volume(source);
  if (source.placement) place(volume, *source.placement);
  return volume;
}

Volume read_source(const VoxelSource& source, std::optional<float> nan_as) {
  check_source(source);
  Volume volume = empty_volume(source);
  Findings findings;
  volume.voxels = read_voxels(source, nan_as, findings);
  const auto [low, high] = std::minmax_element(volume.voxels.begin(), volume.voxels.end());
  volume.min = *low;
  volume.max = *high;
  volume.water = find_water(volume);
  if (findings.replaced > 0) {
    volume.remarks.push_back(fmt::format("{} of {} voxels are not finite numbers and were replaced by {}",
                                         findings.replaced, volume.voxels.size(), *nan_as));
  }
  if (findings.rounded > 0) {
    volume.remarks.push_back(fmt::format("{} of {} voxels have more digits than a float holds and were rounded",
                                         findings.rounded, volume.voxels.size()));
  }
  if (volume.min == volume.max && volume.voxels.size() > 1)
    volume.remarks.push_back(
        fmt::format("constant volume: every voxel is {}; it shows as a block or not at all", volume.min));
  if (is_wide_integer(source.component) && !is_scaled(source)) volume.stored = integer_type(volume.min, volume.max);
  if (source.placement) place(volume, *source.placement);
  if (volume.oblique) note_shear(volume);
  note_surplus(source, volume);
  return volume;
}

}  // namespace fastsplat::volume
