// SPDX-License-Identifier: Apache-2.0
// Replaces, in the lab's page, the readers whose libraries WebAssembly lacks.
#include "base/error.hpp"
#include "scene/gaussians/packed_bytes.hpp"
#include "scene/gaussians/sog_file.hpp"

namespace fastsplat::scene {

std::string unpack_zstd(std::string_view /*packed*/, std::size_t /*size*/, const std::string& where) {
  throw_input({.where = where,
               .what = "this page does not unpack Zstandard",
               .expected = ".spz of version 2 or 3, or another format",
               .got = ".spz of version 4",
               .fix = "convert it: fastsplat gaussians convert scene.spz scene.ply"});
}

void read_sog(const std::string& /*bytes*/, GaussianCloud& to) {
  throw_input({.where = to.source,
               .what = "this page does not decode WebP",
               .expected = "another format",
               .got = "SOG",
               .fix = "convert it: fastsplat gaussians convert scene.sog scene.ply"});
}
void read_sog_meta(const std::string& bytes, GaussianCloud& to) { read_sog(bytes, to); }

}  // namespace fastsplat::scene
