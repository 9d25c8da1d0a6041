// SPDX-License-Identifier: Apache-2.0
#include "report/picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/images/encoding.hpp"
#include "base/images/image_file.hpp"

namespace fastsplat::report {
namespace {

/// Fraction bits for floats: the finest device's, so that its pictures stay exact.
constexpr int kFractionBits = 16;

void take_samples(const images::LoadedImage& loaded, std::int64_t scale, Picture& to) {
  to.scale = scale;
  to.words.resize(loaded.image.data.size());
  for (std::size_t i = 0; i < to.words.size(); ++i) {
    const double value = loaded.image.data[i];
    if (!std::isfinite(value)) {
      ++to.nonfinite;
      continue;
    }
    to.words[i] = std::llround(value * static_cast<double>(scale));
    // Integer samples are read as floats that round back exactly.
    if (to.frac_bits >= 0)
      to.exact = to.exact && static_cast<double>(to.words[i]) == value * static_cast<double>(scale);
  }
}

int fraction_bits(const Image& image) {
  double largest = 0.0;
  for (const float value : image.data) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(static_cast<double>(value)));
  }
  int bits = kFractionBits;
  while (bits > 0 && std::ldexp(largest, bits) >= std::numeric_limits<std::int32_t>::max()) --bits;
  return bits;
}

}  // namespace

Picture load_picture(const std::string& role, const std::filesystem::path& file) {
  const auto loaded = images::read_image(file);
  Picture picture;
  picture.role = role;
  picture.from = file.string();
  picture.kind = images::to_string(loaded.kind);
  picture.width = picture.full_width = loaded.image.width;
  picture.height = picture.full_height = loaded.image.height;
  picture.channels = loaded.image.channels;
  picture.metadata = loaded.metadata;
  picture.display = images::encoding_of(loaded) != images::kLinear;
  switch (loaded.kind) {
    case images::PixelKind::RawWords:
      picture.frac_bits = loaded.frac_bits;
      if (const auto bits = loaded.metadata.find("int_bits"); bits != loaded.metadata.end())
        picture.int_bits = std::atoi(bits->second.c_str());
      picture.scale = std::int64_t{1} << loaded.frac_bits;
      picture.words.assign(loaded.words.begin(), loaded.words.end());
      break;
    case images::PixelKind::Uint8:
      take_samples(loaded, 255, picture);
      break;
    case images::PixelKind::Uint16:
      take_samples(loaded, 65535, picture);
      break;
    case images::PixelKind::Float:
    case images::PixelKind::Half:
      picture.frac_bits = fraction_bits(loaded.image);
      take_samples(loaded, std::int64_t{1} << picture.frac_bits, picture);
      break;
  }
  return picture;
}

bool same_values(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height || a.channels != b.channels || a.display != b.display) return false;
  if (a.nonfinite + b.nonfinite > 0) return false;
  for (std::size_t i = 0; i < a.words.size(); ++i) {
    if (a.words[i] * b.scale != b.words[i] * a.scale) return false;
  }
  return true;
}

Picture cropped(const Picture& picture, int x0, int y0, int width, int height) {
  Picture window = picture;
  window.x0 = picture.x0 + x0;
  window.y0 = picture.y0 + y0;
  window.width = width;
  window.height = height;
  window.words.clear();
  const auto channels = static_cast<std::ptrdiff_t>(picture.channels);
  for (int y = y0; y < y0 + height; ++y) {
    const auto row = picture.words.begin() + (static_cast<std::ptrdiff_t>(y) * picture.width + x0) * channels;
    window.words.insert(window.words.end(), row, row + width * channels);
  }
  return window;
}

}  // namespace fastsplat::report
