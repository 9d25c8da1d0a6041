// Teem interprets the header's types, spacings and directions; it is handed a header of its own, made of the checked
// fields only, and never opens a file: it trusts sizes, and a detached header may name any file of the machine.
#include "scene/volume/nrrd_file.hpp"

#include <fmt/format.h>
#include <teem/nrrd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <sstream>

#include "base/error.hpp"
#include "scene/volume/byte_reader.hpp"
#include "scene/volume/detached_file.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxHeader = std::size_t{1} << 20;
constexpr std::size_t kMaxField = 4096;
constexpr int kMaxDimension = 16;

[[noreturn]] void refuse(const fs::path& path, int line, std::string what, std::string expected, std::string got,
                         std::string fix) {
  throw_input({.where = line > 0 ? fmt::format("{}:{}", path.string(), line) : path.string(),
               .what = std::move(what),
               .expected = std::move(expected),
               .got = std::move(got),
               .fix = std::move(fix)});
}

struct Field {
  std::string value;
  int line = 0;
};

struct Header {
  fs::path path;
  std::map<std::string, Field> fields;  // names in lower case without blanks, as teem compares them
  std::uint64_t end = 0;                // first byte after the header
  bool blank_line = false;              // attached data follow

  const Field* find(const std::string& name) const {
    const auto found = fields.find(name);
    return found == fields.end() ? nullptr : &found->second;
  }
  const Field& need(const std::string& name) const {
    const Field* field = find(name);
    if (field == nullptr)
      refuse(path, 0, fmt::format("the NRRD header has no '{}'", name), {}, {}, "add the line to the header");
    return *field;
  }
};

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::string canonical_name(std::string text) {
  std::erase_if(text, [](unsigned char c) { return c == ' ' || c == '-' || c == '_'; });
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The header's text up to and including the blank line, or the whole of a detached one.
Header split_header(const fs::path& path) {
  Header header;
  header.path = path;
  const std::string head = start_of(path, kMaxHeader);
  std::size_t at = 0;
  for (int line = 1; at < head.size(); ++line) {
    const std::size_t end = std::min(head.find('\n', at), head.size());
    std::string text = head.substr(at, end - at);
    at = std::min(end + 1, head.size());
    if (!text.empty() && text.back() == '\r') text.pop_back();
    if (text.empty()) {
      header.blank_line = true;
      break;
    }
    if (line == 1 || text[0] == '#') continue;
    const auto colon = text.find(':');
    const bool bad = std::any_of(text.begin(), text.end(),
                                 [](unsigned char c) { return c == 0 || c == 0x7f || (c < 0x20 && c != '\t'); });
    if (colon == std::string::npos || bad) {
      refuse(path, line, "not a line of an NRRD header", "'field: value', 'key:=value' or a comment",
             bad ? "binary data" : text.substr(0, 40), "the header is damaged: copy the file again");
    }
    if (text.compare(colon, 2, ":=") == 0) continue;  // a key of the user's, nothing about the data
    const std::string name = canonical_name(text.substr(0, colon));
    if (!header.fields.emplace(name, Field{trimmed(text.substr(colon + 1)), line}).second) {
      refuse(path, line, fmt::format("'{}' is given twice", text.substr(0, colon)), {}, {}, "remove one of the lines");
    }
  }
  if (!header.blank_line && head.size() == kMaxHeader) {
    refuse(path, 0, "the NRRD header does not end", fmt::format("a blank line within {} bytes", kMaxHeader), {},
           "copy the file again");
  }
  header.end = at;
  return header;
}

std::uint64_t parse_count(const Header& header, const Field& field, const std::string& word) {
  std::uint64_t value = 0;
  const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || rest != word.data() + word.size()) {
    refuse(header.path, field.line, "not a size that can be handled", "a whole number", word.substr(0, 80),
           "correct the header");
  }
  return value;
}

std::vector<std::uint64_t> parse_sizes(const Header& header) {
  const Field& dimension = header.need("dimension");
  const std::uint64_t axes = parse_count(header, dimension, dimension.value);
  if (axes < 1 || axes > kMaxDimension) {
    refuse(header.path, dimension.line, "an impossible dimension", fmt::format("1..{}", kMaxDimension), dimension.value,
           "correct the header");
  }
  const Field& field = header.need("sizes");
  std::vector<std::uint64_t> sizes;
  std::istringstream words(field.value);
  for (std::string word; words >> word && sizes.size() <= axes;) sizes.push_back(parse_count(header, field, word));
  if (sizes.size() != axes) {
    refuse(header.path, field.line, "sizes and dimension disagree", fmt::format("{} sizes", axes),
           fmt::format("'{}'", field.value.substr(0, 80)), "correct the header");
  }
  for (const std::uint64_t size : sizes) {
    if (size < 1 || size > 65535) {
      refuse(header.path, field.line, "an axis has an impossible number of voxels", "1..65535", fmt::format("{}", size),
             "check the header's sizes");
    }
  }
  return sizes;
}

/// The three axes that are the volume's: of more, those that are 1 long are dropped, the slow ones first.
std::array<unsigned, 3> volume_axes(const Header& header, const std::vector<std::uint64_t>& sizes) {
  std::vector<unsigned> axes(sizes.size());
  for (unsigned a = 0; a < axes.size(); ++a) axes[a] = a;
  for (auto a = axes.size(); a-- > 0 && axes.size() > 3;) {
    if (sizes[axes[a]] == 1) axes.erase(axes.begin() + static_cast<std::ptrdiff_t>(a));
  }
  if (axes.size() != 3) {
    refuse(header.path, header.need("sizes").line, "not a volume of one scalar per voxel", "3 axes (others of size 1)",
           fmt::format("sizes {}", header.need("sizes").value.substr(0, 80)),
           "take out one component or time step first (unu slice)");
  }
  return {axes[0], axes[1], axes[2]};
}

/// A header of the checked fields for teem: attached, raw, so that it looks for no other file.
std::string header_for_teem(const Header& header) {
  std::string text = "NRRD0005\n";
  for (const auto& [name, written] : {std::pair{"type", "type"},
                                      {"dimension", "dimension"},
                                      {"space", "space"},
                                      {"spacedimension", "space dimension"},
                                      {"sizes", "sizes"},
                                      {"spacings", "spacings"},
                                      {"spacedirections", "space directions"},
                                      {"spaceorigin", "space origin"}}) {
    const Field* field = header.find(name);
    if (field == nullptr) continue;
    if (field->value.size() > kMaxField)
      refuse(header.path, field->line, fmt::format("'{}' is too long", written), {}, {}, "correct the header");
    text += fmt::format("{}: {}\n", written, field->value);
  }
  return text + "endian: little\nencoding: raw\n\n";
}

using NrrdPointer = std::unique_ptr<Nrrd, decltype(&nrrdNuke)>;

std::string biff_message() {
  const std::unique_ptr<char, decltype(&std::free)> text(biffGetDone(NRRD), &std::free);
  // The last line is the cause; those before say which of teem's functions were under way.
  std::string cause;
  std::istringstream lines(text ? text.get() : "");
  for (std::string line; std::getline(lines, line);) {
    if (!trimmed(line).empty()) cause = trimmed(line);
  }
  const auto colon = cause.find("] ");
  return colon == std::string::npos ? cause : cause.substr(colon + 2);
}

NrrdPointer parse_with_teem(const Header& header) {
  static std::mutex biff_is_global;
  const std::lock_guard lock(biff_is_global);
  nrrdStateVerboseIO = 0;
  NrrdPointer nrrd(nrrdNew(), &nrrdNuke);
  const std::unique_ptr<NrrdIoState, decltype(&nrrdIoStateNix)> io(nrrdIoStateNew(), &nrrdIoStateNix);
  io->skipData = AIR_TRUE;
  if (nrrdStringRead(nrrd.get(), header_for_teem(header).c_str(), io.get()) != 0) {
    refuse(header.path, 0, "not a valid NRRD header: " + biff_message(), {}, {}, "correct the header");
  }
  return nrrd;
}

Component component_of(const Header& header, int type) {
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
    case nrrdTypeFloat:
      return Component::F32;
    case nrrdTypeDouble:
      return Component::F64;
    default:
      refuse(header.path, header.need("type").line, "a voxel type that cannot be read",
             "8, 16 or 32-bit integers, float or double", header.need("type").value.substr(0, 40),
             "convert it (unu convert -t float)");
  }
}

std::endian endian_of(const Header& header, Component component) {
  const Field* field = header.find("endian");
  if (field == nullptr && size_of(component) == 1) return std::endian::native;
  const std::string value = lower(header.need("endian").value);
  if (value == "little") return std::endian::little;
  if (value == "big") return std::endian::big;
  refuse(header.path, field->line, "unknown byte order", "little or big", field->value.substr(0, 40),
         "correct the header");
}

Packing packing_from(const Header& header) {
  const Field& field = header.need("encoding");
  const std::string value = lower(field.value);
  if (value == "raw") return Packing::Plain;
  if (value == "gzip" || value == "gz") return Packing::Gzip;
  if (value == "bzip2" || value == "bz2") return Packing::Bzip2;
  if (value == "hex") return Packing::Hex;
  if (value == "text" || value == "txt" || value == "ascii") return Packing::Text;
  refuse(header.path, field.line, "an encoding that cannot be read", "raw, gzip, bzip2, hex or ascii",
         field.value.substr(0, 40), "convert it (unu save -f nrrd -e gzip)");
}

/// Resolves `byte skip` and refuses what would need more than that.
std::uint64_t byte_skip(const Header& header, const VoxelSource& source) {
  if (const Field* lines = header.find("lineskip"); lines != nullptr && lines->value != "0") {
    refuse(header.path, lines->line, "skipping lines of the data file is not supported", "line skip: 0",
           lines->value.substr(0, 40), "use byte skip");
  }
  const Field* field = header.find("byteskip");
  if (field == nullptr || field->value == "0") return 0;
  if (source.packing != Packing::Plain) {
    refuse(header.path, field->line, "byte skip with an encoding other than raw is not supported", "byte skip: 0",
           field->value.substr(0, 40), "convert it (unu save -f nrrd -e gzip)");
  }
  std::error_code error;
  const std::uint64_t size = fs::file_size(source.data, error);
  if (error)
    refuse(header.path, field->line, "cannot read the data file: " + error.message(), {}, {},
           "keep the data file beside its header");
  if (field->value != "-1") {
    const std::uint64_t skip = parse_count(header, *field, field->value);
    if (skip > size) {
      refuse(header.path, field->line, "byte skip leads past the end of the file", fmt::format("at most {}", size),
             fmt::format("{}", skip), "correct the header");
    }
    return skip;
  }
  std::uint64_t need = size_of(source.component);
  for (const std::uint64_t extent : source.extents) need *= extent;
  if (size < source.file_offset + need) {
    refuse(header.path, field->line, "the header promises more than the file holds", fmt::format("{} bytes", need),
           fmt::format("{} bytes", size), "download or copy the file again");
  }
  return size - need - source.file_offset;
}

/// Sign of each world axis of `space` towards right, anterior, superior; nothing for spaces that are not anatomical.
std::optional<std::array<double, 3>> towards_ras(int space) {
  switch (space) {
    case nrrdSpaceRightAnteriorSuperior:
      return {{1, 1, 1}};
    case nrrdSpaceLeftAnteriorSuperior:
      return {{-1, 1, 1}};
    case nrrdSpaceLeftPosteriorSuperior:
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

/// `says_spacings`: the header has the field; without it 1 mm is what everyone takes.
Geometry geometry_of(const Nrrd& nrrd, const std::array<unsigned, 3>& axes, bool says_spacings) {
  Geometry geometry;
  std::array<std::array<double, NRRD_SPACE_DIM_MAX>, 3> directions{};
  bool all_directed = nrrd.spaceDim == 3;
  for (std::size_t a = 0; a < 3; ++a) {
    double spacing = 1.0;
    const int status = nrrdSpacingCalculate(&nrrd, axes[a], &spacing, directions[a].data());
    const bool known = status != nrrdSpacingStatusNone && status != nrrdSpacingStatusUnknown && !std::isnan(spacing);
    if (!known) spacing = 1.0;
    if (!known && says_spacings)
      geometry.remarks.push_back(fmt::format("the header's spacing of axis {} is no number: 1 mm is taken", a + 1));
    if (spacing < 0.0)
      geometry.remarks.push_back(
          fmt::format("the header's spacing of axis {} is {}: {} mm are taken", a + 1, spacing, -spacing));
    all_directed = all_directed && status == nrrdSpacingStatusDirection;
    geometry.spacing[a] = std::abs(spacing);
  }
  const auto signs = towards_ras(nrrd.space);
  if (!all_directed || !signs) return geometry;
  Placement placement;
  for (int world = 0; world < 3; ++world) {
    const double sign = (*signs)[static_cast<std::size_t>(world)];
    for (std::size_t a = 0; a < 3; ++a)
      placement.direction[a][world] = sign * directions[a][static_cast<std::size_t>(world)];
    const double origin = sign * nrrd.spaceOrigin[world];
    placement.has_origin = placement.has_origin && std::abs(origin) < 1e9;
    placement.origin[world] = origin;
  }
  if (spans_space(placement.direction)) geometry.placement = placement;
  return geometry;
}

}  // namespace

bool is_nrrd(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic(4, '\0');
  return file.read(magic.data(), 4) && magic == "NRRD";
}

VoxelSource read_nrrd_header(const fs::path& path) {
  const Header header = split_header(path);
  const auto sizes = parse_sizes(header);
  const auto axes = volume_axes(header, sizes);
  header.need("type");
  const NrrdPointer nrrd = parse_with_teem(header);
  const Geometry geometry = geometry_of(*nrrd, axes, header.find("spacings") != nullptr);

  VoxelSource source;
  source.header = path;
  source.extents = {sizes[axes[0]], sizes[axes[1]], sizes[axes[2]]};
  source.spacing = geometry.spacing;
  source.placement = geometry.placement;
  source.remarks = geometry.remarks;
  source.component = component_of(header, nrrd->type);
  source.packing = packing_from(header);
  source.order = source.packing == Packing::Text ? std::endian::native : endian_of(header, source.component);
  const Field* detached = header.find("datafile");
  if (detached == nullptr && !header.blank_line) {
    refuse(path, 0, "the NRRD header does not end", "a blank line, then the data", {},
           "the file is truncated: copy it again");
  }
  source.data = detached == nullptr
                    ? path
                    : detached_file(path, fmt::format("{}:{}", path.string(), detached->line), detached->value);
  source.file_offset = detached != nullptr ? 0 : header.end;
  source.file_offset += byte_skip(header, source);
  return source;
}

}  // namespace fastsplat::volume
