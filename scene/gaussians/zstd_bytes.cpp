// SPDX-License-Identifier: Apache-2.0
// Not in the lab's page, which has no libzstd (packed_absent.cpp).
#include <fmt/format.h>
#include <zstd.h>

#include "base/error.hpp"
#include "scene/gaussians/packed_bytes.hpp"

namespace fastsplat::scene {

std::string unpack_zstd(std::string_view packed, std::size_t size, const std::string& where) {
  const auto refuse = [&](const std::string& got) {
    throw_input({.where = where,
                 .what = "the compressed data is damaged",
                 .expected = fmt::format("a Zstandard frame of {} bytes", size),
                 .got = got,
                 .fix = "write or download the file again"});
  };
  // The frame's own size first, so that memory is only taken for a frame that agrees.
  const unsigned long long declared = ZSTD_getFrameContentSize(packed.data(), packed.size());
  if (declared == ZSTD_CONTENTSIZE_ERROR) refuse("no frame");
  if (declared != ZSTD_CONTENTSIZE_UNKNOWN && declared != size) refuse(fmt::format("one of {}", declared));
  std::string out(size, '\0');
  const std::size_t got = ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size());
  if (ZSTD_isError(got) != 0) refuse(ZSTD_getErrorName(got));
  if (got != size) refuse(fmt::format("one of {}", got));
  return out;
}

}  // namespace fastsplat::scene
