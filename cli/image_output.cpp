// SPDX-License-Identifier: Apache-2.0
#include "cli/image_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/lower_case.hpp"
#include "cli/output_names.hpp"

namespace fastsplat::cli {
namespace {

images::WriteOptions options_for(const std::string& path) {
  if (ending_of(path) == ".exr") return {.kind = images::PixelKind::Float, .display = false};
  if (ending_of(path) == ".png") return {.kind = images::PixelKind::Uint8, .display = true};
  return {.kind = images::PixelKind::Uint16, .display = false};
}

}  // namespace

void declare_images(Options& options, std::vector<std::string>& out, std::string& raw) {
  options.group("Output");
  options.words("-o,--out", out, "FILE",
                "write the image: .exr (float, linear), .tif (16 bit, linear), .png (8 bit, sRGB); repeatable");
  options.word("--raw", raw, "FILE", "write the device's raw integer words as .exr (cmodel, rtl)");
}

void write_images(const std::vector<std::string>& paths, const Image& image, const Shown& shown,
                  const images::Metadata& metadata, const Output& output) {
  if (std::ranges::all_of(image.data, [](float value) { return value == 0.0F; }))
    output.warn("the picture is empty: the camera sees nothing, or all that it sees is transparent");
  std::optional<Image> made;
  for (const auto& path : paths) {
    const auto options = options_for(path);
    auto labelled = metadata;
    if (options.display) labelled["display"] = "srgb";
    const bool as_it_is = !shown || ending_of(path) == ".exr";
    if (!as_it_is && !made) made = shown(image);
    const std::size_t clamped = images::write_image(path, as_it_is ? image : *made, labelled, options);
    if (clamped > 0) {
      output.warn(
          fmt::format("{}: {} values outside 0..1 were clamped; write .exr to keep them", path, grouped(clamped)));
    }
    output.line(path);
  }
}

}  // namespace fastsplat::cli
