// SPDX-License-Identifier: Apache-2.0
// Volumes of every format: read or refused; a volume that was read has as many voxels as it declares.
#include "scene/volume/volume_file.hpp"
#include "tests/fuzz/fuzz.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace fastsplat;
  static const char* const kEndings[] = {".nrrd", ".nhdr", ".nii", ".nii.gz", ".mha", ".mhd", ".hdr", ".vol"};
  fuzz::Bytes bytes{data, size};
  const std::string ending = kEndings[fuzz::take_byte(bytes) % 8];
  const auto path = fuzz::file_of(bytes, ending);
  fuzz::answered([&] { volume::read_volume_header(path); });
  fuzz::answered([&] {
    const volume::Volume read = volume::load_volume(path, {.nan_as = 0.0F});
    const auto voxels = static_cast<std::uint64_t>(read.dims.x) * static_cast<std::uint64_t>(read.dims.y) *
                        static_cast<std::uint64_t>(read.dims.z);
    if (read.voxels.size() != voxels) fuzz::finding("voxels that are not those of the header");
  });
  return 0;
}
