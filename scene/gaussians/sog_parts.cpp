// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/sog_parts.hpp"

#include <fmt/format.h>
#include <unzip.h>
#include <webp/decode.h>

#include <memory>

#include "base/error.hpp"
#include "base/file_beside.hpp"
#include "base/read_file.hpp"
#include "scene/gaussians/packed_bytes.hpp"

namespace fastsplat::scene {

void SogParts::refuse(const std::string& what, const std::string& expected, const std::string& got) const {
  throw_input({.where = path_.string(),
               .what = what,
               .expected = expected,
               .got = got,
               .fix = "the file is damaged or not a SOG scene: write or download it again"});
}

void SogParts::check_growth_to(std::uint64_t unpacked) const {
  check_growth(unpacked, archive_ ? std::filesystem::file_size(path_) : read_, path_.string());
}

std::string SogParts::from_archive(const std::string& name, std::uint64_t most) const {
  const auto close = [](void* file) { unzClose(file); };
  const std::unique_ptr<void, decltype(close)> zip(unzOpen64(path_.c_str()), close);
  if (!zip) refuse("the zip archive has no directory", "a whole archive", "a truncated or damaged one");
  if (unzLocateFile(zip.get(), name.c_str(), 1) != UNZ_OK)
    refuse("the archive lacks a file", name.substr(0, 80), "none of this name");
  unz_file_info64 info{};
  if (unzGetCurrentFileInfo64(zip.get(), &info, nullptr, 0, nullptr, 0, nullptr, 0) != UNZ_OK)
    refuse("the directory of the zip archive is damaged", name.substr(0, 80), "no size");
  if (info.uncompressed_size > most)
    refuse("a file in the archive is too large", fmt::format("{} of at most {} bytes", name.substr(0, 80), most),
           fmt::format("{}", info.uncompressed_size));
  check_growth_to(info.uncompressed_size);
  std::string out(info.uncompressed_size, '\0');
  const bool read =
      unzOpenCurrentFile(zip.get()) == UNZ_OK &&
      unzReadCurrentFile(zip.get(), out.data(), static_cast<unsigned>(out.size())) == static_cast<int>(out.size()) &&
      unzCloseCurrentFile(zip.get()) == UNZ_OK;  // checks the sum
  if (!read) refuse("a file in the archive is damaged", name.substr(0, 80), "other bytes than its sum says");
  return out;
}

std::string SogParts::read(const std::string& name, std::uint64_t most) const {
  std::string bytes =
      archive_ ? from_archive(name, most) : read_text_file(file_beside(path_, name, path_.string()), most);
  read_ += bytes.size();
  return bytes;
}

SogPicture decode_sog_picture(const SogParts& parts, const std::string& name, std::uint64_t least, std::uint64_t most) {
  constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 30;
  const std::string webp = parts.read(name, kMostBytes);
  const auto* const data = reinterpret_cast<const std::uint8_t*>(webp.data());
  SogPicture out;
  if (WebPGetInfo(data, webp.size(), &out.width, &out.height) == 0)
    parts.refuse("not a WebP picture", name.substr(0, 80), "other data");
  const std::uint64_t pixels = static_cast<std::uint64_t>(out.width) * static_cast<std::uint64_t>(out.height);
  if (pixels < least || pixels > most)
    parts.refuse(fmt::format("the picture {} has the wrong size", name.substr(0, 80)),
                 fmt::format("{} to {} pixels", least, most), fmt::format("{} x {}", out.width, out.height));
  parts.check_growth_to(4 * least);
  out.bytes.resize(4 * pixels);
  if (WebPDecodeRGBAInto(data, webp.size(), reinterpret_cast<std::uint8_t*>(out.bytes.data()), out.bytes.size(),
                         4 * out.width) == nullptr)
    parts.refuse("a WebP picture is damaged", name.substr(0, 80), "data that does not decode");
  return out;
}

}  // namespace fastsplat::scene
