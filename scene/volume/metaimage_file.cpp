// SPDX-License-Identifier: Apache-2.0
// Follows MetaIO's own reader: field names, synonyms and defaults are the same.
#include "scene/volume/metaimage_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/lower_case.hpp"
#include "base/read_file.hpp"
#include "base/suggest.hpp"
#include "scene/volume/detached_files.hpp"
#include "scene/volume/lengths.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMaxDimension = 10;  // MetaIO's own limit
constexpr const char* kDamaged = "the header is damaged: copy the file again";
constexpr const char* kCorrect = "correct the header";

using Field = TextHeader::Field;

/// MetaIO's image fields. Programs add others, which do not describe the voxels.
const std::vector<std::string> kFields{"ObjectType",
                                       "ObjectSubType",
                                       "NDims",
                                       "Comment",
                                       "Name",
                                       "ID",
                                       "ParentID",
                                       "Color",
                                       "BinaryData",
                                       "BinaryDataByteOrderMSB",
                                       "ElementByteOrderMSB",
                                       "CompressedData",
                                       "CompressedDataSize",
                                       "CompressionLevel",
                                       "TransformMatrix",
                                       "TransformType",
                                       "Rotation",
                                       "Orientation",
                                       "Offset",
                                       "Position",
                                       "Origin",
                                       "CenterOfRotation",
                                       "AnatomicalOrientation",
                                       "DistanceUnits",
                                       "ElementSpacing",
                                       "ElementSize",
                                       "ElementOrigin",
                                       "ElementDirection",
                                       "DimSize",
                                       "HeaderSize",
                                       "HeaderSizePerSlice",
                                       "Modality",
                                       "SequenceID",
                                       "ImagePosition",
                                       "ElementMin",
                                       "ElementMax",
                                       "ElementNumberOfChannels",
                                       "ElementToIntensityFunctionSlope",
                                       "ElementToIntensityFunctionOffset",
                                       "ElementType",
                                       "ElementDataFile"};

bool is_known(const std::string& name) { return std::find(kFields.begin(), kFields.end(), name) != kFields.end(); }

/// Name and value of "Name = value"; nothing for other lines.
std::optional<std::pair<std::string, std::string>> assignment(const std::string& line) {
  const auto equals = line.find('=');
  if (equals == std::string::npos || is_binary(line)) return std::nullopt;
  return std::pair{trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1))};
}

/// Refuses a field that nearly matches one of MetaIO's as misspelt; other names are free.
void refuse_misspelt(const TextHeader& header, int line, const std::string& name) {
  if (is_known(name)) return;
  // Of one of these the beginning is left out: "Spacing". Programs add fields such as Size of their own.
  const auto without_element = [&name](const std::string& known) {
    constexpr std::size_t kShortest = 7;
    return name.size() >= kShortest && known != "ElementDirection" && lower_case("Element" + name) == lower_case(known);
  };
  const auto meant = std::find_if(kFields.begin(), kFields.end(), [&](const std::string& known) {
    return lower_case(name) == lower_case(known) || without_element(known) ||
           (known.size() > 5 && may_mean(name, known));
  });
  if (meant == kFields.end()) return;
  header.refuse(line, fmt::format("unknown field '{}'", name.substr(0, 40)), {}, {},
                fmt::format("did you mean '{}'?", *meant));
}

/// Reads up to and including ElementDataFile, always the last field.
TextHeader split_header(const fs::path& path) {
  TextHeader header{.path = path, .format = "MetaImage"};
  HeaderLines lines(path);
  for (std::string text; !header.ended && lines.next(text);) {
    if (trimmed(text).empty()) continue;
    const auto field = assignment(text);
    if (!field) {
      header.refuse(lines.number(), "invalid line in a MetaImage header", "'Field = value'",
                    is_binary(text) ? "binary data" : text.substr(0, 40), kDamaged);
    }
    refuse_misspelt(header, lines.number(), field->first);
    header.add(field->first, field->second, lines.number());
    header.ended = field->first == "ElementDataFile";
  }
  header.end = lines.end();
  if (!header.ended) {
    header.refuse(0, "the MetaImage header does not end", "ElementDataFile = LOCAL or a file's name", {},
                  "the file is truncated: copy it again");
  }
  if (says_list(header.need("ElementDataFile").value)) {
    for (std::string text; lines.next(text);) {
      if (!trimmed(text).empty()) header.listed_files.push_back(trimmed(text));
    }
  }
  return header;
}

/// The field by the first of its names that exists, else nullptr. All existing ones must agree.
const Field* agreed(const TextHeader& header, std::initializer_list<const char*> names) {
  const Field* const first = header.find(names);
  for (const char* name : names) {
    const Field* const field = header.find({name});
    if (field == nullptr || words_of(field->value) == words_of(first->value)) continue;
    header.refuse(field->line, fmt::format("'{}' contradicts line {}", name, first->line), first->value.substr(0, 80),
                  field->value.substr(0, 80), "remove the wrong line");
  }
  return first;
}

bool flag_from(const TextHeader& header, std::initializer_list<const char*> names, bool otherwise) {
  const Field* field = agreed(header, names);
  if (field == nullptr) return otherwise;
  const char first = field->value.empty() ? ' ' : field->value[0];  // MetaIO reads only this character
  if (first == 'T' || first == 't' || first == '1') return true;
  if (first == 'F' || first == 'f' || first == '0') return false;
  header.refuse(field->line, "neither true nor false", "True or False", field->value.substr(0, 40), kCorrect);
}

std::vector<double> finite_numbers(const TextHeader& header, const Field& field, std::size_t count) {
  auto numbers = header.numbers(field, count);
  for (const double number : numbers) {
    if (!(std::abs(number) < 1e9)) {
      header.refuse(field.line, "number out of range", "a finite number below 1e9", fmt::format("{}", number),
                    kCorrect);
    }
  }
  return numbers;
}

/// DimSize, all of it; only the first three may be more than 1.
std::vector<std::uint64_t> extents_of(const TextHeader& header) {
  const Field& dimension = header.need("NDims");
  const std::uint64_t count = header.count(dimension, dimension.value);
  if (count < 1 || count > kMaxDimension) {
    header.refuse(dimension.line, "invalid number of dimensions", fmt::format("1..{}", kMaxDimension), dimension.value,
                  kCorrect);
  }
  const Field& field = header.need("DimSize");
  std::vector<std::uint64_t> extents;
  for (const auto& word : words_of(field.value)) extents.push_back(header.count(field, word));
  if (extents.size() != count) {
    header.refuse(field.line, "DimSize and NDims disagree", fmt::format("{} sizes", count),
                  fmt::format("'{}'", field.value.substr(0, 80)), kCorrect);
  }
  const bool flat = std::any_of(extents.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(3, count)),
                                extents.end(), [](std::uint64_t extent) { return extent != 1; });
  const Field* channels = header.find({"ElementNumberOfChannels"});
  if (count < 3 || flat || (channels != nullptr && channels->value != "1")) {
    header.refuse(channels != nullptr && channels->value != "1" ? channels->line : field.line,
                  "not a volume of one scalar per voxel", "3 dimensions (further ones of size 1), 1 channel",
                  fmt::format("DimSize {}, {} channels", field.value.substr(0, 80),
                              channels != nullptr ? channels->value.substr(0, 20) : "1"),
                  "extract one component or time step first");
  }
  return extents;
}

Component component_of(const TextHeader& header) {
  static const std::map<std::string, Component> types{
      {"MET_CHAR", Component::I8},    {"MET_UCHAR", Component::U8},      {"MET_SHORT", Component::I16},
      {"MET_USHORT", Component::U16}, {"MET_INT", Component::I32},       {"MET_UINT", Component::U32},
      {"MET_LONG", Component::I32},   {"MET_ULONG", Component::U32},     {"MET_FLOAT", Component::F32},
      {"MET_DOUBLE", Component::F64}, {"MET_LONG_LONG", Component::I64}, {"MET_ULONG_LONG", Component::U64}};
  // a LONG has 4 bytes in these files
  const Field& field = header.need("ElementType");
  const auto found = types.find(field.value);
  if (found == types.end()) {
    header.refuse(field.line, "unsupported voxel type",
                  "MET_CHAR, MET_SHORT, MET_INT, MET_LONG_LONG, their MET_U..., MET_FLOAT or MET_DOUBLE",
                  field.value.substr(0, 40), "convert it to MET_FLOAT");
  }
  return found->second;
}

/// ITK parses these two fields but does not apply them. Files that need them are refused.
void refuse_scaling(const TextHeader& header) {
  for (const auto& [name, neutral] :
       {std::pair{"ElementToIntensityFunctionSlope", 1.0}, {"ElementToIntensityFunctionOffset", 0.0}}) {
    const Field* field = header.find({name});
    if (field == nullptr || finite_numbers(header, *field, 1)[0] == neutral) continue;
    header.refuse(field->line, fmt::format("'{}' is not supported", name), fmt::format("{}", neutral),
                  field->value.substr(0, 40), "scale the values themselves, and remove the line");
  }
}

/// Millimetres per unit of length of the header.
double unit_of(const TextHeader& header, std::vector<std::string>& remarks) {
  const Field* field = header.find({"DistanceUnits"});
  if (field == nullptr || field->value == "?") return 1.0;
  const auto mm = mm_per_unit(field->value);
  if (!mm) remarks.push_back(fmt::format("the header's DistanceUnits '{}' is unknown: mm is used", field->value));
  return mm.value_or(1.0);
}

void read_spacing(const TextHeader& header, std::size_t dimensions, double mm, VoxelSource& source) {
  const Field* field = header.find({"ElementSpacing", "ElementSize"});
  const auto all = field != nullptr ? header.numbers(*field, dimensions) : std::vector<double>(dimensions, 1.0);
  for (std::size_t a = 0; a < 3; ++a) {
    source.spacing[a] = usable_length(all[a] * mm);
    note_unusable_length(fmt::format("spacing of axis {}", a + 1), all[a] * mm, source.spacing[a], source.remarks);
  }
}

/// nullopt if the header has none of the fields.
std::optional<Placement> placement_of(const TextHeader& header, std::size_t dimensions, double mm) {
  const Field* matrix = agreed(header, {"TransformMatrix", "Rotation", "Orientation"});
  const Field* origin = agreed(header, {"ImagePosition", "Offset", "Position", "Origin"});
  if (matrix == nullptr && origin == nullptr) return std::nullopt;
  const glm::dvec3 ras(-1, -1, 1);
  Placement placement{.direction = {glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)}};
  if (matrix != nullptr) {
    const auto numbers = finite_numbers(header, *matrix, dimensions * dimensions);
    for (std::size_t a = 0; a < 3; ++a) {  // one axis direction per row
      const double* row = &numbers[a * dimensions];
      placement.direction[a] = ras * glm::dvec3(row[0], row[1], row[2]);
    }
    if (!spans_space(placement.direction)) {
      header.refuse(matrix->line, "the axes are not independent", "three independent directions",
                    matrix->value.substr(0, 120), kCorrect);
    }
  }
  placement.has_origin = origin != nullptr;
  if (origin != nullptr) {
    const auto numbers = finite_numbers(header, *origin, dimensions);
    placement.origin = ras * glm::dvec3(numbers[0], numbers[1], numbers[2]) * mm;
  }
  return placement;
}

/// ITK places a volume by its matrix alone. Adds a remark for each field of another kind, as for an orientation that is
/// declared only in letters.
void note_orientation(const TextHeader& header, std::vector<std::string>& remarks) {
  for (const char* name : {"ElementOrigin", "ElementDirection"}) {
    if (const Field* field = header.find({name}))
      remarks.push_back(fmt::format("the header's {} {} is not applied", name, field->value.substr(0, 80)));
  }
  const Field* letters = header.find({"AnatomicalOrientation"});
  if (letters == nullptr || header.find({"TransformMatrix", "Rotation", "Orientation"}) != nullptr) return;
  if (letters->value.find('?') != std::string::npos || letters->value == "RAI") return;
  remarks.push_back(fmt::format("the header's AnatomicalOrientation {} has no TransformMatrix and is not applied",
                                letters->value.substr(0, 20)));
}

/// HeaderSize: bytes of the file before the voxels; -1: the voxels are the end of the file.
void skip_header(DataFile& file, const TextHeader& header, const VoxelSource& source) {
  if (const Field* slices = header.find({"HeaderSizePerSlice"}); slices != nullptr && slices->value != "0")
    header.refuse(slices->line, "HeaderSizePerSlice is not supported", "0", slices->value.substr(0, 40),
                  "remove the slices' headers from the data, and the line");
  const Field* field = header.find({"HeaderSize"});
  if (field == nullptr || field->value == "0") return;
  if (source.packing != Packing::Plain) {
    header.refuse(field->line, "HeaderSize with compressed data or text is not supported", "HeaderSize = 0",
                  field->value.substr(0, 40), "leave the line out");
  }
  require_readable_file(file.path);
  const std::uint64_t size = fs::file_size(file.path);
  std::uint64_t need = size_of(source.component);
  for (const std::uint64_t extent : source.extents) need *= std::min<std::uint64_t>(extent, 65536);
  need /= source.files.size();
  const bool at_end = field->value == "-1";
  const std::uint64_t header_end = file.file_offset;
  file.file_offset = at_end ? size - std::min(size, need) : header.count(*field, field->value);
  if (file.file_offset < header_end) {
    header.refuse(field->line, "the voxels would begin inside the header", fmt::format("at least {}", header_end),
                  fmt::format("{}", file.file_offset), "leave the line out, or copy the file again");
  }
  if (file.file_offset > size || (at_end && need > size)) {
    header.refuse(field->line, "the header declares more than the file holds", fmt::format("{} bytes", need),
                  fmt::format("{} bytes", size), "download or copy the file again");
  }
}

}  // namespace

bool is_metaimage(const fs::path& path) {
  HeaderLines lines(path);
  constexpr int kFirstLines = 100;
  for (std::string text; lines.number() < kFirstLines && lines.next(text);) {
    const auto field = assignment(text);
    if (!field) return false;
    if (is_known(field->first)) return true;
  }
  return false;
}

VoxelSource read_metaimage_header(const fs::path& path) {
  const TextHeader header = split_header(path);
  if (const Field* type = header.find({"ObjectType"}); type != nullptr && type->value != "Image")
    header.refuse(type->line, "not an image", "ObjectType = Image", type->value.substr(0, 40),
                  "name a file of an image");
  const auto extents = extents_of(header);
  VoxelSource source;
  source.header = path;
  source.component = component_of(header);
  source.extents = {extents[0], extents[1], extents[2]};
  const double mm = unit_of(header, source.remarks);
  read_spacing(header, extents.size(), mm, source);
  source.placement = placement_of(header, extents.size(), mm);
  note_orientation(header, source.remarks);
  refuse_scaling(header);
  const bool big = flag_from(header, {"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false);
  source.order = big ? std::endian::big : std::endian::little;
  if (flag_from(header, {"CompressedData"}, false)) source.packing = Packing::Zlib;
  if (!flag_from(header, {"BinaryData"}, true)) source.packing = Packing::Text;
  const Field& data = header.need("ElementDataFile");
  if (lower_case(data.value) == "local") {
    source.files = {{.path = path, .file_offset = header.end}};
  } else {
    for (auto& file : detached_files(header, data, extents)) source.files.push_back({.path = std::move(file)});
  }
  for (DataFile& file : source.files) skip_header(file, header, source);
  return source;
}

}  // namespace fastsplat::volume
