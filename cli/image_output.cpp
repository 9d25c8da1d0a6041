#include "cli/image_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/atomic_file.hpp"
#include "base/error.hpp"

namespace fastsplat::cli {
namespace {

namespace fs = std::filesystem;

std::string ending(const std::string& path) {
  std::string text = fs::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

void require_ending(const std::string& path, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), ending(path)) != known.end()) return;
  throw_usage({.where = path,
               .what = "the ending does not name an image format written here",
               .expected = fmt::format("{}", fmt::join(known, ", ")),
               .got = ending(path).empty() ? "none" : ending(path),
               .fix = "end the name in " + known.front()});
}

// A device or a pipe takes text, whatever becomes of it; anything else must be creatable.
void require_writable(const std::string& path) {
  std::error_code ignored;
  const auto status = fs::status(path, ignored);
  if (fs::is_character_file(status) || fs::is_fifo(status)) return;
  const AtomicFile probe(path);
}

images::WriteOptions options_for(const std::string& path) {
  if (ending(path) == ".exr") return {.kind = images::PixelKind::Float, .display = false};
  if (ending(path) == ".png") return {.kind = images::PixelKind::Uint8, .display = true};
  return {.kind = images::PixelKind::Uint16, .display = false};
}

}  // namespace

void declare_images(Options& options, std::vector<std::string>& out, std::string& raw) {
  options.group("Output");
  options.words("-o,--out", out, "FILE",
                "image: .exr (float, linear), .tif (16 bit, linear), .png (8 bit, sRGB); repeatable");
  options.word("--raw", raw, "FILE", "the device's raw integer words as .exr (cmodel, rtl)");
}

void check_outputs(const OutputNames& names) {
  std::set<fs::path> seen;
  const auto place = [](const std::string& path) {
    std::error_code ignored;
    return fs::weakly_canonical(fs::absolute(path, ignored), ignored);
  };
  const auto take = [&](const std::string& path) {
    if (path.empty() || path == "-") return;
    if (!seen.insert(place(path)).second) {
      throw_usage({.where = path,
                   .what = "one name for two files of this command",
                   .expected = {},
                   .got = {},
                   .fix = "give each its own"});
    }
    require_writable(path);
  };
  for (const auto& path : names.inputs) seen.insert(place(path));
  for (const auto& path : names.images) {
    require_ending(path, {".exr", ".png", ".tif", ".tiff"});
    take(path);
  }
  for (const auto& path : names.maps) {
    if (!path.empty()) require_ending(path, {".png"});
    take(path);
  }
  for (const auto& path : names.raws) {
    if (!path.empty()) require_ending(path, {".exr"});
    take(path);
  }
  for (const auto& path : names.others) take(path);
  const auto named = [](const std::string& path) { return !path.empty(); };
  for (const auto* pictures : {&names.images, &names.maps, &names.raws}) {
    if (std::any_of(pictures->begin(), pictures->end(), named)) images::require_library();
  }
}

void write_images(const std::vector<std::string>& paths, const Image& image, const Image& shown,
                  const images::Metadata& metadata, const Output& output) {
  for (const auto& path : paths) {
    const auto options = options_for(path);
    auto labelled = metadata;
    if (options.display) labelled["display"] = "srgb";
    const std::size_t clamped = images::write_image(path, ending(path) == ".exr" ? image : shown, labelled, options);
    if (clamped > 0) {
      output.warn(fmt::format("{}: {} values lay outside 0..1 and were clamped; write .exr to keep them", path,
                              grouped(clamped)));
    }
    output.line(path);
  }
}

void warn_if_empty(const Image& image, const Output& output) {
  if (std::all_of(image.data.begin(), image.data.end(), [](float value) { return value == 0.0f; })) {
    output.warn("the picture is empty; try another --tf, a larger --opacity-scale or another --zoom");
  }
}

}  // namespace fastsplat::cli
