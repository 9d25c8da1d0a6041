// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/volume_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <optional>

#include "base/machine_error.hpp"
#include "base/read_file.hpp"
#include "base/suggest.hpp"
#include "scene/volume/foreign_file.hpp"
#include "scene/volume/metaimage_file.hpp"
#include "scene/volume/nifti_file.hpp"
#include "scene/volume/nrrd_file.hpp"
#include "scene/volume/synthetic.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 3> kScans{"ch2", "ch2bet", "inia19-t1-brain"};
constexpr const char* kScanFolder = "/usr/share/mricron/templates";

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

struct SyntheticName {
  std::string name;
  int size;
};

/// "shells:64" or "shells"; nullopt unless the part before the colon is a built-in volume.
std::optional<SyntheticName> as_synthetic(const std::string& text) {
  const auto colon = text.find(':');
  const std::string name = text.substr(0, colon);
  if (!contains(synthetic_names(), name)) return std::nullopt;
  if (colon == std::string::npos) return SyntheticName{name, default_synthetic_size(name)};
  int size = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + colon + 1, end, size);
  if (error != std::errc{} || rest != end) {
    throw_input({.where = name,
                 .what = "not a size",
                 .expected = "a whole number",
                 .got = "'" + text.substr(colon + 1) + "'",
                 .fix = fmt::format("for example {}:{}", name, default_synthetic_size(name))});
  }
  return SyntheticName{name, size};
}

/// The file of a known scan.
fs::path find_scan(const std::string& name) {
  std::vector<fs::path> folders;
  if (const char* own = std::getenv("FASTSPLAT_DATA"); own != nullptr && *own != '\0') folders.emplace_back(own);
  folders.emplace_back(kScanFolder);
  std::error_code ignored;
  for (const auto& folder : folders) {
    for (const char* ending : {".nii.gz", ".nii", ".nrrd"}) {
      const fs::path path = folder / (name + ending);
      if (fs::is_regular_file(path, ignored)) return path;
    }
  }
  throw_machine({.where = name,
                 .what = "this scan is not installed",
                 .expected = {},
                 .got = {},
                 .fix = "apt-get install mricron-data (or set FASTSPLAT_DATA to a folder that holds it), or use a "
                        "built-in volume such as shells:64"});
}

/// The file the user means. An existing file takes precedence over a known name.
fs::path find_file(const std::string& text) {
  std::error_code ignored;
  if (fs::is_regular_file(text, ignored)) return text;
  if (std::find(kScans.begin(), kScans.end(), text) != kScans.end()) return find_scan(text);
  const bool like_a_path = text.find_first_of("/.") != std::string::npos;
  if (!text.empty() && (like_a_path || fs::exists(text, ignored))) return text;
  throw_input({.where = text.empty() ? "volume" : text,
               .what = "no such file or built-in volume",
               .expected = {},
               .got = {},
               .fix = suggestion(text.substr(0, text.find(':')), known_volume_names())});
}

std::optional<VoxelSource> header_in(const fs::path& path) {
  require_readable_file(path);
  if (is_nrrd(path)) return read_nrrd_header(path);
  if (is_metaimage(path)) return read_metaimage_header(path);
  if (is_nifti(path)) return read_nifti_header(path);
  return std::nullopt;
}

/// Reads the header beside `path` that names it as its data file: ct.hdr for ct.img.
std::optional<VoxelSource> header_beside(const fs::path& path) {
  fs::path stem = path;
  if (stem.extension() == ".gz") stem.replace_extension();
  std::error_code error;
  for (const char* ending : {".hdr", ".nhdr", ".mhd"}) {
    const fs::path beside = stem.replace_extension(ending);
    if (!fs::is_regular_file(beside, error)) continue;
    auto source = header_in(beside);
    const auto is_this = [&](const DataFile& file) { return fs::equivalent(file.path, path, error); };
    if (source && std::any_of(source->files.begin(), source->files.end(), is_this)) return source;
  }
  return std::nullopt;
}

VoxelSource read_header(const fs::path& path) {
  if (auto source = header_in(path)) return *std::move(source);
  if (auto source = header_beside(path)) return *std::move(source);
  throw_input({.where = path.string(),
               .what = "unsupported volume format",
               .expected = "NRRD, NIfTI or MetaImage",
               .got = foreign_format(path),
               .fix = way_to_read(path)});
}

Volume named(Volume volume, const std::string& name, const fs::path& path) {
  volume.name = name;
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  volume.source = (error ? path : whole.lexically_normal()).string();
  return volume;
}

}  // namespace

Volume load_volume(const std::string& name_or_path, const ReadOptions& options) {
  std::error_code ignored;
  if (!fs::is_regular_file(name_or_path, ignored)) {
    if (const auto synthetic = as_synthetic(name_or_path)) return make_synthetic(synthetic->name, synthetic->size);
  }
  const fs::path path = find_file(name_or_path);
  return named(read_source(read_header(path), options.nan_as), name_or_path, path);
}

Volume read_volume_header(const std::string& name_or_path) {
  std::error_code ignored;
  if (!fs::is_regular_file(name_or_path, ignored)) {
    if (const auto synthetic = as_synthetic(name_or_path)) return describe_synthetic(synthetic->name, synthetic->size);
  }
  const fs::path path = find_file(name_or_path);
  return named(describe_source(read_header(path)), name_or_path, path);
}

std::vector<fs::path> files_of(const std::string& name_or_path) {
  std::error_code ignored;
  std::vector<fs::path> files;
  try {
    if (!fs::is_regular_file(name_or_path, ignored) && as_synthetic(name_or_path)) return {};
    files.push_back(find_file(name_or_path));
    const VoxelSource source = read_header(files.front());
    if (source.header != files.front()) files.push_back(source.header);
    for (const DataFile& file : source.files) {
      if (file.path != files.front()) files.push_back(file.path);
    }
  } catch (const UserError&) {
    // load_volume reports it
  }
  return files;
}

std::vector<std::string> known_volume_names() {
  auto names = synthetic_names();
  names.insert(names.end(), kScans.begin(), kScans.end());
  return names;
}

const char* to_string(VoxelType type) {
  switch (type) {
    case VoxelType::U8:
      return "uint8";
    case VoxelType::I8:
      return "int8";
    case VoxelType::U16:
      return "uint16";
    case VoxelType::I16:
      return "int16";
    case VoxelType::F32:
      return "float";
  }
  return "?";
}

}  // namespace fastsplat::volume
