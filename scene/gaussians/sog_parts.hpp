// SPDX-License-Identifier: Apache-2.0
// The files of a SOG scene, in a zip archive or in the folder of its meta.json, and its pictures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace fastsplat::scene {

/// Every refusal is a UserError (Input) that names the scene's file.
class SogParts {
 public:
  /// `path`: an archive, or a meta.json; `archive`: which of the two.
  SogParts(std::filesystem::path path, bool archive) : path_(std::move(path)), archive_(archive) {}

  /// A file of at most `most` bytes.
  std::string read(const std::string& name, std::uint64_t most) const;
  /// Throws if the archive, or meta.json and the files read so far, can hardly hold so many bytes unpacked.
  void check_growth_to(std::uint64_t unpacked) const;
  [[noreturn]] void refuse(const std::string& what, const std::string& expected, const std::string& got) const;

 private:
  std::string from_archive(const std::string& name, std::uint64_t most) const;

  std::filesystem::path path_;
  bool archive_;
  mutable std::uint64_t read_ = 0;
};

/// A decoded WebP picture: 4 bytes a pixel, R G B A, row by row.
struct SogPicture {
  int width = 0, height = 0;
  std::string bytes;
};
/// Decodes a picture with at least `least` and at most `most` pixels. Memory is checked before it is taken.
SogPicture decode_sog_picture(const SogParts& parts, const std::string& name, std::uint64_t least, std::uint64_t most);

}  // namespace fastsplat::scene
