// SPDX-License-Identifier: Apache-2.0
#include "report/file_names.hpp"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <set>
#include <string_view>

namespace fastsplat::report {
namespace {

bool is_blank(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }
bool is_quote(char c) { return c == '"' || c == '\'' || c == '`'; }
bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// Whether a path can begin at `at`, judging by the text before it; -o/a/b is a flag with its value.
bool may_begin(std::string_view text, std::size_t at) {
  if (at == 0) return true;
  const std::string_view before = text.substr(0, at);
  if (before.ends_with("file://")) return true;
  const char last = before.back();
  if (is_blank(last) || is_quote(last) || std::string_view("=,;:([{<>|").find(last) != std::string_view::npos)
    return true;
  return is_word(last) && at >= 2 && text[at - 2] == '-' && (at == 2 || is_blank(text[at - 3]));
}

/// Length of the mark that begins a path: "/", "~", "../"; 0 for none. Dates, fractions and URLs are not paths.
std::size_t beginning(std::string_view rest) {
  const auto names = [&](std::size_t at) {
    return at < rest.size() && (is_word(rest[at]) || static_cast<unsigned char>(rest[at]) >= 0x80 ||
                                std::string_view("._-~+@%").find(rest[at]) != std::string_view::npos);
  };
  if (rest.starts_with("../") && names(3)) return 3;
  if (rest.starts_with('/') && names(1)) return 1;
  if (!rest.starts_with('~') || (rest.size() > 1 && std::isdigit(static_cast<unsigned char>(rest[1])))) return 0;
  std::size_t slash = 1;
  while (slash < rest.size() && is_word(rest[slash])) ++slash;
  return slash < rest.size() && rest[slash] == '/' && names(slash + 1) ? slash + 1 : 0;
}

/// End of the path that begins at `at`. In quotes: the closing one. A text that is only a path may contain blanks;
/// otherwise it ends at a blank or quote, without the punctuation before it.
std::size_t ending(std::string_view text, std::size_t at) {
  const std::string_view rest = text.substr(at);
  if (at > 0 && is_quote(text[at - 1])) {
    std::size_t quote = text.find(text[at - 1], at);
    // Escaped quotes, as in a shell and in TOML.
    while (quote != std::string_view::npos && (text[quote - 1] == '\\' || text.substr(quote).starts_with("'\\''")))
      quote = text.find(text[at - 1], quote + (text[quote - 1] == '\\' ? 1 : 4));
    if (quote != std::string_view::npos) return quote;
  }
  const bool alone = at == 0 && rest.find('\n') == std::string_view::npos &&
                     rest.find(": ") == std::string_view::npos && rest.find(" /") == std::string_view::npos;
  if (alone) return text.size();
  const auto stops = [&](std::size_t i) {
    const bool next_one = i + 1 < text.size() && text[i + 1] == '/' && (text[i] == ',' || text[i] == ':');
    return is_blank(text[i]) || is_quote(text[i]) || text[i] == '<' || text[i] == '|' || next_one;
  };
  std::size_t end = at;
  while (end < text.size() && !stops(end)) end += text[end] == '\\' && end + 1 < text.size() ? 2 : 1;
  end = std::min(end, text.size());
  while (end > at + 1 && std::string_view(",;:.)]}>").find(text[end - 1]) != std::string_view::npos) --end;
  return end;
}

struct Split {
  std::string_view folder, name;  ///< "/a/b/", "c"
};

/// Hides the whole path for a child of /home or /Users, whose name is a user's.
Split split(std::string_view path) {
  std::string_view stem = path;
  while (stem.size() > 1 && stem.ends_with('/')) stem.remove_suffix(1);
  const std::size_t slash = stem.rfind('/');
  const std::string_view folder = stem.substr(0, slash + 1);
  if (folder == "/home/" || folder == "/Users/") return {.folder = path, .name = "."};
  return {.folder = folder, .name = path.substr(slash + 1)};
}

/// Replaces each path in a text, in order, by the result of `take`.
std::string each_path(std::string_view text, const std::function<std::string(std::string_view)>& take) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const bool found = beginning(text.substr(at)) > 0 && may_begin(text, at);
    const std::size_t end = found ? ending(text, at) : at;
    if (end <= at + 1 || split(text.substr(at, end - at)).folder == "/") {
      out += text[at++];
      continue;
    }
    if (out.ends_with("file://")) out.resize(out.size() - 7);
    out += take(text.substr(at, end - at));
    at = end;
  }
  return out;
}

Json each_text(const Json& json, const std::function<std::string(const std::string&)>& change) {
  if (json.is_string()) return change(json.get<std::string>());
  if (!json.is_structured()) return json;
  Json out = json.is_array() ? Json::array() : Json::object();
  for (const auto& [key, value] : json.items()) {
    if (json.is_array()) {
      out.push_back(each_text(value, change));
    } else {
      out[change(key)] = each_text(value, change);
    }
  }
  return out;
}

/// A folder without a shell's escaped quotes, so that it is the same in a command and elsewhere.
std::string plain(std::string_view folder) {
  std::string text(folder);
  for (auto at = text.find("'\\''"); at != std::string::npos; at = text.find("'\\''", at + 1)) text.replace(at, 4, "'");
  return text;
}

/// Replacement of each folder: empty, or a number if its files' names also occur in another folder.
class Folders {
 public:
  void meet(std::string_view path) {
    const auto [raw, name] = split(path);
    const std::string folder = plain(raw);
    if (label_.try_emplace(folder).second) order_.push_back(folder);
    names_[std::string(name)].insert(folder);
  }

  void number() {
    for (const auto& [name, folders] : names_) {
      for (std::size_t i = 0; name != "." && folders.size() > 1 && i < order_.size(); ++i) {
        if (folders.contains(order_[i]) && i > first(folders))
          label_[order_[i]] = "folder-" + std::to_string(i + 1) + "/";
      }
    }
  }

  std::string shown(std::string_view path) const {
    const auto [folder, name] = split(path);
    const auto label = label_.find(plain(folder));
    return (label == label_.end() ? "" : label->second) + std::string(name);
  }

  /// Messages name files without quotes; finds folders with blanks or quotes that are known from elsewhere.
  std::string without_blanks(std::string text) const {
    for (const auto& [folder, label] : label_) {
      if (folder.find_first_of(" '\"`") == std::string::npos || !folder.ends_with('/')) continue;
      for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder, at + label.size()))
        text.replace(at, folder.size(), label);
    }
    return text;
  }

 private:
  std::size_t first(const std::set<std::string>& folders) const {
    return static_cast<std::size_t>(
        std::find_if(order_.begin(), order_.end(), [&](const auto& one) { return folders.contains(one); }) -
        order_.begin());
  }

  std::vector<std::string> order_;
  std::map<std::string, std::string, std::greater<>> label_;  ///< longer folders before their prefixes
  std::map<std::string, std::set<std::string>> names_;        ///< by file name: its folders
};

}  // namespace

Json without_folders(const Json& data) {
  Folders folders;
  each_text(data, [&](const std::string& text) {
    return each_path(text, [&](std::string_view path) {
      folders.meet(path);
      return std::string(path);
    });
  });
  folders.number();
  return each_text(data, [&](const std::string& text) {
    return each_path(folders.without_blanks(text), [&](std::string_view path) { return folders.shown(path); });
  });
}

std::vector<Result> without_folders(const std::vector<Result>& results) {
  Json all = Json::array();
  for (const Result& result : results) all.push_back({{"file", result.file.string()}, {"json", result.json}});
  Json cut = without_folders(all);
  std::vector<Result> out = results;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].shown = cut[i]["file"].get<std::string>();
    out[i].json = std::move(cut[i]["json"]);
  }
  return out;
}

}  // namespace fastsplat::report
