#include "scene/volume/detached_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <regex>

#include "base/lower_case.hpp"
#include "base/number_text.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxFiles = 65535;
constexpr const char* kBeside = "keep the data file beside its header";

fs::path file_beside(const TextHeader& header, int line, const std::string& text) {
  const fs::path name = text;
  const std::string shown = text.substr(0, 120);
  const bool upwards = std::any_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
  if (name.empty() || name.is_absolute() || upwards) {
    header.refuse(line, "the data file must lie in the header's own folder", "a relative name without '..'", shown,
                  kBeside);
  }
  std::error_code error;
  const fs::path folder =
      fs::canonical(header.path.has_parent_path() ? header.path.parent_path() : fs::path("."), error);
  const fs::path data = error ? fs::path() : fs::weakly_canonical(folder / name, error);
  if (error) header.refuse(line, "cannot find the data file: " + error.message(), {}, shown, kBeside);
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), data.begin(), data.end());
  if (end != folder.end()) {
    header.refuse(line, "the data file is a link out of the header's own folder", {}, shown + " -> " + data.string(),
                  kBeside);
  }
  return data;
}

/// The names that `PATTERN MIN MAX STEP [DIMENSION]` stands for; nothing where `text` is not of that form.
std::optional<std::vector<std::string>> names_of_pattern(const TextHeader& header, int line, const std::string& text) {
  static const std::regex kPattern(R"((\S*)%(0?)(\d?)d(\S*)\s+(-?\d{1,6})\s+(-?\d{1,6})\s+(-?\d{1,6})(\s+\d+)?)");
  std::smatch part;
  if (!std::regex_match(text, part, kPattern)) return std::nullopt;
  const int first = *integer_from<int>(part[5].str());
  const int last = *integer_from<int>(part[6].str());
  const int step = *integer_from<int>(part[7].str());
  if (step == 0 || (last - first) / step < 0 || static_cast<std::size_t>((last - first) / step) >= kMaxFiles) {
    header.refuse(line, "the numbers of the data files lead nowhere", fmt::format("1 to {} files", kMaxFiles),
                  text.substr(0, 120), "correct the first number, the last one and the step");
  }
  const int width = part[3].length() > 0 ? *integer_from<int>(part[3].str()) : 0;
  std::vector<std::string> names;
  for (int i = 0; i <= (last - first) / step; ++i) {
    const int number = first + i * step;
    names.push_back(
        part[1].str() +
        (part[2].length() > 0 ? fmt::format("{:0{}}", number, width) : fmt::format("{:{}}", number, width)) +
        part[4].str());
  }
  return names;
}

}  // namespace

bool says_list(const std::string& value) {
  const auto words = words_of(value);
  return (words.size() == 1 || words.size() == 2) && lower_case(words[0]) == "list";
}

std::vector<fs::path> detached_files(const TextHeader& header, const TextHeader::Field& field) {
  std::vector<std::string> names{field.value};
  int line = field.line;
  int lines_each = 0;
  std::error_code error;
  if (const bool exists = fs::exists(header.path.parent_path() / field.value, error); exists && !error) {
  } else if (says_list(field.value)) {
    names = header.listed_files;
    lines_each = 1;
    if (names.empty() || names.size() > kMaxFiles) {
      header.refuse(field.line, "the list of data files has an impossible length", fmt::format("1 to {}", kMaxFiles),
                    fmt::format("{}", names.size()), "write one name a line behind this field");
    }
  } else if (auto numbered = names_of_pattern(header, field.line, field.value)) {
    names = std::move(*numbered);
  }
  std::vector<fs::path> files;
  for (const auto& name : names) files.push_back(file_beside(header, line += lines_each, name));
  return files;
}

}  // namespace fastsplat::volume
