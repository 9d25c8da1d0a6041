// SPDX-License-Identifier: Apache-2.0
#include "base/file_beside.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace fastsplat {

namespace fs = std::filesystem;

fs::path file_beside(const fs::path& header, const std::string& text, const std::string& where) {
  const fs::path name = text;
  const auto refuse = [&](const std::string& what, const std::string& expected, const std::string& got) {
    throw_input({.where = where,
                 .what = what,
                 .expected = expected,
                 .got = got,
                 .fix = "keep the data file beside its header"});
  };
  const std::string shown = text.substr(0, 120);
  const bool upwards = std::any_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
  if (name.empty() || name.is_absolute() || upwards || text.find('\0') != text.npos)
    refuse("the data file must be in the header's folder", "a relative name without '..'", shown);
  std::error_code error;
  const fs::path folder = fs::canonical(header.has_parent_path() ? header.parent_path() : fs::path("."), error);
  const fs::path data = error ? fs::path() : fs::weakly_canonical(folder / name, error);
  if (error) refuse("cannot find the data file: " + error.message(), {}, shown);
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), data.begin(), data.end());
  if (end != folder.end())
    refuse("the data file is a link to outside the header's folder", {}, shown + " -> " + data.string());
  return data;
}

}  // namespace fastsplat
