// SPDX-License-Identifier: Apache-2.0
// Files of 3-D Gaussians of every format are read or refused. What is read is valid, and a file written from it has as
// many Gaussians. The first byte of an input selects the format to write and whether the rest is the file itself, is
// packed by gzip, or is the meta.json of a SOG folder: random changes do not keep the checksums of archives.
#include <webp/encode.h>

#include <array>

#include "scene/gaussians/gaussian_file.hpp"
#include "scene/gaussians/packed_bytes.hpp"
#include "tests/fuzz/fuzz.hpp"

namespace {

namespace fs = std::filesystem;
using namespace fastsplat;

fuzz::Bytes bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

/// Writes the pictures of a SOG scene of at most 64 Gaussians, with harmonics of degree 1, beside meta.json.
void write_sog_pictures(const fs::path& folder) {
  const auto write = [&folder](const char* name, int width, int height) {
    std::string pixels;
    for (int i = 0; i < width * height; ++i)
      for (const int channel : {i % 8, i * 3 % 8, i / 8 % 8, 252 + i % 4}) pixels += static_cast<char>(channel);
    std::uint8_t* webp = nullptr;
    const std::size_t size =
        WebPEncodeLosslessRGBA(reinterpret_cast<const std::uint8_t*>(pixels.data()), width, height, 4 * width, &webp);
    std::ofstream(folder / name, std::ios::binary).write(reinterpret_cast<const char*>(webp), std::streamsize(size));
    WebPFree(webp);
  };
  for (const char* name : {"means_l.webp", "means_u.webp", "quats.webp", "scales.webp", "sh0.webp", "shN_labels.webp"})
    write(name, 8, 8);
  write("shN_centroids.webp", 192, 32);
}

fs::path input_of(unsigned choice, fuzz::Bytes bytes) {
  if (choice / 8 % 4 == 1) {
    const std::string packed = scene::gzip({bytes.begin(), bytes.end()});
    return fuzz::file_of(bytes_of(packed), ".spz");
  }
  if (choice / 8 % 4 == 2) {
    const fs::path path = fuzz::file_of(bytes, "meta.json");
    static const bool once = (write_sog_pictures(path.parent_path()), true);
    return once ? path : fs::path();
  }
  return fuzz::file_of(bytes, choice % 2 == 0 ? ".ply" : ".splat");  // other formats by their content
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::Bytes bytes{data, size};
  constexpr std::array kWritten{".ply", ".compressed.ply", ".spz", ".glb"};
  const std::uint8_t choice = fuzz::take_byte(bytes);
  const auto path = input_of(choice, bytes);
  fuzz::answered([&] {
    const scene::GaussianCloud cloud = scene::load_gaussians(path.string());
    const auto harmonics = static_cast<std::size_t>(scene::harmonic_count(cloud.degree));
    if (cloud.gaussians.empty() || cloud.harmonics.size() != cloud.gaussians.size() * harmonics)
      fuzz::finding("not as many colours as Gaussians");
    for (std::size_t i = 0; i < cloud.gaussians.size(); ++i)
      scene::check_gaussian(cloud.gaussians[i], cloud.harmonics_of(i), "read");
    const std::filesystem::path again = path.string() + kWritten[choice / 2 % kWritten.size()];
    scene::save_gaussians(cloud, again);
    const scene::GaussianCloud copy = scene::load_gaussians(again.string());
    std::filesystem::remove(again);
    if (copy.gaussians.size() != cloud.gaussians.size() || copy.degree != cloud.degree)
      fuzz::finding("written and read again it is another scene");
  });
  return 0;
}
