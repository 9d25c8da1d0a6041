#include "scene/volume/detached_file.hpp"

#include <algorithm>
#include <cctype>

#include "base/error.hpp"

namespace fastsplat::volume {
namespace {

namespace fs = std::filesystem;

bool names_several(const std::string& name) {
  std::string start = name.substr(0, 4);
  std::transform(start.begin(), start.end(), start.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return start == "list" || name.find('%') != std::string::npos || name.find(' ') != std::string::npos;
}

}  // namespace

fs::path detached_file(const fs::path& header, const std::string& place, const std::string& text) {
  const fs::path name = text;
  const std::string shown = text.substr(0, 120);
  const auto refuse = [&place](std::string what, std::string expected, std::string got, std::string fix) {
    throw_input({.where = place,
                 .what = std::move(what),
                 .expected = std::move(expected),
                 .got = std::move(got),
                 .fix = std::move(fix)});
  };
  const std::string fix = "keep the data file beside its header";
  std::error_code error;
  if (names_several(text) && !fs::exists(header.parent_path() / name, error)) {
    refuse("data spread over several files cannot be read", "one data file", shown, "join them (unu save -f nrrd)");
  }
  const bool upwards = std::any_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".."; });
  if (name.empty() || name.is_absolute() || upwards)
    refuse("the data file must lie in the header's own folder", "a relative name without '..'", shown, fix);
  const fs::path folder = fs::canonical(header.has_parent_path() ? header.parent_path() : fs::path("."), error);
  const fs::path data = error ? fs::path() : fs::weakly_canonical(folder / name, error);
  if (error) refuse("cannot find the data file: " + error.message(), {}, shown, fix);
  const auto [end, ignored] = std::mismatch(folder.begin(), folder.end(), data.begin(), data.end());
  if (end != folder.end()) {
    refuse("the data file is a link out of the header's own folder", {}, shown + " -> " + data.string(), fix);
  }
  return data;
}

}  // namespace fastsplat::volume
