#include "scene/volume/voxel_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "base/error.hpp"
#include "base/read_file.hpp"

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

std::uint64_t voxel_count(const VoxelSource& source) {
  return source.extents[0] * source.extents[1] * source.extents[2];
}

std::string extents_text(const VoxelSource& source) {
  return fmt::format("{} x {} x {}", source.extents[0], source.extents[1], source.extents[2]);
}

bool is_wide_integer(Component component) { return component == Component::U32 || component == Component::I32; }
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

/// What must not enter a volume: counted while reading, told afterwards.
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
  refuse(source, fmt::format("{} of {} voxels {}", trouble.count, voxel_count(source), what), {},
         fmt::format("{} first, at voxel ({}, {}, {})", trouble.value, trouble.first % nx, trouble.first / nx % ny,
                     trouble.first / nx / ny),
         fix);
}

[[noreturn]] void refuse_end(const VoxelSource& source, std::uint64_t found, std::size_t rest) {
  const std::uint64_t width = source.packing == Packing::Text ? 1 : size_of(source.component);
  const char* unit = source.packing == Packing::Text ? "numbers" : "bytes";
  refuse(source, "the data ends early: the file is truncated, or its header wrong",
         fmt::format("{} {} for {} voxels", voxel_count(source) * width, unit, extents_text(source)),
         fmt::format("{} {}", found * width + rest, unit), "download or copy the file again");
}

/// How many bytes `on_disk` can at most become.
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
    case Packing::Text:  // a digit and a blank each
      return (on_disk + 1) / 2 * size_of(source.component);
  }
  return on_disk;
}

/// `replaced`: how many voxels became `nan_as`.
std::vector<float> read_voxels(const VoxelSource& source, std::optional<float> nan_as, std::uint64_t& replaced) {
  const std::uint64_t count = voxel_count(source);
  StoredValues stored(source.data, source.file_offset, source.stream_offset, source.packing, source.component,
                      source.order);
  std::vector<float> voxels;
  try {
    voxels.reserve(count);  // not touched until data arrives, so that a lying gzip header costs nothing
  } catch (const std::bad_alloc&) {
    refuse(source, "not enough memory for its voxels", {}, extents_text(source),
           "downsample the volume (unu resample)");
  }
  Trouble infinite;
  Trouble inexact;
  while (voxels.size() < count) {
    const auto numbers = stored.next(count - voxels.size());
    for (const double number : numbers) {
      const double value = is_scaled(source) ? source.slope * number + source.intercept : number;
      const auto voxel = std::abs(value) <= 3.4028234663852886e38 ? static_cast<float>(value)
                                                                  : static_cast<float>(std::copysign(INFINITY, value));
      if (nan_as && !std::isfinite(number)) {
        voxels.push_back(*nan_as);
        ++replaced;
        continue;
      }
      if (!std::isfinite(value) || std::isinf(voxel)) infinite.note(voxels.size(), value);
      if (is_wide_integer(source.component) && static_cast<double>(static_cast<float>(number)) != number)
        inexact.note(voxels.size(), number);
      voxels.push_back(voxel);
    }
    if (numbers.empty()) refuse_end(source, voxels.size(), stored.rest());
  }
  stored.verify_rest();
  refuse_trouble(source, infinite, "are not finite numbers",
                 "add --nan-as 0 (or another value) to put that in their place");
  refuse_trouble(source, inexact, "do not fit a 24-bit mantissa", "rescale to 16 bits (unu quantize -b 16)");
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
      fmt::format("the grid is sheared: two of its axes are {:.1f} degrees off a right angle; it is drawn so", shear));
}

}  // namespace

void check_source(const VoxelSource& source) {
  std::uint64_t count = 1;
  for (const std::uint64_t extent : source.extents) {
    if (extent < 1 || extent > kMaxExtent) {
      refuse(source, "an axis has an impossible number of voxels", fmt::format("1..{}", kMaxExtent),
             extents_text(source), "check the header's sizes");
    }
    count *= extent;  // at most 65535^3: no overflow
  }
  if (count > kMaxVoxels) {
    refuse(source, "more voxels than can be handled", fmt::format("at most {}", kMaxVoxels), extents_text(source),
           "downsample the volume (unu resample)");
  }
  for (const double spacing : source.spacing) {
    if (!(spacing >= 1e-6 && spacing <= 1e6)) {
      refuse(source, "a voxel spacing makes no sense", "1e-6..1e6 mm", fmt::format("{}", spacing),
             "correct the header's spacing");
    }
  }
  if (!std::isfinite(source.slope) || !std::isfinite(source.intercept)) {
    refuse(source, "the header's value scaling is not a number", "finite scl_slope and scl_inter",
           fmt::format("{} and {}", source.slope, source.intercept), "correct the header");
  }

  require_readable_file(source.data);
  std::error_code error;
  const std::uint64_t file_size = std::filesystem::file_size(source.data, error);
  if (error) refuse(source, "cannot read: " + error.message(), {}, {}, "check the path");
  const std::uint64_t on_disk = file_size > source.file_offset ? file_size - source.file_offset : 0;
  const std::uint64_t need = count * size_of(source.component) + std::min(source.stream_offset, std::uint64_t{1} << 62);
  const std::uint64_t can_hold = most_unpacked(source, on_disk);
  if (need > can_hold) {
    refuse(source, "the header promises more than the file holds",
           fmt::format("{} bytes for {} voxels", need, extents_text(source)),
           fmt::format("{}{} bytes", source.packing == Packing::Plain ? "" : "at most ", can_hold),
           "download or copy the file again, or correct the header's sizes");
  }
}

Volume describe_source(const VoxelSource& source) {
  check_source(source);
  Volume volume = empty_volume(source);
  if (source.placement) place(volume, *source.placement);
  return volume;
}

Volume read_source(const VoxelSource& source, std::optional<float> nan_as) {
  check_source(source);
  Volume volume = empty_volume(source);
  std::uint64_t replaced = 0;
  volume.voxels = read_voxels(source, nan_as, replaced);
  const auto [low, high] = std::minmax_element(volume.voxels.begin(), volume.voxels.end());
  volume.min = *low;
  volume.max = *high;
  if (replaced > 0) {
    volume.remarks.push_back(fmt::format("{} of {} voxels are not finite numbers and were taken as {}", replaced,
                                         volume.voxels.size(), *nan_as));
  }
  if (volume.min == volume.max && volume.voxels.size() > 1)
    volume.remarks.push_back(
        fmt::format("a constant volume, every voxel is {}: it shows as a block, or not at all", volume.min));
  if (is_wide_integer(source.component) && !is_scaled(source)) volume.stored = integer_type(volume.min, volume.max);
  if (source.placement) place(volume, *source.placement);
  if (volume.oblique) note_shear(volume);
  return volume;
}

}  // namespace fastsplat::volume
