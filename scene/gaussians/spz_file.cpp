// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/spz_file.hpp"

#include <fmt/format.h>

#include <numeric>

#include "base/error.hpp"
#include "scene/gaussians/axis_flips.hpp"
#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/packed_bytes.hpp"
#include "scene/gaussians/spz_codes.hpp"

namespace fastsplat::scene {
namespace {

constexpr std::size_t kHeader4 = 32;  // bytes of version 4's header, which is not packed

struct Header {
  std::uint32_t version, count, degree, fraction_bits, flags;
};
/// The six parts of a file, unpacked.
struct Payload {
  std::array<std::string_view, 6> parts;
  std::string_view records;  ///< extensions
};

class Spz {
 public:
  Spz(const std::string& bytes, GaussianCloud& to) : bytes_(bytes), to_(to), where_(to.source) {}
  void read();

 private:
  [[noreturn]] void refuse(const std::string& what, const std::string& expected, const std::string& got,
                           const std::string& fix = "the file is damaged: write or download it again") const {
    throw_input({.where = where_, .what = what, .expected = expected, .got = got, .fix = fix});
  }
  Header header_in(std::string_view start) const;
  Payload from_gzip(const Header& header);
  Payload from_frames(const Header& header);
  /// Applies the axes that an extension record declares; counts other records in a remark.
  void read_records(std::string_view records);
  void read_rows(const Header& header, const Payload& payload);

  const std::string& bytes_;
  GaussianCloud& to_;
  std::string where_;
  std::array<std::string, 6> unpacked_;  ///< holds what Payload views
  glm::vec3 flips_ = kFlipsOfRub;
};

Header Spz::header_in(std::string_view start) const {
  if (!start.starts_with(spz::kMagic))
    refuse("not an .spz file", "NGSP as its first bytes, or in gzip", "others", "check that this is the right file");
  if (start.size() < spz::kHeaderBytes)
    refuse("the header of an .spz file is truncated", fmt::format("{} bytes", spz::kHeaderBytes),
           fmt::format("{}", start.size()));
  const Header header{word_at(start, 4), word_at(start, 8), byte_at(start, 12), byte_at(start, 13), byte_at(start, 14)};
  if (header.version < 2 || header.version > 4)
    refuse("unsupported version of .spz", "2, 3 or 4", fmt::format("{}", header.version),
           "write it again with a current program");
  if (header.count == 0) refuse("the file holds no Gaussians", "at least 1", "0", "check that this is the right file");
  if (header.degree > 4) refuse("invalid degree of harmonics", "0..4", fmt::format("{}", header.degree));
  if (header.fraction_bits > 23)
    refuse("invalid number of fraction bits", "0..23", fmt::format("{}", header.fraction_bits));
  return header;
}

Payload Spz::from_gzip(const Header& header) {
  constexpr std::size_t kMostRecords = std::size_t{1} << 20;
  const auto sizes = spz::parts_of(header.version, header.degree).all();
  const std::size_t each = std::accumulate(sizes.begin(), sizes.end(), std::size_t{0});
  const std::size_t size = spz::kHeaderBytes + each * header.count;
  check_growth(size, bytes_.size(), where_);
  std::string& all = unpacked_[0];
  all = gunzip(bytes_, size + kMostRecords, where_);
  if (all.size() < size)
    refuse("the file is shorter than its header declares",
           fmt::format("{} Gaussians, {} bytes unpacked", header.count, size), fmt::format("{} bytes", all.size()));
  Payload payload;
  std::size_t at = spz::kHeaderBytes;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    payload.parts[i] = std::string_view(all).substr(at, sizes[i] * header.count);
    at += payload.parts[i].size();
  }
  payload.records = std::string_view(all).substr(at);
  if ((header.flags & spz::kExtended) == 0 && !payload.records.empty())
    to_.remarks.push_back(fmt::format("{} bytes after the last Gaussian were ignored", payload.records.size()));
  return payload;
}

Payload Spz::from_frames(const Header& header) {
  if (bytes_.size() < kHeader4)
    refuse("the header of an .spz file is truncated", fmt::format("{} bytes", kHeader4),
           fmt::format("{}", bytes_.size()));
  const auto sizes = spz::parts_of(header.version, header.degree).all();
  const std::size_t wanted = header.degree == 0 ? 5 : 6, frames = byte_at(bytes_, 15), table = word_at(bytes_, 16);
  if (frames < wanted) refuse("wrong number of packed parts", fmt::format("{}", wanted), fmt::format("{}", frames));
  if (table < kHeader4 || table + 16 * frames > bytes_.size())
    refuse("the table of parts is outside the file", fmt::format("within {} bytes", bytes_.size()),
           fmt::format("{} entries at byte {}", frames, table));
  Payload payload;
  payload.records = std::string_view(bytes_).substr(kHeader4, table - kHeader4);
  std::size_t at = table + 16 * frames;
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::uint64_t packed = double_word_at(bytes_, table + 16 * i),
                        size = double_word_at(bytes_, table + 16 * i + 8);
    if (packed > bytes_.size() - at)
      refuse("the file is shorter than its table declares", fmt::format("{} bytes at byte {}", packed, at),
             fmt::format("{}", bytes_.size() - at));
    if (size != sizes[i] * header.count)
      refuse(fmt::format("part {} has the wrong size", i), fmt::format("{} bytes", sizes[i] * header.count),
             fmt::format("{}", size));
    check_growth(size, bytes_.size(), where_);
    unpacked_[i] = unpack_zstd(std::string_view(bytes_).substr(at, packed), size, where_);
    payload.parts[i] = unpacked_[i];
    at += packed;
  }
  return payload;
}

void Spz::read_records(std::string_view records) {
  constexpr std::uint32_t kAxes = 0xADBE0003;  // SPZ_ADOBE_coordinate_system
  std::size_t others = 0;
  while (!records.empty()) {
    if (records.size() < 8 || word_at(records, 4) > records.size() - 8)
      refuse("an extension record is truncated", "a type, a length and as many bytes",
             fmt::format("{} bytes", records.size()));
    const std::uint32_t type = word_at(records, 0), length = word_at(records, 4);
    if (type == kAxes && length == 4) {
      // 1 to 8: x left or right, y down or up, z back or forward; the others exchange y and z.
      const std::uint32_t axes = word_at(records, 8);
      if (axes > 8)
        refuse("unsupported axes in the record SPZ_ADOBE_coordinate_system", "0..8", fmt::format("{}", axes),
               "write the file with the axes of SPZ (RUB)");
      const auto sign = [axes](unsigned bit, bool positive) {
        return (((axes - 1U) >> bit) & 1U) == (positive ? 1U : 0U) ? 1.0F : -1.0F;
      };
      if (axes != 0) flips_ = {sign(0, true), sign(1, false), sign(2, true)};
    } else {
      ++others;
    }
    records.remove_prefix(8 + length);
  }
  if (others > 0)
    to_.remarks.push_back(fmt::format("{} extension records (such as limits of cameras) were ignored", others));
}

void Spz::read_rows(const Header& header, const Payload& payload) {
  to_.degree = static_cast<int>(std::min<std::uint32_t>(header.degree, kMostDegree));
  if (header.degree > kMostDegree) to_.remarks.emplace_back("harmonics of degree 4 were dropped: degree 3 is drawn");
  const std::size_t count = header.count, each = static_cast<std::size_t>(harmonic_count(to_.degree));
  const auto& [positions, opacities, colours, scales, rotations, rest] = payload.parts;
  const spz::Parts parts = spz::parts_of(header.version, header.degree);
  const double step = std::ldexp(1.0, -static_cast<int>(header.fraction_bits));
  to_.gaussians.reserve(count);
  to_.harmonics.reserve(count * each);
  GaussianRows rows(to_, where_);
  std::vector<glm::vec3> harmonics(each);
  for (std::size_t i = 0; i < count; ++i) {
    Gaussian one;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<int>(k);
      const std::size_t at = i * parts.position + 3 * k;
      // 24 bits with a sign: shifted to the top of a word and back.
      const std::uint32_t word = half_word_at(positions, at) << 8U | byte_at(positions, at + 2) << 24U;
      one.position[axis] = static_cast<float>((static_cast<std::int32_t>(word) >> 8) * step);
      one.scale[axis] = static_cast<float>(spz::scale_of(byte_at(scales, 3 * i + k)));
      harmonics[0][axis] = static_cast<float>(spz::colour_of(byte_at(colours, 3 * i + k)));
    }
    one.opacity = static_cast<float>(byte_at(opacities, i) / 255.0);
    const std::size_t turn = i * parts.rotation;
    const glm::dvec4 xyzw = header.version == 2
                                ? spz::rotation_of_bytes(byte_at(rotations, turn), byte_at(rotations, turn + 1),
                                                         byte_at(rotations, turn + 2))
                                : spz::rotation_of_word(word_at(rotations, turn));
    for (std::size_t k = 1; k < each; ++k)
      for (std::size_t c = 0; c < 3; ++c)
        harmonics[k][static_cast<int>(c)] =
            static_cast<float>(spz::harmonic_of(byte_at(rest, i * parts.harmonics + 3 * (k - 1) + c)));
    glm::dvec4 rotation(xyzw.w, xyzw.x, xyzw.y, xyzw.z);
    flip_axes(flips_, one.position, rotation, harmonics);
    rows.add(one, rotation, harmonics);
  }
  rows.end();
}

void Spz::read() {
  const bool packed = is_gzip(bytes_);
  const Header header = header_in(packed ? gunzip(bytes_, spz::kHeaderBytes, where_) : bytes_);
  if (packed != (header.version < 4))
    refuse("the version does not match the compression", packed ? "2 or 3 in gzip" : "4 outside gzip",
           fmt::format("{}", header.version));
  const Payload payload = packed ? from_gzip(header) : from_frames(header);
  if ((header.flags & spz::kExtended) != 0) read_records(payload.records);
  to_.antialiased = (header.flags & spz::kAntialiased) != 0;
  read_rows(header, payload);
}

}  // namespace

bool is_spz(std::string_view head) {
  if (is_gzip(head)) return start_of_gzip(head, spz::kMagic.size()) == spz::kMagic;
  return head.starts_with(spz::kMagic);
}

void read_spz(const std::string& bytes, GaussianCloud& to) { Spz(bytes, to).read(); }

}  // namespace fastsplat::scene
