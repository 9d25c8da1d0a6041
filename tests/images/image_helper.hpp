// SPDX-License-Identifier: Apache-2.0
// Pictures, files and refusals for the tests of analysis/.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "base/error.hpp"
#include "base/image.hpp"

namespace fastsplat::images {

/// An empty folder of this test, removed with the object.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::size_t file_count() const;

 private:
  std::filesystem::path path_;
};

std::string file_text(const std::filesystem::path& path);
void write_bytes(const std::filesystem::path& path, const std::string& bytes);

/// Uniform in [lowest, highest), by a fixed seed.
Image random_image(int width, int height, int channels, std::uint32_t seed, float lowest = 0.0f, float highest = 1.0f);

/// The message of the UserError that `action` must throw with `code`; also checks that it is one line.
std::string refusal(ExitCode code, const std::function<void()>& action);

}  // namespace fastsplat::images
