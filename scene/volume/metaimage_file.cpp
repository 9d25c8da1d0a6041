// Written after MetaIO's own reader: names of fields, their synonyms and defaults are its.
#include "scene/volume/metaimage_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>

#include "base/error.hpp"
#include "base/number_text.hpp"
#include "scene/volume/byte_reader.hpp"
#include "scene/volume/detached_file.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxHeader = std::size_t{1} << 20;
constexpr std::uint64_t kMaxDimension = 10;  // MetaIO's own limit
constexpr const char* kDamaged = "the header is damaged: copy the file again";
constexpr const char* kCorrect = "correct the header";

struct Field {
  std::string value;
  int line = 0;
};

struct Header {
  fs::path path;
  std::map<std::string, Field> fields;
  std::uint64_t end = 0;  // first byte after the header

  [[noreturn]] void refuse(int line, std::string what, std::string expected, std::string got, std::string fix) const {
    throw_input({.where = line > 0 ? fmt::format("{}:{}", path.string(), line) : path.string(),
                 .what = std::move(what),
                 .expected = std::move(expected),
                 .got = std::move(got),
                 .fix = std::move(fix)});
  }
  /// By the first of its names that is there.
  const Field* find(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      if (const auto found = fields.find(name); found != fields.end()) return &found->second;
    }
    return nullptr;
  }
  const Field& need(const char* name) const {
    const Field* field = find({name});
    if (field == nullptr)
      refuse(0, fmt::format("the MetaImage header has no '{}'", name), {}, {}, "add the line to the header");
    return *field;
  }
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Up to and including ElementDataFile, which is the last field whatever follows.
Header split_header(const fs::path& path) {
  Header header;
  header.path = path;
  const std::string head = start_of(path, kMaxHeader);
  for (int line = 1; header.end < head.size(); ++line) {
    const std::size_t end = std::min(head.find('\n', header.end), head.size());
    const std::string text = head.substr(header.end, end - header.end);
    header.end = std::min(end + 1, head.size());
    if (trimmed(text).empty()) continue;
    const auto equals = text.find('=');
    const bool bad = std::any_of(text.begin(), text.end(),
                                 [](unsigned char c) { return c == 0x7f || (c < 0x20 && c != '\t' && c != '\r'); });
    if (equals == std::string::npos || bad) {
      header.refuse(line, "not a line of a MetaImage header", "'Field = value'",
                    bad ? "binary data" : text.substr(0, 40), kDamaged);
    }
    const std::string name = trimmed(text.substr(0, equals));
    if (!header.fields.emplace(name, Field{trimmed(text.substr(equals + 1)), line}).second)
      header.refuse(line, fmt::format("'{}' is given twice", name.substr(0, 40)), {}, {}, "remove one of the lines");
    if (name == "ElementDataFile") return header;
  }
  header.refuse(0, "the MetaImage header does not end", "ElementDataFile = LOCAL or a file's name", {},
                "the file is truncated: copy it again");
}

std::uint64_t count_from(const Header& header, const Field& field, const std::string& word) {
  std::uint64_t value = 0;
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || rest != word.data() + word.size())
    header.refuse(field.line, "not a size that can be handled", "a whole number", word.substr(0, 80), kCorrect);
  return value;
}

bool flag_from(const Header& header, std::initializer_list<const char*> names, bool otherwise) {
  const Field* field = header.find(names);
  if (field == nullptr) return otherwise;
  const char first = field->value.empty() ? ' ' : field->value[0];  // MetaIO looks at no more
  if (first == 'T' || first == 't' || first == '1') return true;
  if (first == 'F' || first == 'f' || first == '0') return false;
  header.refuse(field->line, "neither yes nor no", "True or False", field->value.substr(0, 40), kCorrect);
}

std::vector<std::string> words_of(const Field& field) {
  std::istringstream words(field.value);
  return {std::istream_iterator<std::string>(words), {}};
}

std::vector<double> numbers_from(const Header& header, const Field& field, std::size_t count) {
  const auto words = words_of(field);
  if (words.size() != count) {
    header.refuse(field.line, "not as many numbers as NDims asks for", fmt::format("{}", count),
                  fmt::format("{}", words.size()), kCorrect);
  }
  std::vector<double> numbers;
  for (const auto& word : words) {
    const auto number = number_from(word);
    if (!number || !(std::abs(*number) < 1e9))
      header.refuse(field.line, "not a number that can be handled", "a finite number", word.substr(0, 40), kCorrect);
    numbers.push_back(*number);
  }
  return numbers;
}

/// DimSize, all of it; only the first three may be more than 1.
std::vector<std::uint64_t> extents_of(const Header& header) {
  const Field& dimension = header.need("NDims");
  const std::uint64_t count = count_from(header, dimension, dimension.value);
  if (count < 1 || count > kMaxDimension) {
    header.refuse(dimension.line, "an impossible number of dimensions", fmt::format("1..{}", kMaxDimension),
                  dimension.value, kCorrect);
  }
  const Field& field = header.need("DimSize");
  std::vector<std::uint64_t> extents;
  for (const auto& word : words_of(field)) extents.push_back(count_from(header, field, word));
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
                  "take out one component or time step first");
  }
  return extents;
}

Component component_of(const Header& header) {
  static const std::map<std::string, Component> types{
      {"MET_CHAR", Component::I8},    {"MET_UCHAR", Component::U8},  {"MET_SHORT", Component::I16},
      {"MET_USHORT", Component::U16}, {"MET_INT", Component::I32},   {"MET_UINT", Component::U32},
      {"MET_LONG", Component::I32},   {"MET_ULONG", Component::U32}, {"MET_FLOAT", Component::F32},
      {"MET_DOUBLE", Component::F64}};  // a LONG has 4 bytes in these files
  const Field& field = header.need("ElementType");
  const auto found = types.find(field.value);
  if (found == types.end()) {
    header.refuse(field.line, "a voxel type that cannot be read",
                  "MET_CHAR, MET_UCHAR, MET_SHORT, MET_USHORT, MET_INT, MET_UINT, MET_FLOAT or MET_DOUBLE",
                  field.value.substr(0, 40), "convert it to MET_FLOAT");
  }
  return found->second;
}

/// ITK knows the two fields and does not apply them; what is not applied here either is not passed over in silence.
void refuse_scaling(const Header& header) {
  for (const auto& [name, neutral] :
       {std::pair{"ElementToIntensityFunctionSlope", 1.0}, {"ElementToIntensityFunctionOffset", 0.0}}) {
    const Field* field = header.find({name});
    if (field == nullptr || numbers_from(header, *field, 1)[0] == neutral) continue;
    header.refuse(field->line, fmt::format("'{}' is not applied", name), fmt::format("{}", neutral),
                  field->value.substr(0, 40), "scale the values themselves, and remove the line");
  }
}

void read_spacing(const Header& header, std::size_t dimensions, VoxelSource& source) {
  const Field* field = header.find({"ElementSpacing", "ElementSize"});
  if (field == nullptr) return;
  const auto all = numbers_from(header, *field, dimensions);
  for (std::size_t a = 0; a < 3; ++a) {
    source.spacing[a] = std::abs(all[a]);
    if (all[a] < 0.0)
      source.remarks.push_back(
          fmt::format("the header's spacing of axis {} is {}: {} mm are taken", a + 1, all[a], source.spacing[a]));
  }
}

/// Nothing where the header has none of the fields.
std::optional<Placement> placement_of(const Header& header, std::size_t dimensions) {
  const Field* matrix = header.find({"TransformMatrix", "Rotation", "Orientation"});
  const Field* origin = header.find({"Offset", "Position", "Origin"});
  if (matrix == nullptr && origin == nullptr) return std::nullopt;
  const glm::dvec3 ras(-1, -1, 1);
  Placement placement{.direction = {glm::dvec3(-1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1)}};
  if (matrix != nullptr) {
    const auto numbers = numbers_from(header, *matrix, dimensions * dimensions);
    for (std::size_t a = 0; a < 3; ++a) {  // the direction of one axis after the other
      const double* row = &numbers[a * dimensions];
      placement.direction[a] = ras * glm::dvec3(row[0], row[1], row[2]);
    }
    if (!spans_space(placement.direction)) {
      header.refuse(matrix->line, "the axes do not span space", "three independent directions",
                    matrix->value.substr(0, 120), kCorrect);
    }
  }
  placement.has_origin = origin != nullptr;
  if (origin != nullptr) {
    const auto numbers = numbers_from(header, *origin, dimensions);
    placement.origin = ras * glm::dvec3(numbers[0], numbers[1], numbers[2]);
  }
  return placement;
}

/// HeaderSize: bytes before the voxels in a file of their own; -1: they are the file's end.
std::uint64_t bytes_before(const Header& header, const VoxelSource& source) {
  const Field* field = header.find({"HeaderSize"});
  if (field == nullptr || field->value == "0") return 0;
  if (source.packing != Packing::Plain) {
    header.refuse(field->line, "HeaderSize with compressed data or text is not supported", "HeaderSize = 0",
                  field->value.substr(0, 40), "leave the line out");
  }
  std::error_code error;
  const std::uint64_t size = fs::file_size(source.data, error);
  if (error)
    header.refuse(field->line, "cannot read the data file: " + error.message(), {}, {},
                  "keep the data file beside its header");
  std::uint64_t need = size_of(source.component);
  for (const std::uint64_t extent : source.extents) need *= std::min<std::uint64_t>(extent, 65536);
  const bool at_end = field->value == "-1";
  const std::uint64_t before = at_end ? size - std::min(size, need) : count_from(header, *field, field->value);
  if (before > size || (at_end && need > size)) {
    header.refuse(field->line, "the header promises more than the file holds", fmt::format("{} bytes", need),
                  fmt::format("{} bytes", size), "download or copy the file again");
  }
  return before;
}

}  // namespace

bool is_metaimage(const fs::path& path) {
  const std::string start = start_of(path, 64);
  const auto end = start.find_first_of("= \t\r\n");
  if (end == std::string::npos) return false;
  const auto equals = start.find_first_not_of(" \t", end);
  if (equals == std::string::npos || start[equals] != '=') return false;
  const std::string name = start.substr(0, end);
  static const std::vector<std::string> names{
      "ObjectType", "NDims",      "Comment",     "ObjectSubType", "Name",          "ID",
      "DimSize",    "BinaryData", "ElementType", "TransformType", "CompressedData"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

VoxelSource read_metaimage_header(const fs::path& path) {
  const Header header = split_header(path);
  if (const Field* type = header.find({"ObjectType"}); type != nullptr && type->value != "Image")
    header.refuse(type->line, "not an image", "ObjectType = Image", type->value.substr(0, 40), "name the image's file");
  const auto extents = extents_of(header);
  VoxelSource source;
  source.header = path;
  source.component = component_of(header);
  source.extents = {extents[0], extents[1], extents[2]};
  read_spacing(header, extents.size(), source);
  source.placement = placement_of(header, extents.size());
  refuse_scaling(header);
  const bool big = flag_from(header, {"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false);
  source.order = big ? std::endian::big : std::endian::little;
  if (flag_from(header, {"CompressedData"}, false)) source.packing = Packing::Zlib;
  if (!flag_from(header, {"BinaryData"}, true)) source.packing = Packing::Text;
  const Field& data = header.need("ElementDataFile");
  const bool local = data.value == "LOCAL" || data.value == "Local" || data.value == "local";
  source.data = local ? path : detached_file(path, fmt::format("{}:{}", path.string(), data.line), data.value);
  source.file_offset = local ? header.end : bytes_before(header, source);
  return source;
}

}  // namespace fastsplat::volume
