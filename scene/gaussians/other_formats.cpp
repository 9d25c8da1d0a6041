// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/other_formats.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "base/error.hpp"
#include "base/lower_case.hpp"
#include "base/read_file.hpp"
#include "scene/gaussians/splat_file.hpp"

namespace fastsplat::scene {
namespace {

/// A foreign format and how to convert it to .ply. In `fix`, {0} is the file's name and {1} that of the .ply.
struct Format {
  const char* ending;
  const char* what;
  const char* fix;
};
constexpr const char* kConvert = "convert it: splat-transform {0} {1}";
constexpr const char* kExport = "export its Gaussians as .ply";
constexpr std::array kFormats{
    Format{".spz", "an .spz file, Niantic's packed Gaussians", kConvert},
    Format{".ksplat", "a .ksplat file of GaussianSplats3D", kConvert},
    Format{".sog", "a .sog file, PlayCanvas' Gaussians packed in pictures", kConvert},
    Format{".json", "a .json file (perhaps the meta.json of an unpacked .sog)", kConvert},
    Format{".lcc", "an .lcc file of XGRIDS", kConvert},
    Format{".gz", "a gzip file", "unpack it with gunzip"},
    Format{".zip", "a zip archive", "unpack it and name the .ply inside"},
    Format{".glb", "a glTF file", kExport},
    Format{".gltf", "a glTF file", kExport},
    Format{".usdz", "a USD file", kExport},
    Format{".ckpt", "a trainer's checkpoint", "export a .ply from it, for example with ns-export gaussian-splat"},
    Format{".pth", "a trainer's checkpoint", "export a .ply from it with the program that trained it"},
    Format{".pt", "a trainer's checkpoint", "export a .ply from it with the program that trained it"},
};

std::uint32_t head_word(std::string_view bytes, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return word;
}

/// The first bytes of a gzip file, unpacked.
std::string unpacked_head(std::string_view head) {
  std::string packed(head), out(16, '\0');
  z_stream stream{};
  if (inflateInit2(&stream, 16 + MAX_WBITS) != Z_OK) return {};
  stream.next_in = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  inflate(&stream, Z_SYNC_FLUSH);
  out.resize(out.size() - stream.avail_out);
  inflateEnd(&stream);
  return out;
}

/// Whether the head is that of a .ksplat: version 0.x, sections and Gaussians within their declared maxima, level 0..2.
bool is_ksplat(std::string_view head) {
  constexpr std::size_t kHeader = 4096;
  if (head.size() < kHeader || head[0] != 0 || head[1] < 1) return false;
  const std::uint32_t most_sections = head_word(head, 4), sections = head_word(head, 8);
  const std::uint32_t most = head_word(head, 12), count = head_word(head, 16), level = head_word(head, 20) & 0xFFFFU;
  return sections >= 1 && sections <= most_sections && most_sections < 65536 && count >= 1 && count <= most &&
         level <= 2;
}

/// The ending that matches a file's content, or nullptr.
const char* ending_by_content(std::string_view head, const std::string& ending) {
  if (head.starts_with("NGSP")) return ".spz";
  if (head.starts_with("\x1f\x8b")) return unpacked_head(head).starts_with("NGSP") ? ".spz" : ".gz";
  if (head.starts_with("PK\x03\x04")) {
    // A .sog archive names pictures and meta.json; other archives are recognised by their endings alone.
    if (head.find("meta.json") != head.npos || head.find(".webp") != head.npos) return ".sog";
    return std::ranges::find(kFormats, ending, &Format::ending) == kFormats.end() ? ".zip" : nullptr;
  }
  if (head.starts_with("glTF")) return ".glb";
  if (head.starts_with("{") && head.find("\"means\"") != head.npos) return ".json";
  return is_ksplat(head) ? ".ksplat" : nullptr;
}

[[noreturn]] void refuse_format(const std::filesystem::path& path, const std::string& what, const std::string& fix) {
  require_regular_file(path);
  throw_input({.where = path.string(),
               .what = "unsupported format: " + what + "",
               .expected = ".ply or .splat",
               .got = {},
               .fix = fix});
}

}  // namespace

bool is_ply(std::string_view head) { return head.starts_with("ply\n") || head.starts_with("ply\r"); }

bool looks_like_splat(std::string_view head) {
  if (head.size() < kSplatBytes) return false;
  for (std::size_t at = 0; at + kSplatBytes <= head.size(); at += kSplatBytes) {
    for (std::size_t i = 0; i < 6; ++i) {
      const std::uint32_t word = head_word(head, at + 4 * i);
      float value = 0.0F;
      std::memcpy(&value, &word, sizeof value);
      // Plausible positions and deviations; tiny nonzero numbers mean other data.
      const float size = std::abs(value);
      if (!(size == 0.0F || (size > 1e-12F && size < 1e6F)) || (i >= 3 && value < 0.0F)) return false;
    }
    double square = 0.0;
    for (std::size_t i = 28; i < 32; ++i) {
      const double part = (static_cast<unsigned char>(head[at + i]) - 128.0) / 128.0;
      square += part * part;
    }
    if (std::abs(std::sqrt(square) - 1.0) > 0.05) return false;
  }
  return true;
}

void refuse_other_formats(const std::filesystem::path& path, std::string_view head) {
  const std::string ending = ending_of(path);
  const char* const content = ending_by_content(head, ending);
  const auto* const format = std::ranges::find(kFormats, content != nullptr ? std::string_view(content) : ending,
                                               [](const Format& one) { return std::string_view(one.ending); });
  if (format != kFormats.end()) {
    // Converters recognise a file by its ending.
    std::filesystem::path named = path, made = path;
    named.replace_extension(format->ending), made.replace_extension(".ply");
    const bool misnamed = ending != format->ending && std::string_view(format->fix).find("{0}") != std::string::npos;
    refuse_format(path, format->what,
                  (misnamed ? fmt::format("rename it to {}, then ", named.string()) : "") +
                      fmt::format(fmt::runtime(format->fix), named.string(), made.string()));
  }
  if (ending != ".splat" && looks_like_splat(head))
    refuse_format(path, "a .splat file with another extension", "rename it to .splat");
}

}  // namespace fastsplat::scene
