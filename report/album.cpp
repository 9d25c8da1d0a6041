// SPDX-License-Identifier: Apache-2.0
#include "report/album.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/sha256.hpp"
#include "report/codec.hpp"

namespace fastsplat::report {
namespace {

/// Smaller windows are useless.
constexpr int kLeastSide = 64;

std::string metadata_of(const Picture& picture, const char* key) {
  const auto found = picture.metadata.find(key);
  return found == picture.metadata.end() ? std::string{} : found->second;
}

/// Key of the pictures that one viewer shows together: their scene, or the view for 3-D Gaussians.
std::string scene_of(const Picture& picture) {
  if (metadata_of(picture, "gaussians").empty()) return metadata_of(picture, "scene");
  return fmt::format("{} {}x{} {}", metadata_of(picture, "content_hash"), picture.full_width, picture.full_height,
                     metadata_of(picture, "view"));
}

bool is_better(const Picture& a, const Picture& b) {
  const auto rank = [](const Picture& p) { return p.display ? 0 : p.int_bits >= 0 || p.kind == "raw words" ? 2 : 1; };
  return rank(a) > rank(b);
}

/// Whether both are the same picture of the same device, perhaps in different formats.
bool one_picture(const Picture& a, const Picture& b) {
  return a.role == b.role && scene_of(a) == scene_of(b) &&
         metadata_of(a, "config_hash") == metadata_of(b, "config_hash") && same_values(a, b);
}

void add(std::vector<Picture>& pictures, Picture picture) {
  for (Picture& other : pictures) {
    if (!one_picture(other, picture)) continue;
    if (is_better(picture, other)) std::swap(other, picture);
    if (picture.from != other.from) other.also.push_back(picture.from);
    other.also.insert(other.also.end(), picture.also.begin(), picture.also.end());
    other.ties.insert(other.ties.end(), picture.ties.begin(), picture.ties.end());
    return;
  }
  pictures.push_back(std::move(picture));
}

std::string title_of(const Picture& picture) {
  static const std::map<std::string, std::string> words{
      {"golden", "Golden"}, {"integer", "Integer"}, {"rtl", "RTL"}, {"blame", "Blame"}, {"saturation", "Saturation"}};
  const auto found = words.find(picture.role);
  std::string title = found != words.end() ? found->second : picture.role;
  if (const auto config = metadata_of(picture, "config"); !config.empty()) title += " " + config;
  return title;
}

struct Encoded {
  std::string bytes, sha256;
  int word_bytes = 2;
};

Encoded encoded(const Picture& picture) {
  const Words words{.width = picture.width,
                    .height = picture.height,
                    .channels = picture.channels,
                    .bytes = bytes_for(picture.words),
                    .values = picture.words};
  return {.bytes = encode(words), .sha256 = sha256(plain_bytes(words)), .word_bytes = words.bytes};
}

std::size_t base64_size(const std::string& bytes) { return (bytes.size() + 2) / 3 * 4; }

/// Size in the page; equal pictures count once.
std::size_t total_size(const std::vector<Encoded>& all) {
  std::map<std::string, std::size_t> once;  // keyed by the bytes in the page
  for (const Encoded& one : all) once[one.bytes] = base64_size(one.bytes);
  std::size_t sum = 0;
  for (const auto& [unused, size] : once) sum += size;
  return sum;
}

std::vector<Encoded> encoded(const std::vector<Picture>& pictures) {
  std::vector<Encoded> all;
  for (const Picture& picture : pictures) all.push_back(encoded(picture));
  return all;
}

/// Crops to about `share` of the sides, around `focus`.
Picture window(const Picture& picture, Focus focus, double share) {
  const auto part = [&](int full, int centre, int& start) {
    const int side = std::clamp(static_cast<int>(full * share), std::min(kLeastSide, full), full);
    start = std::clamp(centre - side / 2, 0, full - side);
    return side;
  };
  int x0 = 0, y0 = 0;
  const int width = part(picture.width, focus.x, x0), height = part(picture.height, focus.y, y0);
  return cropped(picture, x0, y0, width, height);
}

Json entry(const Picture& picture, const Encoded& one, const std::string& id, std::size_t group) {
  Json json{{"id", id},
            {"role", picture.role},
            {"title", title_of(picture)},
            {"width", picture.width},
            {"height", picture.height},
            {"channels", picture.channels},
            {"codec", codec_name(one.word_bytes)},
            {"signed", std::any_of(picture.words.begin(), picture.words.end(), [](auto word) { return word < 0; })},
            {"scale", picture.scale},
            {"frac_bits", picture.frac_bits >= 0 ? Json(picture.frac_bits) : Json(nullptr)},
            {"int_bits", picture.int_bits >= 0 ? Json(picture.int_bits) : Json(nullptr)},
            {"exact", picture.exact},
            {"display", picture.display},
            {"sha256", one.sha256},
            {"from", picture.from},
            {"also", picture.also},
            {"kind", picture.kind},
            {"group", group}};
  if (picture.nonfinite > 0) json["nonfinite"] = picture.nonfinite;
  if (picture.width != picture.full_width || picture.height != picture.full_height) {
    json["crop"] = {
        {"x", picture.x0}, {"y", picture.y0}, {"full_width", picture.full_width}, {"full_height", picture.full_height}};
  }
  if (!picture.ties.empty()) json["compared"] = picture.ties;
  for (const char* key : {"config", "config_hash", "engine", "method", "volume", "scene", "gaussians", "lab"}) {
    if (const auto text = metadata_of(picture, key); !text.empty()) json[key] = text;
  }
  return json;
}

bool seen_together(const Picture& a, const Picture& b) {
  if (!scene_of(a).empty() && scene_of(a) == scene_of(b)) return true;
  const auto place = [](const std::string& tie) { return tie.substr(0, tie.find('.')); };
  return std::any_of(a.ties.begin(), a.ties.end(), [&](const auto& tie) {
    return std::any_of(b.ties.begin(), b.ties.end(), [&](const auto& other) { return place(tie) == place(other); });
  });
}

/// Group of each picture, numbered from 0 in order of first appearance. Pictures of one scene or one compare share a
/// group, transitively; pictures without either join the first group.
std::vector<std::size_t> groups_of(const std::vector<Picture>& pictures) {
  std::vector<std::size_t> first(pictures.size());
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    first[i] = scene_of(pictures[i]).empty() && pictures[i].ties.empty() ? 0 : i;
    for (std::size_t j = 0; j < i; ++j) {
      if (!seen_together(pictures[i], pictures[j]) || first[i] == first[j]) continue;
      const std::size_t from = std::max(first[i], first[j]), to = std::min(first[i], first[j]);
      std::replace(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(i) + 1, from, to);
    }
  }
  std::vector<std::size_t> numbers(pictures.size()), starts;
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    auto found = std::find(starts.begin(), starts.end(), first[i]);
    if (found == starts.end()) found = starts.insert(starts.end(), first[i]);
    numbers[i] = static_cast<std::size_t>(found - starts.begin());
  }
  return numbers;
}

/// Appends file names to titles that are not unique within their group.
void disambiguate(Json& entries) {
  std::map<std::string, int> times;
  const auto key = [](const Json& json) { return json["group"].dump() + json["title"].get<std::string>(); };
  for (const Json& json : entries) ++times[key(json)];
  for (Json& json : entries) {
    if (times[key(json)] < 2) continue;
    const std::filesystem::path file(json["from"].get<std::string>());
    json["title"] = json["title"].get<std::string>() + " (" + file.filename().string() + ")";
  }
}

/// Lists each file once; the user's role wins.
std::vector<std::pair<NamedPicture, std::vector<std::string>>> by_file(const std::vector<NamedPicture>& named) {
  std::vector<std::pair<NamedPicture, std::vector<std::string>>> files;
  const auto place = [](const std::filesystem::path& file) {
    std::error_code error;
    const auto real = std::filesystem::weakly_canonical(file, error);
    return error ? file : real;
  };
  for (const NamedPicture& one : named) {
    auto found = std::find_if(files.begin(), files.end(), [&](const auto& other) {
      return place(other.first.file) == place(one.file) && !(other.first.wanted && one.wanted);
    });
    if (found == files.end()) {
      found = files.insert(files.end(), {one, {}});
    } else if (one.wanted) {
      found->first = one;
    }
    if (!one.tie.empty()) found->second.push_back(one.tie);
  }
  return files;
}

}  // namespace

Album load_album(const std::vector<NamedPicture>& named) {
  Album album;
  for (const auto& [one, ties] : by_file(named)) {
    Picture picture;
    try {
      picture = load_picture(one.role, one.file);
    } catch (const UserError& error) {
      if (one.wanted) throw;
      album.missing.push_back(error.what());
      continue;
    }
    if (picture.role.empty()) picture.role = role_of_engine(metadata_of(picture, "engine"));
    if (picture.role.empty()) picture.role = one.otherwise;
    picture.ties = ties;
    add(album.pictures, std::move(picture));
  }
  // The viewer's order, whatever the order of the results.
  static const std::vector<std::string> order{"golden", "reference", "integer", "test", "rtl", "blame", "saturation"};
  std::stable_sort(album.pictures.begin(), album.pictures.end(), [](const Picture& a, const Picture& b) {
    return std::find(order.begin(), order.end(), a.role) < std::find(order.begin(), order.end(), b.role);
  });
  return album;
}

Pages fit(const Album& album, Focus focus, std::size_t bytes) {
  Pages pages;
  std::vector<Picture> pictures = album.pictures;
  auto all = encoded(pictures);
  // All panes get the same window. Size follows the area, so two or three tries suffice.
  double share = 1.0;
  for (int tries = 0; tries < 12 && total_size(all) > bytes; ++tries) {
    share *= 0.97 * std::sqrt(static_cast<double>(bytes) / static_cast<double>(total_size(all)));
    bool smaller = false;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      if (album.pictures[i].display) continue;
      Picture cut = window(album.pictures[i], focus, share);
      smaller = smaller || cut.width < pictures[i].width || cut.height < pictures[i].height;
      pictures[i] = std::move(cut);
    }
    if (!smaller) break;
    all = encoded(pictures);
  }
  while (total_size(all) > bytes) {
    std::size_t largest = pictures.size();
    for (std::size_t i = 0; i < pictures.size(); ++i) {
      if (pictures[i].display && (largest == pictures.size() || all[i].bytes.size() > all[largest].bytes.size()))
        largest = i;
    }
    if (largest == pictures.size()) break;
    pages.remarks.push_back(fmt::format("{}: left out, because its {:.1f} MB do not fit", pictures[largest].from,
                                        static_cast<double>(base64_size(all[largest].bytes)) / 1e6));
    pictures.erase(pictures.begin() + static_cast<std::ptrdiff_t>(largest));
    all.erase(all.begin() + static_cast<std::ptrdiff_t>(largest));
  }

  const auto groups = groups_of(pictures);
  std::map<std::string, std::string> block_of;  // by shape and hash: equal pictures share one block
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    const Picture& picture = pictures[i];
    const std::string id = "picture-" + std::to_string(i);
    Json json = entry(picture, all[i], id, groups[i]);
    const auto [first, is_new] = block_of.emplace(
        fmt::format("{} {} {} {}", picture.width, picture.channels, all[i].word_bytes, all[i].sha256), id);
    if (is_new) {
      pages.blocks.push_back({id, all[i].bytes});
    } else {
      json["same_as"] = first->second;
    }
    if (json.contains("crop")) {
      pages.remarks.push_back(
          fmt::format("{}: cropped to {} x {} pixels of {} x {} from ({}, {}) to keep the report small", picture.from,
                      picture.width, picture.height, picture.full_width, picture.full_height, picture.x0, picture.y0));
    }
    pages.entries.push_back(std::move(json));
  }
  disambiguate(pages.entries);
  return pages;
}

}  // namespace fastsplat::report
