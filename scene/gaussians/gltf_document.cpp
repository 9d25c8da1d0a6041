// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/gltf_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/error.hpp"
#include "base/file_beside.hpp"
#include "base/json_file.hpp"
#include "base/percent.hpp"
#include "base/read_file.hpp"
#include "scene/gaussians/byte_words.hpp"
#include "scene/gaussians/gaussian_file.hpp"

namespace fastsplat::scene {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostJson = std::size_t{64} << 20;  // parsed, it takes up to ten times as much

/// Base64 of RFC 4648; empty for other text.
std::string from_base64(std::string_view text) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string out;
  out.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t word = 0;
  unsigned bits = 0;
  for (const char c : text) {
    const std::size_t digit = kDigits.find(c);
    if (digit == std::string_view::npos) return {};
    word = word << 6U | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    append_byte(out, (word >> bits) & 0xFFU);
  }
  return out;
}

/// Bytes of a number of a component type; 0 for unknown types.
std::size_t size_of_type(std::size_t type) {
  switch (type) {
    case 5120:
    case 5121:
      return 1;
    case 5122:
    case 5123:
      return 2;
    case 5125:
    case 5126:
      return 4;
    default:
      return 0;
  }
}

}  // namespace

float GltfNumbers::at(std::size_t element, std::size_t number) const {
  const std::size_t place = element * stride + number * size_of_type(static_cast<std::size_t>(type));
  switch (type) {
    case 5120: {
      const auto value = static_cast<float>(static_cast<std::int8_t>(byte_at(bytes, place)));
      return normalized ? std::max(value / 127.0F, -1.0F) : value;
    }
    case 5121:
      return static_cast<float>(byte_at(bytes, place)) / (normalized ? 255.0F : 1.0F);
    case 5122: {
      const auto value = static_cast<float>(static_cast<std::int16_t>(half_word_at(bytes, place)));
      return normalized ? std::max(value / 32767.0F, -1.0F) : value;
    }
    case 5123:
      return static_cast<float>(half_word_at(bytes, place)) / (normalized ? 65535.0F : 1.0F);
    case 5125:
      return static_cast<float>(word_at(bytes, place));
    default:
      return float_at(bytes, place);
  }
}

GltfDocument::GltfDocument(std::string_view bytes, std::filesystem::path path)
    : path_(std::move(path)), bytes_(bytes.size()) {
  std::string_view text = bytes;
  if (bytes.starts_with("glTF")) {
    constexpr std::uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
    if (bytes.size() < 20)
      refuse("the header of a .glb file is truncated", "20 bytes", fmt::format("{}", bytes.size()));
    if (word_at(bytes, 4) != 2)
      refuse("unsupported version of glTF", "2", fmt::format("{}", word_at(bytes, 4)), "export it as glTF 2.0");
    if (word_at(bytes, 8) != bytes.size())
      refuse("the length in the header of a .glb file is not the file's", fmt::format("{} bytes", word_at(bytes, 8)),
             fmt::format("{}", bytes.size()), "the file may be truncated: export or copy it again");
    const std::size_t length = word_at(bytes, 12), rest = bytes.size() - 20;
    if (word_at(bytes, 16) != kJson || length > rest)
      refuse("the first chunk of a .glb file is wrong", fmt::format("JSON of at most {} bytes", rest),
             fmt::format("{} bytes", length));
    text = bytes.substr(20, length);
    const std::string_view behind = bytes.substr(20 + length);
    if (behind.size() >= 8 && word_at(behind, 4) == kBinary) {
      const std::size_t size = word_at(behind, 0);
      if (size > behind.size() - 8)
        refuse("the file is shorter than its binary chunk", fmt::format("{} bytes", size),
               fmt::format("{}", behind.size() - 8));
      binary_ = behind.substr(8, size);
    }
  }
  if (text.size() > kMostJson)
    refuse("the JSON of a glTF file is too large", fmt::format("at most {} bytes", kMostJson),
           fmt::format("{}", text.size()), "write it as .glb, whose numbers are not text");
  try {
    json_ = parse_json<Json>(std::string(text));
  } catch (const Json::parse_error& error) {
    refuse("invalid JSON in a glTF file", {}, fmt::format("an error at byte {}", error.byte));
  } catch (const std::exception& error) {
    refuse("invalid JSON in a glTF file", {}, error.what());
  }
  if (!json_.is_object()) refuse("invalid JSON in a glTF file", "an object", json_.type_name());
}

void GltfDocument::refuse(const std::string& what, const std::string& expected, const std::string& got,
                          const std::string& fix) const {
  throw_input({.where = path_.string(), .what = what, .expected = expected, .got = got, .fix = fix});
}

const Json& GltfDocument::item(const char* list, std::size_t index) const {
  const auto found = json_.find(list);
  if (found != json_.end() && found->is_array() && index < found->size() && (*found)[index].is_object())
    return (*found)[index];
  refuse(fmt::format("the glTF file has no {}[{}]", list, index), "an object", "none");
}

std::size_t GltfDocument::number(const Json& of, const char* key, const std::string& what) const {
  const auto found = of.find(key);
  if (found != of.end() && found->is_number_unsigned()) return found->get<std::size_t>();
  refuse(fmt::format("{} has no valid {}", what, key), "a whole number",
         found == of.end() ? "none" : found->dump(-1, ' ', false, Json::error_handler_t::replace).substr(0, 80));
}

std::size_t GltfDocument::number_or(const Json& of, const char* key, std::size_t otherwise,
                                    const std::string& what) const {
  return of.contains(key) ? number(of, key, what) : otherwise;
}

std::string_view GltfDocument::buffer(std::size_t index) {
  const Json& described = item("buffers", index);
  const std::string what = fmt::format("buffers[{}]", index);
  const std::size_t length = number(described, "byteLength", what);
  std::string_view bytes = binary_;
  if (const auto uri = described.find("uri"); uri != described.end()) {
    if (!uri->is_string()) refuse(what + " has no valid uri", "text", uri->type_name());
    std::string& own = loaded_[index];
    const auto& text = uri->get_ref<const std::string&>();
    if (own.empty() && text.starts_with("data:")) {
      const std::size_t comma = text.find(",");
      if (comma == std::string::npos || !std::string_view(text).substr(0, comma).ends_with(";base64"))
        refuse(what + " has an unsupported uri", "data:...;base64,", text.substr(0, 40));
      own = from_base64(std::string_view(text).substr(comma + 1));
    } else if (own.empty()) {
      if (text.find("://") != std::string::npos)
        refuse(what + " has a remote uri", "a file in the folder of the glTF file", text.substr(0, 120),
               "download the buffer and name it in the glTF file");
      const std::filesystem::path file = file_beside(path_, percent_decoded(text), path_.string() + ", " + what);
      if (std::error_code ignored; !std::filesystem::exists(file, ignored))
        refuse("the file of " + what + " is missing", file.string(), {}, "keep it in the folder of the glTF file");
      own = read_text_file(file, kMostGaussianBytes);
    }
    bytes = own;
  } else if (index != 0) {
    refuse(what + " has no uri", "a file or data", "none");
  }
  if (length > bytes.size())
    refuse(what + " is shorter than declared", fmt::format("{} bytes", length), fmt::format("{}", bytes.size()));
  return bytes.substr(0, length);
}

GltfNumbers GltfDocument::numbers(std::size_t accessor, std::size_t width, const std::string& what) {
  constexpr std::array<const char*, 5> kShapes{"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  const Json& described = item("accessors", accessor);
  const auto shape = described.find("type");
  if (shape == described.end() || !shape->is_string() || shape->get_ref<const std::string&>() != kShapes[width])
    refuse(what + " has the wrong shape", kShapes[width], "another");
  if (described.contains("sparse") || !described.contains("bufferView"))
    refuse(what + " is sparse or has no data", "an accessor with a bufferView", "none");
  const Json& view = item("bufferViews", number(described, "bufferView", what));
  if (const auto extensions = view.find("extensions"); extensions != view.end() && !extensions->empty())
    refuse(what + " is compressed", "plain numbers", "a bufferView with extensions", "export it without compression");
  GltfNumbers out;
  const std::size_t type = number(described, "componentType", what), size = size_of_type(type);
  if (size == 0) refuse(what + " has an unknown componentType", "5120 to 5126", fmt::format("{}", type));
  const auto flag = described.find("normalized");
  out.width = width, out.type = static_cast<int>(type);
  out.normalized = flag != described.end() && flag->is_boolean() && flag->get<bool>();
  out.count = number(described, "count", what);
  out.stride = number_or(view, "byteStride", width * size, what);
  const std::string_view all = buffer(number(view, "buffer", what));
  const std::size_t offset = number_or(view, "byteOffset", 0, what), length = number(view, "byteLength", what);
  const std::size_t skip = number_or(described, "byteOffset", 0, what);
  if (out.stride < width * size || out.stride > 65536)
    refuse(what + " has an invalid byteStride", fmt::format("{} to 65536", width * size),
           fmt::format("{}", out.stride));
  if (skip > length)
    refuse(what + " begins outside its buffer view", fmt::format("a byteOffset within {} bytes", length),
           fmt::format("{}", skip));
  if (offset > all.size() || length > all.size() - offset)
    refuse(what + " lies outside its buffer", fmt::format("within {} bytes", all.size()),
           fmt::format("{} bytes at byte {}", length, offset));
  out.bytes = all.substr(offset + skip, length - skip);
  const std::size_t whole = out.bytes.size() < width * size ? 0 : (out.bytes.size() - width * size) / out.stride + 1;
  if (out.count > whole)
    refuse(what + " lies outside its buffer", fmt::format("{} elements", out.count), fmt::format("{}", whole));
  return out;
}

std::size_t GltfDocument::size() const {
  std::size_t all = bytes_;
  for (const auto& [index, buffer] : loaded_) all += buffer.size();
  return all;
}

}  // namespace fastsplat::scene
