// SPDX-License-Identifier: Apache-2.0
// Teem interprets the header's types, spacings and directions. It gets a new header, made of the checked fields only,
// and never opens a file: it trusts sizes, and a detached header may name any file of the machine.
#include "scene/volume/nrrd_file.hpp"

#include <fmt/format.h>
#include <teem/nrrd.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>
#include <sstream>
#include <string_view>

#include "base/lower_case.hpp"
#include "base/read_file.hpp"
#include "scene/volume/byte_reader.hpp"
#include "scene/volume/detached_files.hpp"
#include "scene/volume/lengths.hpp"
#include "scene/volume/nrrd_header.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxField = 4096;
constexpr int kMaxDimension = 16;

using Field = TextHeader::Field;

std::vector<std::uint64_t> parse_sizes(const TextHeader& header) {
  const Field& dimension = header.need("dimension");
  const std::uint64_t axes = header.count(dimension, dimension.value);
  if (axes < 1 || axes > kMaxDimension) {
    header.refuse(dimension.line, "invalid dimension", fmt::format("1..{}", kMaxDimension), dimension.value,
                  "correct the header");
  }
  const Field& field = header.need("sizes");
  std::vector<std::uint64_t> sizes;
  for (const auto& word : words_of(field.value)) sizes.push_back(header.count(field, word));
  if (sizes.size() != axes) {
    header.refuse(field.line, "sizes and dimension disagree", fmt::format("{} sizes", axes),
                  fmt::format("'{}'", field.value.substr(0, 80)), "correct the header");
  }
  for (const std::uint64_t size : sizes) {
    if (size < 1 || size > 65535) {
      header.refuse(field.line, "invalid number of voxels along an axis", "1..65535", fmt::format("{}", size),
                    "check the header's sizes");
    }
  }
  return sizes;
}

/// Refuses unpaired quotes. Teem would, too, but its parser then leaks memory (1.12).
void refuse_unpaired_quote(const TextHeader& header, const Field& field, const char* name) {
  bool open = false;
  for (std::size_t i = 0; i < field.value.size(); ++i) {
    if (field.value[i] == '"' && (i == 0 || field.value[i - 1] != '\\')) open = !open;
  }
  if (open) {
    header.refuse(field.line, fmt::format("'{}' has an unpaired quotation mark", name), "\"mm\" \"mm\" \"mm\"",
                  field.value.substr(0, 40), "correct the header");
  }
}

/// The fields that describe the voxels' layout, for teem: attached, raw, so that it looks for no other file.
std::string header_for_teem(const TextHeader& header) {
  std::string text = "NRRD0005\n";
  // In this order: teem needs the dimension before fields with a word per axis.
  for (const char* name : {"type", "dimension", "space", "space dimension", "sizes", "axis mins", "axis maxs",
                           "space directions", "centerings", "kinds", "units", "space units", "space origin"}) {
    const Field* field = header.find({name});
    if (field == nullptr) continue;
    if (field->value.size() > kMaxField)
      header.refuse(field->line, fmt::format("'{}' is too long", name), {}, {}, "correct the header");
    refuse_unpaired_quote(header, *field, name);
    text += fmt::format("{}: {}\n", name, field->value);
  }
  return text + "endian: little\nencoding: raw\n\n";
}

using NrrdPointer = std::unique_ptr<Nrrd, decltype(&nrrdNuke)>;

/// Teem's error: the header's field that it read, if it says so, and the cause.
struct TeemError {
  std::string field, cause;
};
TeemError teem_error() {
  const std::unique_ptr<char, decltype(&std::free)> text(biffGetDone(NRRD), &std::free);
  // The last line is the cause, behind the name of a function; those before have that of the function for the field.
  std::string field, cause;
  std::istringstream lines(text ? text.get() : "");
  for (std::string line; std::getline(lines, line);) {
    const auto bracket = line.find("] "), colon = line.find(": ");
    if (bracket != std::string::npos && colon != std::string::npos && colon > bracket) {
      constexpr std::string_view kParse = "ReadNrrdParse_";
      const std::string function = line.substr(bracket + 2, colon - bracket - 2);
      if (const auto at = function.find(kParse); at != std::string::npos) field = function.substr(at + kParse.size());
      line = line.substr(colon + 2);
    }
    if (!trimmed(line).empty()) cause = trimmed(line);
  }
  std::replace(field.begin(), field.end(), '_', ' ');
  return {field, cause};
}

NrrdPointer parse_with_teem(const TextHeader& header) {
  static std::mutex biff_is_global;
  const std::lock_guard lock(biff_is_global);
  nrrdStateVerboseIO = 0;
  NrrdPointer nrrd(nrrdNew(), &nrrdNuke);
  const std::unique_ptr<NrrdIoState, decltype(&nrrdIoStateNix)> io(nrrdIoStateNew(), &nrrdIoStateNix);
  io->skipData = AIR_TRUE;
  if (nrrdStringRead(nrrd.get(), header_for_teem(header).c_str(), io.get()) != 0) {
    const TeemError error = teem_error();
    const Field* const field = header.find({error.field.c_str()});
    header.refuse(field != nullptr ? field->line : 0,
                  "not a valid NRRD header: " + (field != nullptr ? "'" + error.field + "': " : "") + error.cause, {},
                  {}, "correct the header");
  }
  return nrrd;
}

bool has_direction(const Nrrd& nrrd, unsigned axis) {
  return nrrd.spaceDim > 0 && !std::isnan(nrrd.axis[axis].spaceDirection[0]);
}

/// Whether a direction has a part beyond the three dimensions of space: along time.
bool has_time(const Nrrd& nrrd, unsigned axis) {
  const double* const direction = nrrd.axis[axis].spaceDirection;
  return has_direction(nrrd, axis) && std::any_of(direction + std::min(3U, nrrd.spaceDim), direction + nrrd.spaceDim,
                                                  [](double part) { return part != 0.0; });
}

/// Whether an axis runs along time alone.
bool is_time(const Nrrd& nrrd, unsigned axis) {
  const double* const direction = nrrd.axis[axis].spaceDirection;
  return has_time(nrrd, axis) && std::all_of(direction, direction + 3, [](double part) { return part == 0.0; });
}

/// Whether an axis can be spatial: its kind allows it, and it has a direction in space if any axis does.
bool may_be_spatial(const Nrrd& nrrd, unsigned axis) {
  const int kind = nrrd.axis[axis].kind;
  if (kind == nrrdKindTime || (kind != nrrdKindUnknown && nrrdKindIsDomain(kind) == 0)) return false;
  if (is_time(nrrd, axis)) return false;
  bool any = false;
  for (unsigned a = 0; a < nrrd.dim; ++a) any = any || has_direction(nrrd, a);
  return !any || has_direction(nrrd, axis);
}

/// The volume's three axes. Drops axes of length 1: those of colours or time, then of more than three the slowest.
std::array<unsigned, 3> volume_axes(const TextHeader& header, const Nrrd& nrrd) {
  std::vector<unsigned> axes;
  bool several = false;
  for (unsigned a = 0; a < nrrd.dim; ++a) {
    if (may_be_spatial(nrrd, a))
      axes.push_back(a);
    else
      several = several || nrrd.axis[a].size != 1;
  }
  for (auto a = axes.size(); a-- > 0 && axes.size() > 3;) {
    if (nrrd.axis[axes[a]].size == 1) axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(a));
  }
  if (several || axes.size() != 3) {
    const Field* const kinds = header.find({"kinds"});
    header.refuse(header.need("sizes").line, "not a volume of one scalar per voxel",
                  "3 axes in space (others of size 1)",
                  fmt::format("sizes {}{}", header.need("sizes").value.substr(0, 80),
                              kinds != nullptr ? ", kinds " + kinds->value.substr(0, 80) : ""),
                  "extract one component or time step first (teem-unu slice)");
  }
  return {axes[0], axes[1], axes[2]};
}

Component component_of(const TextHeader& header, int type) {
  switch (type) {
    case nrrdTypeUChar:
      return Component::U8;
    case nrrdTypeChar:
      return Component::I8;
    case nrrdTypeUShort:
      return Component::U16;
    case nrrdTypeShort:
      return Component::I16;
    case nrrdTypeUInt:
      return Component::U32;
    case nrrdTypeInt:
      return Component::I32;
    case nrrdTypeULLong:
      return Component::U64;
    case nrrdTypeLLong:
      return Component::I64;
    case nrrdTypeFloat:
      return Component::F32;
    case nrrdTypeDouble:
      return Component::F64;
    default:
      header.refuse(header.need("type").line, "unsupported voxel type", "integers, float or double",
                    header.need("type").value.substr(0, 40), "convert it (teem-unu convert -t float)");
  }
}

std::endian endian_of(const TextHeader& header, Component component) {
  const Field* field = header.find({"endian"});
  if (field == nullptr && size_of(component) == 1) return std::endian::native;
  const std::string value = lower_case(header.need("endian").value);
  if (value == "little") return std::endian::little;
  if (value == "big") return std::endian::big;
  header.refuse(field->line, "unknown byte order", "little or big", field->value.substr(0, 40), "correct the header");
}

Packing packing_from(const TextHeader& header) {
  const Field& field = header.need("encoding");
  const std::string value = lower_case(field.value);
  if (value == "raw") return Packing::Plain;
  if (value == "gzip" || value == "gz") return Packing::Gzip;
  if (value == "bzip2" || value == "bz2") return Packing::Bzip2;
  if (value == "hex") return Packing::Hex;
  if (value == "text" || value == "txt" || value == "ascii") return Packing::Text;
  header.refuse(field.line, "unsupported encoding", "raw, gzip, bzip2, hex or ascii", field.value.substr(0, 40),
                "convert it (teem-unu save -f nrrd -e gzip)");
}

/// Where the voxels begin in one data file: after `line skip`, then `byte skip`, which counts unpacked bytes if packed.
void skip_into(DataFile& file, const TextHeader& header, const VoxelSource& source) {
  require_readable_file(file.path);
  if (const Field* field = header.find({"line skip"}))
    file.file_offset = offset_after_lines(file.path, file.file_offset, header.count(*field, field->value));
  const Field* field = header.find({"byte skip"});
  if (field == nullptr || field->value == "0") return;
  const bool packed = source.packing == Packing::Gzip || source.packing == Packing::Bzip2;
  if (field->value != "-1") {
    const std::uint64_t skip = header.count(*field, field->value);
    const std::uint64_t size = fs::file_size(file.path);
    if (!packed && skip > size - std::min(size, file.file_offset)) {
      header.refuse(field->line, "byte skip exceeds the end of the file", fmt::format("at most {}", size),
                    fmt::format("{}", skip), "correct the header");
    }
    (packed ? file.stream_offset : file.file_offset) += skip;
    return;
  }
  if (source.packing == Packing::Hex || source.packing == Packing::Text) {
    header.refuse(field->line, "byte skip -1 needs voxels of a fixed size", "raw, gzip or bzip2",
                  header.need("encoding").value.substr(0, 40), "count the bytes to skip, or convert the file");
  }
  const std::uint64_t need = source.voxels_per_file() * size_of(source.component);
  const std::uint64_t size = unpacked_size(file.path, file.file_offset, source.packing);
  if (size < need) {
    header.refuse(field->line, "the header declares more than the file holds", fmt::format("{} bytes", need),
                  fmt::format("{} bytes", size), "download or copy the file again");
  }
  (packed ? file.stream_offset : file.file_offset) += size - need;
}

/// Sign of each world axis of `space` towards right, anterior, superior; nullopt for non-anatomical spaces.
std::optional<std::array<double, 3>> towards_ras(int space) {
  switch (space) {
    case nrrdSpaceRightAnteriorSuperior:
    case nrrdSpaceRightAnteriorSuperiorTime:
      return {{1, 1, 1}};
    case nrrdSpaceLeftAnteriorSuperior:
    case nrrdSpaceLeftAnteriorSuperiorTime:
      return {{-1, 1, 1}};
    case nrrdSpaceLeftPosteriorSuperior:
    case nrrdSpaceLeftPosteriorSuperiorTime:
      return {{-1, -1, 1}};
    default:
      return std::nullopt;
  }
}

struct Geometry {
  std::array<double, 3> spacing{1, 1, 1};
  std::optional<Placement> placement;
  std::vector<std::string> remarks;
};

/// Millimetres per unit of the header; adds a remark if the unit is unknown.
double known_unit(const char* unit, Geometry& geometry) {
  if (unit == nullptr || *unit == '\0') return 1.0;
  const auto mm = mm_per_unit(unit);
  if (!mm) geometry.remarks.push_back(fmt::format("the header's unit '{}' is unknown: mm is used", unit));
  return mm.value_or(1.0);
}

/// Spacing of an axis without direction, in the header's unit: from `spacings`, else from `axis mins` and `maxs`.
double spacing_of(const TextHeader& header, const Nrrd& nrrd, unsigned axis) {
  const NrrdAxisInfo& info = nrrd.axis[axis];
  if (const Field* spacings = header.find({"spacings"})) return header.numbers(*spacings, nrrd.dim)[axis];
  if (std::isnan(info.min) || std::isnan(info.max)) return 1.0;  // the usual default
  const bool node = info.center == nrrdCenterNode;
  return (info.max - info.min) / static_cast<double>(info.size - (node ? std::min<std::size_t>(1, info.size - 1) : 0));
}

/// Refuses a spacing beside a direction that has another length.
void refuse_other_spacing(const TextHeader& header, const Nrrd& nrrd, unsigned axis) {
  constexpr double kRounding = 1e-3;
  const Field* const spacings = header.find({"spacings"});
  if (spacings == nullptr) return;
  const double spacing = header.numbers(*spacings, nrrd.dim)[axis];
  const double* const direction = nrrd.axis[axis].spaceDirection;
  const double length = std::sqrt(std::inner_product(direction, direction + nrrd.spaceDim, direction, 0.0));
  if (std::isnan(spacing) || std::abs(spacing - length) <= kRounding * length) return;
  header.refuse(spacings->line, fmt::format("axis {} has a spacing and a space direction of another length", axis + 1),
                fmt::format("{:g}, or no spacings", length), fmt::format("{:g}", spacing), "correct the header");
}

/// Sets the placement from directions and origin in mm. Adds a remark if some are given but unusable.
void place_in_body(Geometry& geometry, const Nrrd& nrrd, const std::array<glm::dvec3, 3>& directions,
                   const glm::dvec3& origin, bool given_origin) {
  const auto signs = towards_ras(nrrd.space);
  if (!signs) {
    bool straight = true;
    for (int a = 0; a < 3; ++a) {
      const glm::dvec3& direction = directions[static_cast<std::size_t>(a)];
      straight = straight && direction[a] > 0.0 && direction[a] == glm::length(direction);
    }
    const bool left_handed = nrrd.space == nrrdSpace3DLeftHanded || nrrd.space == nrrdSpace3DLeftHandedTime;
    const bool moved = std::abs(origin[0]) + std::abs(origin[1]) + std::abs(origin[2]) > 0.0;
    if (!straight || left_handed || moved)
      geometry.remarks.push_back("the header's space is not anatomical: axes are drawn as stored, around the origin");
    return;
  }
  const glm::dvec3 sign((*signs)[0], (*signs)[1], (*signs)[2]);
  Placement placement{.direction = {sign * directions[0], sign * directions[1], sign * directions[2]},
                      .origin = sign * origin};
  for (int world = 0; world < 3; ++world) placement.has_origin = placement.has_origin && std::abs(origin[world]) < 1e9;
  if (!placement.has_origin && given_origin)
    geometry.remarks.push_back("the header's space origin is not a place: the volume's centre is at 0");
  if (spans_space(placement.direction))
    geometry.placement = placement;
  else
    geometry.remarks.push_back("the header's space directions are not independent: axes are drawn as stored");
}

Geometry geometry_of(const TextHeader& header, const Nrrd& nrrd, const std::array<unsigned, 3>& axes) {
  Geometry geometry;
  std::array<double, NRRD_SPACE_DIM_MAX> mm{};
  for (unsigned world = 0; world < nrrd.spaceDim; ++world)
    mm[world] = world < 3 ? known_unit(nrrd.spaceUnits[world], geometry) : 0.0;
  const bool directed = nrrd.spaceDim >= 3 && has_direction(nrrd, axes[0]);
  std::array<glm::dvec3, 3> directions{};
  for (std::size_t a = 0; a < 3; ++a) {
    const NrrdAxisInfo& info = nrrd.axis[axes[a]];
    double declared = 0.0;
    if (has_direction(nrrd, axes[a])) {
      if (has_time(nrrd, axes[a]))
        geometry.remarks.push_back(
            fmt::format("the direction of axis {} has a part along time, which is left out", a + 1));
      double square = 0.0;
      for (unsigned world = 0; world < nrrd.spaceDim; ++world) {
        const double along = info.spaceDirection[world] * mm[world];
        square += along * along;
        if (world < 3) directions[a][static_cast<int>(world)] = along;
      }
      declared = std::sqrt(square);
      refuse_other_spacing(header, nrrd, axes[a]);
    } else {
      declared = spacing_of(header, nrrd, axes[a]) * known_unit(info.units, geometry);
    }
    geometry.spacing[a] = usable_length(declared);
    note_unusable_length(fmt::format("spacing of axis {}", a + 1), declared, geometry.spacing[a], geometry.remarks);
  }
  if (directed) {
    place_in_body(geometry, nrrd, directions,
                  glm::dvec3(nrrd.spaceOrigin[0] * mm[0], nrrd.spaceOrigin[1] * mm[1], nrrd.spaceOrigin[2] * mm[2]),
                  header.find({"space origin"}) != nullptr);
  } else if (nrrd.spaceDim > 0) {
    geometry.remarks.push_back(
        nrrd.spaceDim < 3 ? fmt::format("the header's space has {} dimensions: axes are drawn as stored", nrrd.spaceDim)
                          : "the header's space has no space directions: axes are drawn as stored");
  }
  return geometry;
}

}  // namespace

bool is_nrrd(const fs::path& path) { return start_of(path, 4) == "NRRD"; }

VoxelSource read_nrrd_header(const fs::path& path) {
  const TextHeader header = read_nrrd_lines(path);
  const auto sizes = parse_sizes(header);
  header.need("type");
  const NrrdPointer nrrd = parse_with_teem(header);
  const auto axes = volume_axes(header, *nrrd);
  const Geometry geometry = geometry_of(header, *nrrd, axes);

  VoxelSource source;
  source.header = path;
  source.extents = {sizes[axes[0]], sizes[axes[1]], sizes[axes[2]]};
  source.spacing = geometry.spacing;
  source.placement = geometry.placement;
  source.remarks = geometry.remarks;
  source.component = component_of(header, nrrd->type);
  source.packing = packing_from(header);
  source.order = source.packing == Packing::Text ? std::endian::native : endian_of(header, source.component);
  const Field* detached = header.find({"data file"});
  if (detached == nullptr && !header.ended) {
    header.refuse(0, "the NRRD header does not end", "a blank line, then the data", {},
                  "the file is truncated: copy it again");
  }
  if (detached == nullptr) {
    source.files = {{.path = path, .file_offset = header.end}};
  } else {
    for (auto& file : detached_files(header, *detached, sizes)) source.files.push_back({.path = std::move(file)});
  }
  for (DataFile& file : source.files) skip_into(file, header, source);
  if (header.find({"old min", "old max"}) != nullptr)
    source.remarks.push_back("the header declares quantised values (old min, old max): the stored values are used");
  return source;
}

}  // namespace fastsplat::volume
