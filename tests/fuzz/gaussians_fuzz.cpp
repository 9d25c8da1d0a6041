// SPDX-License-Identifier: Apache-2.0
// Files of 3-D Gaussians of every format are read or refused. What is read is valid, and a file written from it has as
// many Gaussians.
#include <array>

#include "scene/gaussians/gaussian_file.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  fuzz::Bytes bytes{data, size};
  constexpr std::array kWritten{".ply", ".compressed.ply", ".spz", ".glb"};
  const std::uint8_t choice = fuzz::take_byte(bytes);
  const auto path = fuzz::file_of(bytes, choice % 2 == 0 ? ".ply" : ".splat");  // other formats by their content
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
