// SPDX-License-Identifier: Apache-2.0
#include "tests/images/image_helper.hpp"

#include <unistd.h>

#include <fstream>
#include <iterator>
#include <random>

namespace fastsplat::images {

TempFolder::TempFolder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "fastsplat_XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make " + pattern);
  path_ = pattern;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::size_t TempFolder::file_count() const {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
}

std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::filesystem::remove(path);  // a new file: ext4 waits for the disk when an old one is truncated
  std::ofstream out(path, std::ios::binary);
  out << bytes;
  out.close();
  if (!out) throw std::runtime_error("cannot write " + path.string());
}

Image random_image(int width, int height, int channels, std::uint32_t seed, float lowest, float highest) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<float> value(lowest, highest);
  Image image(width, height, channels);
  for (float& v : image.data) v = value(generator);
  return image;
}

std::string refusal(ExitCode code, const std::function<void()>& action) {
  try {
    action();
  } catch (const UserError& error) {
    const std::string message = error.what();
    EXPECT_EQ(error.code(), code) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
    return message;
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

}  // namespace fastsplat::images
