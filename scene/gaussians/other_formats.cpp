// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/other_formats.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "base/lower_case.hpp"
#include "base/read_file.hpp"
#include "scene/gaussians/byte_words.hpp"
#include "scene/gaussians/packed_bytes.hpp"
#include "scene/gaussians/splat_file.hpp"

namespace fastsplat::scene {
namespace {

/// A foreign format and how to convert it to .ply. In `fix`, {0} is the file's name and {1} that of the .ply.
struct ForeignFormat {
  const char* ending;
  const char* what;
  const char* fix;
};
constexpr const char* kConvert = "convert it: splat-transform {0} {1}";
constexpr const char* kExport = "export its Gaussians as .ply";
constexpr std::array kForeignFormats{
    ForeignFormat{".lcc", "an .lcc file of XGRIDS", kConvert},
    ForeignFormat{".gz", "a gzip file", "unpack it with gunzip"},
    ForeignFormat{".zip", "a zip archive", "unpack it and name the .ply inside"},
    ForeignFormat{".usdz", "a USD file", kExport},
    ForeignFormat{".ckpt", "a trainer's checkpoint",
                  "export a .ply from it, for example with ns-export gaussian-splat"},
    ForeignFormat{".pth", "a trainer's checkpoint", "export a .ply from it with the program that trained it"},
    ForeignFormat{".pt", "a trainer's checkpoint", "export a .ply from it with the program that trained it"},
};

/// The ending that matches a file's content, or nullptr.
const char* ending_by_content(std::string_view head, const std::string& ending) {
  if (is_gzip(head)) return ending == ".spz" ? nullptr : ".gz";  // its reader reports the damage
  if (head.starts_with("PK\x03\x04")) {
    // Archives of checkpoints are recognised by their endings alone.
    return std::ranges::find(kForeignFormats, ending, &ForeignFormat::ending) == kForeignFormats.end() ? ".zip"
                                                                                                       : nullptr;
  }
  return nullptr;
}

[[noreturn]] void refuse_format(const std::filesystem::path& path, const std::string& what, const std::string& fix) {
  require_regular_file(path);
  throw_input(
      {.where = path.string(), .what = "unsupported format: " + what, .expected = kReadFormats, .got = {}, .fix = fix});
}

}  // namespace

bool looks_like_splat(std::string_view head) {
  if (head.size() < kSplatBytes) return false;
  for (std::size_t at = 0; at + kSplatBytes <= head.size(); at += kSplatBytes) {
    for (std::size_t i = 0; i < 6; ++i) {
      const float value = float_at(head, at + 4 * i);
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
  const auto* const format = std::ranges::find(kForeignFormats, content != nullptr ? std::string_view(content) : ending,
                                               [](const ForeignFormat& one) { return std::string_view(one.ending); });
  if (format != kForeignFormats.end()) {
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
