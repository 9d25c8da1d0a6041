// scene.toml. Every key is optional; what is absent keeps its default.
//
//   volume = "ch2bet"               # a path (relative to this file), a built-in "shells:128", or a known scan
//   transfer_function = "mri-head"  # a preset or a path to a .toml; "" or absent: chosen by the volume
//   method = "image_aligned"        # raycast, xray, westover, axis_aligned, image_aligned
//   shading = "auto"                # auto (as the transfer function says), on, off
//   opacity_scale = 1.0             # multiplies extinction, > 0
//
//   [camera]
//   projection = "orthographic"     # or perspective
//   azimuth = 30.0                  # degrees about the vertical axis; 0 sees a head from the front
//   elevation = 15.0                # degrees, positive looks down from above
//   roll = 0.0                      # degrees
//   zoom = 1.0                      # 1 fits the volume
//   fov = 30.0                      # degrees across the smaller image side, perspective only
//
//   [image]
//   width = 512                     # pixels; or size = 512 for both
//   height = 512
//
//   [kernel]
//   name = "gauss2"                 # or smooth; or instead of a name:
//   a = 2.0                         # exp(-a r^2)
//   radius = 2.0                    # kernel units
//
//   [slabs]                         # image_aligned
//   width = 1.0                     # kernel units
//   opacity = "exponential"         # or additive
//
//   [xray]                          # xray
//   sheets = 1                      # the image must not depend on it
//   exposure = 0.0                  # pixel = exposure * integral; 0: automatic
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/error.hpp"
#include "base/suggest.hpp"
#include "scene/scene.hpp"
#include "scene/scene_limits.hpp"
#include "scene/synthetic.hpp"
#include "scene/toml_reader.hpp"
#include "scene/volume_file.hpp"

namespace fastsplat::scene {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kShadings = {"auto", "off", "on"};  // -1, 0, 1
const std::vector<std::string> kProjections = {"orthographic", "perspective"};

/// Position of a word in `names`, or `otherwise` when the key is absent.
int word(TomlTable& table, const char* key, const std::vector<std::string>& names, int otherwise) {
  const auto got = table.text(key);
  if (!got) return otherwise;
  const auto found = std::find(names.begin(), names.end(), *got);
  if (found == names.end()) table.refuse(key, "unknown name", {}, "\"" + *got + "\"", suggestion(*got, names));
  return static_cast<int>(found - names.begin());
}

bool is_known_volume(const std::string& text) {
  const auto names = known_volume_names();
  return std::find(names.begin(), names.end(), text.substr(0, text.find(':'))) != names.end();
}

bool is_preset(const std::string& text) {
  const auto names = transfer_function_presets();
  return std::find(names.begin(), names.end(), text) != names.end();
}

std::string anchored(const std::string& text, const fs::path& folder) {
  return fs::absolute(folder / text).lexically_normal().string();
}

void read_numbers(TomlTable& table, const std::string& name, SceneDescription& description) {
  for (const auto& setting : real_settings()) {
    if (name != setting.table) continue;
    if (const auto value = table.number(setting.key, setting.low, setting.high)) setting.field(description) = *value;
  }
  for (const auto& setting : integer_settings()) {
    if (name != setting.table) continue;
    if (const auto value = table.integer(setting.key, setting.low, setting.high)) setting.field(description) = *value;
  }
}

void read_image(TomlTable& table, SceneDescription& d) {
  const auto size = table.integer("size", 1, kMaxImageSide);
  if (!size) return;
  for (const char* key : {"width", "height"}) {
    if (table.has(key)) table.refuse(key, "given twice", "either size, or width and height", {}, "remove one of them");
  }
  d.width = d.height = *size;
}

void read_kernel(TomlTable& table, SceneDescription& d) {
  const auto name = table.text("name");
  const bool shaped = table.has("a") || table.has("radius");
  if (name && !name->empty()) {
    if (shaped)
      table.refuse("name", "a kernel has either a name or a shape", {}, {}, "remove name, or remove a and radius");
    const auto names = kernel_names();
    if (std::find(names.begin(), names.end(), *name) == names.end())
      table.refuse("name", "unknown kernel", {}, "\"" + *name + "\"", suggestion(*name, names));
    d.kernel = *name;
  } else if (shaped) {
    d.kernel.clear();
  }
}

std::string toml_string(const std::string& text) {
  std::string out = "\"";
  for (const unsigned char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += static_cast<char>(c);
    } else if (c < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", c);
    } else {
      out += static_cast<char>(c);
    }
  }
  return out + "\"";
}

/// A number TOML reads back as a float.
std::string toml_real(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

}  // namespace

SceneDescription load_scene_file(const fs::path& path) {
  SceneDescription d;
  TomlTable root = TomlTable::parse_file(path);
  const fs::path folder = path.parent_path();
  if (const auto text = root.text("volume")) {
    if (text->empty())
      root.refuse("volume", "empty", "a volume's path or name", {}, "for example volume = \"shells:64\"");
    d.volume = is_known_volume(*text) ? *text : anchored(*text, folder);
  }
  if (const auto text = root.text("transfer_function")) {
    d.transfer_function = text->empty() || is_preset(*text) ? *text : anchored(*text, folder);
    const bool file = fs::path(*text).has_parent_path() || fs::path(*text).extension() == ".toml";
    if (!text->empty() && !is_preset(*text) && !file) {
      root.refuse("transfer_function", "unknown preset", {}, "\"" + *text + "\"",
                  suggestion(*text, transfer_function_presets()));
    }
  }
  d.method = static_cast<Method>(word(root, "method", method_names(), static_cast<int>(d.method)));
  d.shading = word(root, "shading", kShadings, d.shading + 1) - 1;
  read_numbers(root, "", d);
  for (const char* name : {"camera", "image", "kernel", "slabs", "xray"}) {
    auto table = root.table(name);
    if (!table) continue;
    read_numbers(*table, name, d);
    if (name == std::string("camera")) {
      d.camera.projection =
          static_cast<Projection>(word(*table, "projection", kProjections, static_cast<int>(d.camera.projection)));
    } else if (name == std::string("image")) {
      read_image(*table, d);
    } else if (name == std::string("kernel")) {
      read_kernel(*table, d);
    } else if (name == std::string("slabs")) {
      d.slab_opacity =
          static_cast<SlabOpacity>(word(*table, "opacity", slab_opacity_names(), static_cast<int>(d.slab_opacity)));
    }
    table->finish();
  }
  root.finish();
  return d;
}

std::string to_toml(const SceneDescription& description) {
  SceneDescription d = description;
  std::map<std::string, std::string> words;  // the keys of each table that are not numbers
  const std::string volume = is_known_volume(d.volume) ? d.volume : anchored(d.volume, {});
  const std::string tf = d.transfer_function.empty() || is_preset(d.transfer_function)
                             ? d.transfer_function
                             : anchored(d.transfer_function, {});
  words[""] = fmt::format("volume = {}\ntransfer_function = {}\nmethod = {}\nshading = {}\n", toml_string(volume),
                          toml_string(tf), toml_string(to_string(d.method)),
                          toml_string(kShadings[static_cast<std::size_t>(d.shading + 1)]));
  words["camera"] =
      fmt::format("projection = {}\n", toml_string(kProjections[static_cast<std::size_t>(d.camera.projection)]));
  words["slabs"] = fmt::format("opacity = {}\n", toml_string(to_string(d.slab_opacity)));
  if (!d.kernel.empty()) words["kernel"] = fmt::format("name = {}\n", toml_string(d.kernel));

  std::string text;
  for (const std::string table : {"", "camera", "image", "kernel", "slabs", "xray"}) {
    if (!table.empty()) text += fmt::format("\n[{}]\n", table);
    text += words[table];
    for (const auto& setting : real_settings()) {
      const bool named = table == "kernel" && !d.kernel.empty();
      if (table == setting.table && !named) text += fmt::format("{} = {}\n", setting.key, toml_real(setting.field(d)));
    }
    for (const auto& setting : integer_settings()) {
      if (table == setting.table) text += fmt::format("{} = {}\n", setting.key, setting.field(d));
    }
  }
  return text;
}

}  // namespace fastsplat::scene
