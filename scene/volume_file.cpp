#include "scene/volume_file.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cstdlib>

#include "base/error.hpp"
#include "base/suggest.hpp"
#include "scene/synthetic.hpp"

namespace fastsplat::scene {
std::vector<std::string> known_volume_names() {
  auto names = synthetic_names();
  names.insert(names.end(), {"ch2", "ch2bet", "inia19-t1-brain"});
  return names;
}
Volume load_volume(const std::string& name_or_path) {
  const auto colon = name_or_path.find(':');
  const std::string base = name_or_path.substr(0, colon);
  return make_synthetic(
      base, colon == std::string::npos ? default_synthetic_size(base) : std::atoi(name_or_path.c_str() + colon + 1));
}
}  // namespace fastsplat::scene
