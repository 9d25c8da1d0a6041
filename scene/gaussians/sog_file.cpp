// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/sog_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <numbers>

#include "base/json_file.hpp"
#include "scene/gaussians/byte_words.hpp"
#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/packed_bytes.hpp"
#include "scene/gaussians/smallest_three.hpp"
#include "scene/gaussians/sog_parts.hpp"

namespace fastsplat::scene {
namespace {

using Json = nlohmann::json;

/// What a byte of each channel means; NaN for bytes without a meaning.
using SogTable = std::array<std::array<double, 256>, 4>;

class Sog {
 public:
  Sog(GaussianCloud& to, bool archive) : parts_(to.source, archive), to_(to) {}
  /// `meta`: the text of meta.json.
  void read(const std::string& meta);
  std::string meta() const { return parts_.read("meta.json", std::uint64_t{1} << 24); }

 private:
  const Json& part(const char* name) const;
  std::string file_of(const Json& part, std::size_t index) const;
  std::vector<double> numbers(const Json& part, const char* key, std::size_t least, std::size_t most) const;
  SogTable table_of(const Json& part, std::size_t channels) const;
  void read_harmonics();
  /// False if the label names no entry.
  bool harmonics_of(std::size_t i, std::span<glm::vec3> harmonics) const;

  SogParts parts_;
  GaussianCloud& to_;
  Json meta_;
  std::size_t count_ = 0;
  SogPicture palette_, labels_;
  std::size_t palette_size_ = 0;
  SogTable harmonics_{};
};

const Json& Sog::part(const char* name) const {
  const auto found = meta_.find(name);
  if (found != meta_.end() && found->is_object()) return *found;
  parts_.refuse(fmt::format("meta.json has no {}", name), "an object", "none");
}

std::string Sog::file_of(const Json& part, std::size_t index) const {
  const auto files = part.find("files");
  if (files != part.end() && files->is_array() && index < files->size() && (*files)[index].is_string())
    return (*files)[index].get<std::string>();
  parts_.refuse("meta.json names too few files", fmt::format("{}", index + 1), "fewer");
}

std::vector<double> Sog::numbers(const Json& part, const char* key, std::size_t least, std::size_t most) const {
  std::vector<double> out;
  if (const auto found = part.find(key); found != part.end()) {
    if (found->is_number()) out.push_back(found->get<double>());
    if (found->is_array())
      for (const Json& value : *found)
        if (value.is_number()) out.push_back(value.get<double>());
  }
  if (out.size() >= least && out.size() <= most) return out;
  parts_.refuse(fmt::format("meta.json has no valid {}", key), fmt::format("{} to {} numbers", least, most),
                fmt::format("{}", out.size()));
}

SogTable Sog::table_of(const Json& part, std::size_t channels) const {
  SogTable table;
  for (auto& channel : table) channel.fill(std::numeric_limits<double>::quiet_NaN());
  if (part.contains("codebook") || meta_.contains("version")) {
    const auto book = numbers(part, "codebook", 1, 256);
    for (std::size_t c = 0; c < channels; ++c) std::ranges::copy(book, table[c].begin());
    return table;
  }
  // Version 1: steps between bounds, of each channel or of all.
  const auto low = numbers(part, "mins", 1, 4), high = numbers(part, "maxs", 1, 4);
  for (std::size_t c = 0; c < 4; ++c) {
    const double from = low[std::min(c, low.size() - 1)], to = high[std::min(c, high.size() - 1)];
    for (std::size_t byte = 0; byte < 256; ++byte)
      table[c][byte] = from + (to - from) * (static_cast<double>(byte) / 255.0);
  }
  return table;
}

void Sog::read_harmonics() {
  if (!meta_.contains("shN")) return;
  const Json& part = this->part("shN");
  palette_ = decode_sog_picture(parts_, file_of(part, 0), 1, std::uint64_t{15} * 64 * 1024);
  labels_ = decode_sog_picture(parts_, file_of(part, 1), count_, 4 * count_ + 65536);
  for (int degree = 1; degree <= kMostDegree; ++degree)
    if (palette_.width == 64 * (harmonic_count(degree) - 1)) to_.degree = degree;
  if (to_.degree == 0)
    parts_.refuse("the picture of harmonics has an unknown width", "192, 512 or 960",
                  fmt::format("{}", palette_.width));
  palette_size_ = std::size_t{64} * static_cast<std::size_t>(palette_.height);
  if (const auto most = part.find("count"); most != part.end() && most->is_number_unsigned())
    palette_size_ = std::min(palette_size_, most->get<std::size_t>());
  harmonics_ = table_of(part, 3);
}

bool Sog::harmonics_of(std::size_t i, std::span<glm::vec3> harmonics) const {
  if (harmonics.empty()) return true;
  const std::size_t label = half_word_at(labels_.bytes, 4 * i);
  if (label >= palette_size_) return false;
  const std::size_t row = label / 64, column = label % 64 * harmonics.size();
  for (std::size_t k = 0; k < harmonics.size(); ++k) {
    const std::size_t at = 4 * (row * static_cast<std::size_t>(palette_.width) + column + k);
    for (std::size_t c = 0; c < 3; ++c)
      harmonics[k][static_cast<int>(c)] = static_cast<float>(harmonics_[c][byte_at(palette_.bytes, at + c)]);
  }
  return true;
}

void Sog::read(const std::string& text) {
  constexpr std::uint64_t kBytesEach = 24;  // unpacked: six pictures
  if (const std::size_t most = std::size_t{1} << 24; text.size() > most)
    parts_.refuse("meta.json is too large", fmt::format("at most {} bytes", most), fmt::format("{}", text.size()));
  try {
    meta_ = parse_json<Json>(text);
  } catch (const Json::parse_error& error) {
    parts_.refuse("meta.json is not valid JSON", {}, fmt::format("an error at byte {}", error.byte));
  } catch (const std::exception& error) {
    parts_.refuse("meta.json is not valid JSON", {}, error.what());
  }
  if (!meta_.is_object()) parts_.refuse("meta.json is not valid", "an object", meta_.type_name());
  const bool first = !meta_.contains("version");
  if (!first && meta_["version"] != 2) parts_.refuse("unsupported version of SOG", "2", meta_["version"].dump());
  const Json& means = part("means");
  const Json counted = first ? means.value("shape", Json::array()) : Json::array({meta_.value("count", Json())});
  if (!counted.is_array() || counted.empty() || !counted[0].is_number_unsigned() || counted[0] == 0U)
    parts_.refuse("meta.json has no valid number of Gaussians", "at least 1", "another");
  count_ = counted[0].get<std::size_t>();
  constexpr std::size_t kMostCount = std::size_t{16383} * 16383;  // pixels of a WebP picture
  if (count_ > kMostCount)
    parts_.refuse("meta.json declares too many Gaussians", fmt::format("at most {}", kMostCount),
                  fmt::format("{}", count_));

  const auto picture = [&](const char* of, std::size_t index) {
    return decode_sog_picture(parts_, file_of(part(of), index), count_, 4 * count_ + 65536);
  };
  const SogPicture low = picture("means", 0);
  parts_.check_growth_to(kBytesEach * count_);
  const SogPicture high = picture("means", 1), quats = picture("quats", 0), scales = picture("scales", 0),
                   sh0 = picture("sh0", 0);
  read_harmonics();
  const auto least = numbers(means, "mins", 3, 3), most = numbers(means, "maxs", 3, 3);
  const SogTable scale_table = table_of(part("scales"), 3), colour_table = table_of(part("sh0"), 3);
  const std::size_t each = static_cast<std::size_t>(harmonic_count(to_.degree));
  GaussianRows rows(to_, to_.source);
  std::vector<glm::vec3> harmonics(each);
  for (std::size_t i = 0; i < count_; ++i) {
    Gaussian one;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<int>(k);
      const std::size_t at = 4 * i + k;
      const std::uint32_t step = byte_at(low.bytes, at) | byte_at(high.bytes, at) << 8U;
      const double folded = least[k] + (most[k] - least[k]) * (step / 65535.0);
      one.position[axis] = static_cast<float>(std::copysign(std::expm1(std::abs(folded)), folded));
      one.scale[axis] = static_cast<float>(std::exp(scale_table[k][byte_at(scales.bytes, at)]));
      harmonics[0][axis] = static_cast<float>(colour_table[k][byte_at(sh0.bytes, at)]);
    }
    const std::uint32_t opacity = byte_at(sh0.bytes, 4 * i + 3);
    one.opacity = static_cast<float>(first ? 1.0 / (1.0 + std::exp(-colour_table[3][opacity])) : opacity / 255.0);
    const std::uint32_t tag = byte_at(quats.bytes, 4 * i + 3);
    if (tag < 252) {
      rows.drop("code of the rotation (quats) is invalid");
      continue;
    }
    SmallestThree code{.largest = static_cast<int>(tag - 252)};
    for (std::size_t k = 0; k < 3; ++k)
      code.others[k] = (byte_at(quats.bytes, 4 * i + k) / 255.0 * 2.0 - 1.0) / std::numbers::sqrt2;
    if (!harmonics_of(i, std::span(harmonics).subspan(1))) {
      rows.drop("label of its harmonics (shN) is out of range");
      continue;
    }
    rows.add(one, rotation_of(code), harmonics);
  }
  rows.end();
}

}  // namespace

void read_sog(const std::string& /*bytes*/, GaussianCloud& to) {
  Sog sog(to, true);
  sog.read(sog.meta());
}
void read_sog_meta(const std::string& bytes, GaussianCloud& to) { Sog(to, false).read(bytes); }

}  // namespace fastsplat::scene
