// SPDX-License-Identifier: Apache-2.0
#include "tests/architecture/source_helper.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <functional>
#include <regex>
#include <sstream>

namespace fastsplat::architecture {
namespace {

namespace fs = std::filesystem;

// Comments become blanks (newlines stay); string and character contents vanish when `strings` says so.
enum class Strings { Keep, Empty };

std::string strip(const std::string& text, Strings strings) {
  std::string out;
  out.reserve(text.size());
  std::size_t at = 0;
  const auto starts = [&](const char* what) {
    return text.compare(at, std::char_traits<char>::length(what), what) == 0;
  };
  while (at < text.size()) {
    if (starts("//")) {
      while (at < text.size() && text[at] != '\n') ++at;
    } else if (starts("/*")) {
      const auto end = std::min(text.find("*/", at + 2), text.size());
      out += std::string(static_cast<std::size_t>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                                             text.begin() + static_cast<std::ptrdiff_t>(end), '\n')),
                         '\n');
      at = std::min(end + 2, text.size());
      out += ' ';
    } else if (starts("R\"")) {
      const auto open = text.find('(', at);
      const auto closing = ")" + text.substr(at + 2, open - at - 2) + "\"";
      const auto end = std::min(text.find(closing, open), text.size());
      const auto whole = text.substr(at, end + closing.size() - at);
      out += strings == Strings::Keep
                 ? whole
                 : "\"\"" + std::string(static_cast<std::size_t>(std::count(whole.begin(), whole.end(), '\n')), '\n');
      at = std::min(end + closing.size(), text.size());
    } else if (text[at] == '"' ||
               (text[at] == '\'' && (at == 0 || !std::isalnum(static_cast<unsigned char>(text[at - 1]))))) {
      const char quote = text[at];
      const auto begin = at++;
      while (at < text.size() && text[at] != quote && text[at] != '\n') at += text[at] == '\\' ? 2 : 1;
      at = std::min(at + 1, text.size());
      out += strings == Strings::Keep ? text.substr(begin, at - begin) : std::string(2, quote);
    } else {
      out += text[at++];
    }
  }
  return out;
}

}  // namespace

std::vector<SourceFile> read_sources(const fs::path& root, const std::vector<std::string>& folders,
                                     const std::set<std::string>& endings) {
  std::vector<SourceFile> files;
  for (const auto& folder : folders) {
    if (!fs::is_directory(root / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      if (!entry.is_regular_file() || !endings.contains(entry.path().extension().string())) continue;
      std::ostringstream text;
      text << std::ifstream(entry.path(), std::ios::binary).rdbuf();
      files.push_back({fs::relative(entry.path(), root).generic_string(), text.str()});
    }
  }
  std::sort(files.begin(), files.end(), [](const auto& a, const auto& b) { return a.path < b.path; });
  return files;
}

std::string without_comments(const std::string& text) { return strip(text, Strings::Empty); }

std::vector<Include> includes_of(const std::string& text) {
  static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<Include> found;
  std::istringstream lines(strip(text, Strings::Keep));
  std::string line;
  std::smatch match;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (std::regex_search(line, match, pattern)) found.push_back({match[1].str(), number});
  }
  return found;
}

std::vector<Word> words_of(const std::string& text) {
  static const std::regex pattern(R"([A-Za-z_]\w*|(?:\d[\w']*)?\.?\d[\w'.]*(?:[eEpP][+-]\d+)?)");
  std::vector<Word> words;
  std::istringstream lines(without_comments(text));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    for (std::sregex_iterator match(line.begin(), line.end(), pattern), end; match != end; ++match) {
      words.push_back({match->str(), number});
    }
  }
  // without_comments() emptied the quotes of #include "x"; its parts count as words too.
  static const std::regex part(R"([A-Za-z_]\w*)");
  for (const auto& include : includes_of(text)) {
    for (std::sregex_iterator match(include.target.begin(), include.target.end(), part), end; match != end; ++match) {
      words.push_back({match->str(), include.line});
    }
  }
  return words;
}

std::string room_of(const std::string& path, const Arrows& arrows) {
  for (auto end = path.rfind('/'); end != std::string::npos && end > 0; end = path.rfind('/', end - 1)) {
    const std::string room = path.substr(0, end);
    if (arrows.contains(room)) return room;
  }
  return {};
}

std::vector<std::string> arrow_offences(const std::vector<SourceFile>& files, const Arrows& arrows, int& checked) {
  std::vector<std::string> offences;
  for (const auto& file : files) {
    const std::string own = room_of(file.path, arrows);
    const auto allowed = arrows.find(own);
    for (const auto& include : includes_of(file.text)) {
      if (include.target.starts_with(".") ||
          (include.target.ends_with(".hpp") && include.target.find('/') == std::string::npos)) {
        ++checked;
        offences.push_back(file.path + ":" + std::to_string(include.line) + ": includes " + include.target +
                           "; write the path from the root of the repository");
        continue;
      }
      const auto room = room_of(include.target, arrows);
      if (room.empty()) continue;
      ++checked;
      if (room == own) continue;
      if (allowed != arrows.end() && allowed->second.contains(room)) continue;
      std::string list;
      if (allowed != arrows.end()) {
        for (const auto& name : allowed->second) list += " " + name;
      }
      offences.push_back(file.path + ":" + std::to_string(include.line) + ": includes " + include.target + "; " + own +
                         " may include only itself and:" + (list.empty() ? " nothing" : list));
    }
  }
  return offences;
}

std::string include_ring(const std::vector<SourceFile>& files) {
  std::map<std::string, std::vector<std::string>> edges;
  for (const auto& file : files) edges[file.path] = {};
  for (const auto& file : files) {
    for (const auto& include : includes_of(file.text)) {
      if (edges.contains(include.target)) edges[file.path].push_back(include.target);
    }
  }
  std::map<std::string, int> state;  // 1: on the current path, 2: done
  std::vector<std::string> path;
  std::string ring;
  const std::function<void(const std::string&)> visit = [&](const std::string& node) {
    state[node] = 1;
    path.push_back(node);
    for (const auto& next : edges[node]) {
      if (!ring.empty()) return;
      if (state[next] == 1) {
        for (auto it = std::find(path.begin(), path.end(), next); it != path.end(); ++it) ring += *it + " -> ";
        ring += next;
        return;
      }
      if (state[next] == 0) visit(next);
    }
    path.pop_back();
    state[node] = 2;
  };
  for (const auto& [node, unused] : edges) {
    if (state[node] == 0 && ring.empty()) visit(node);
  }
  return ring;
}

std::vector<std::string> device_word_offences(const std::vector<SourceFile>& files, int& checked) {
  static const std::set<std::string> forbidden{
      // real numbers
      "float", "double", "float_t", "double_t", "_Float16", "_Float32", "_Float64", "cmath", "math", "complex", "sqrt",
      "exp", "erf", "glm", "Eigen",
      // threads
      "thread", "jthread", "mutex", "shared_mutex", "atomic", "condition_variable", "future", "async", "execution",
      "tbb", "pthread", "thread_local", "volatile",
      // clocks and chance
      "chrono", "ctime", "time", "clock", "clock_gettime", "gettimeofday", "random", "rand", "srand", "random_device",
      "mt19937", "getenv", "unordered_map", "unordered_set"};
  static const std::regex real_literal(R"(^(?!0[xX])[\d']*(\.[\d']*([eE][+-]?\d+)?|[eE][+-]?\d+)[fFlL]?$)");
  std::vector<std::string> offences;
  for (const auto& file : files) {
    for (const auto& word : words_of(file.text)) {
      ++checked;
      const bool number = std::isdigit(static_cast<unsigned char>(word.text[0])) != 0 || word.text[0] == '.';
      if (number ? std::regex_match(word.text, real_literal) : forbidden.contains(word.text)) {
        offences.push_back(file.path + ":" + std::to_string(word.line) + ": '" + word.text +
                           "' has no place in an integer device");
      }
    }
  }
  return offences;
}

}  // namespace fastsplat::architecture
