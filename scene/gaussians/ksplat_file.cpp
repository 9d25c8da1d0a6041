// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/ksplat_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/gtc/packing.hpp>
#include <vector>

#include "base/error.hpp"
#include "scene/gaussians/byte_words.hpp"
#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/harmonics.hpp"

namespace fastsplat::scene {
namespace {

constexpr std::size_t kFileHeader = 4096, kSectionHeader = 1024;

/// Where a Gaussian's numbers are at a level of compression, in bytes from its start.
struct KsplatLayout {
  std::size_t scale, rotation, colour, harmonics, harmonic_bytes;
};
constexpr std::array<KsplatLayout, 3> kLayouts{{{12, 24, 40, 44, 4}, {6, 12, 20, 24, 2}, {6, 12, 20, 24, 1}}};

class Ksplat {
 public:
  Ksplat(const std::string& bytes, GaussianCloud& to) : bytes_(bytes), to_(to) {}
  void read();

 private:
  struct Section {
    std::size_t count, capacity, bucket_size, buckets, bucket_bytes, full, partial, degree;
    double block, range;
    std::size_t partial_sizes, centres, rows;  ///< offsets in the file
    std::size_t row_bytes;
  };
  [[noreturn]] void refuse(const std::string& what, const std::string& expected, const std::string& got) const {
    throw_input({.where = to_.source,
                 .what = what,
                 .expected = expected,
                 .got = got,
                 .fix = "the file is damaged: write or download it again"});
  }
  /// The section whose header is the `index`-th and whose data begins at `at`, which moves behind it.
  Section section(std::size_t index, std::size_t& at) const;
  void read_section(const Section& section, GaussianRows& rows) const;
  /// A float, or a half.
  float number(std::size_t at, std::size_t index) const {
    return level_ == 0 ? float_at(bytes_, at + 4 * index)
                       : glm::unpackHalf1x16(static_cast<std::uint16_t>(half_word_at(bytes_, at + 2 * index)));
  }
  float harmonic(std::size_t at, std::size_t index) const {
    if (level_ < 2) return number(at, index);
    return least_ + (most_ - least_) * static_cast<float>(byte_at(bytes_, at + index)) / 255.0F;
  }

  const std::string& bytes_;
  GaussianCloud& to_;
  std::size_t level_ = 0;
  float least_ = 0.0F, most_ = 0.0F;  ///< of harmonics at level 2
};

Ksplat::Section Ksplat::section(std::size_t index, std::size_t& at) const {
  const std::size_t head = kFileHeader + index * kSectionHeader;
  const auto word = [&](std::size_t offset) { return std::size_t{word_at(bytes_, head + offset)}; };
  Section out{};
  out.count = word(0), out.capacity = word(4), out.bucket_size = word(8), out.buckets = word(12);
  out.block = static_cast<double>(float_at(bytes_, head + 16));
  out.bucket_bytes = half_word_at(bytes_, head + 20);
  out.range = word(24) != 0 ? static_cast<double>(word(24)) : 32767.0;
  out.full = word(32), out.partial = word(36), out.degree = half_word_at(bytes_, head + 40);
  const std::string what = fmt::format("section {}", index);
  if (out.degree > static_cast<std::size_t>(kMostDegree))
    refuse(what + " has an invalid degree of harmonics", "0..3", fmt::format("{}", out.degree));
  if (out.count > out.capacity || out.full + out.partial > out.buckets)
    refuse(what + " holds more than it has room for",
           fmt::format("{} Gaussians, {} buckets", out.capacity, out.buckets),
           fmt::format("{}, {}", out.count, out.full + out.partial));
  if (level_ > 0 && out.buckets > 0 && out.bucket_bytes < 12)
    refuse(what + " has invalid buckets", "12 bytes each", fmt::format("{}", out.bucket_bytes));
  const KsplatLayout& layout = kLayouts[level_];
  out.row_bytes = layout.harmonics + layout.harmonic_bytes * 3 *
                                         static_cast<std::size_t>(harmonic_count(static_cast<int>(out.degree)) - 1);
  out.partial_sizes = at;
  out.centres = at + 4 * out.partial;
  out.rows = out.centres + out.bucket_bytes * out.buckets;
  at = out.rows + out.row_bytes * out.capacity;
  if (at > bytes_.size())
    refuse("the file is shorter than " + what + " declares", fmt::format("{} bytes", at),
           fmt::format("{}", bytes_.size()));
  return out;
}

void Ksplat::read_section(const Section& section, GaussianRows& rows) const {
  const KsplatLayout& layout = kLayouts[level_];
  const std::size_t in_full = section.full * section.bucket_size;
  const std::size_t stored = static_cast<std::size_t>(harmonic_count(static_cast<int>(section.degree)));
  std::vector<glm::vec3> harmonics(static_cast<std::size_t>(harmonic_count(to_.degree)));
  std::size_t bucket = section.full, end = in_full;  // of the partial bucket at hand
  for (std::size_t i = 0; i < section.count; ++i) {
    const std::size_t at = section.rows + i * section.row_bytes;
    Gaussian one;
    for (int axis = 0; axis < 3; ++axis) one.position[axis] = float_at(bytes_, at + 4 * static_cast<std::size_t>(axis));
    if (level_ > 0) {
      // Full buckets come first; the sizes of the others are listed.
      while (i >= end && bucket < section.full + section.partial)
        end += word_at(bytes_, section.partial_sizes + 4 * (bucket++ - section.full));
      if (i >= end)
        refuse("the buckets hold too few Gaussians", fmt::format("{}", section.count), fmt::format("{}", end));
      const std::size_t own = i < in_full ? i / section.bucket_size : bucket - 1;
      const std::size_t centre = section.centres + own * section.bucket_bytes;
      for (std::size_t k = 0; k < 3; ++k) {
        const double step = section.block / 2.0 / section.range;
        one.position[static_cast<int>(k)] =
            static_cast<float>((half_word_at(bytes_, at + 2 * k) - section.range) * step +
                               static_cast<double>(float_at(bytes_, centre + 4 * k)));
      }
    }
    std::ranges::fill(harmonics, glm::vec3(0.0F));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<int>(k);
      one.scale[axis] = number(at + layout.scale, k);
      harmonics[0][axis] =
          static_cast<float>((byte_at(bytes_, at + layout.colour + k) / 255.0 - 0.5) / kConstantHarmonic);
    }
    one.opacity = static_cast<float>(byte_at(bytes_, at + layout.colour + 3) / 255.0);
    // A degree after another, and in each a channel after another.
    for (std::size_t first = 1, width = 3, from = 0; first < stored; first += width, width += 2)
      for (int c = 0; c < 3; ++c)
        for (std::size_t k = 0; k < width; ++k) harmonics[first + k][c] = harmonic(at + layout.harmonics, from++);
    glm::dvec4 rotation;
    for (int k = 0; k < 4; ++k)
      rotation[k] = static_cast<double>(number(at + layout.rotation, static_cast<std::size_t>(k)));
    rows.add(one, rotation, harmonics);
  }
}

void Ksplat::read() {
  if (!is_ksplat(bytes_)) refuse("not a .ksplat file", "version 0.1 and at least one section", "another header");
  const std::size_t room = word_at(bytes_, 4), count = word_at(bytes_, 16);
  level_ = half_word_at(bytes_, 20);
  least_ = float_at(bytes_, 36), most_ = float_at(bytes_, 40);
  if (least_ == 0.0F) least_ = -1.5F;
  if (most_ == 0.0F) most_ = 1.5F;
  if (kFileHeader + room * kSectionHeader > bytes_.size())
    refuse("the file is shorter than its header declares", fmt::format("{} sections", room),
           fmt::format("{} bytes", bytes_.size()));
  std::vector<Section> sections;
  std::size_t at = kFileHeader + room * kSectionHeader, found = 0;
  for (std::size_t i = 0; i < room; ++i) {
    if (word_at(bytes_, kFileHeader + i * kSectionHeader) == 0) continue;
    sections.push_back(section(i, at));
    found += sections.back().count;
    to_.degree = std::max(to_.degree, static_cast<int>(sections.back().degree));
  }
  if (found != count)
    refuse("the sections hold another number of Gaussians than the header", fmt::format("{}", count),
           fmt::format("{}", found));
  GaussianRows rows(to_, to_.source);
  for (const Section& one : sections) read_section(one, rows);
  rows.end();
}

}  // namespace

bool is_ksplat(std::string_view head) {
  if (head.size() < kFileHeader || head[0] != 0 || head[1] < 1) return false;
  const std::uint32_t room = word_at(head, 4), sections = word_at(head, 8);
  const std::uint32_t most = word_at(head, 12), count = word_at(head, 16);
  return sections >= 1 && sections <= room && room < 65536 && count >= 1 && count <= most &&
         half_word_at(head, 20) <= 2;
}

void read_ksplat(const std::string& bytes, GaussianCloud& to) { Ksplat(bytes, to).read(); }

}  // namespace fastsplat::scene
