// SPDX-License-Identifier: Apache-2.0
// Compressed parts of files of Gaussians, unpacked with bounded memory.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fastsplat::scene {

/// The most that a file of Gaussians may grow when it is unpacked. Trained scenes grow by less than 20.
inline constexpr std::uint64_t kMostGrowth = 256;

/// Throws UserError (Input) if `unpacked` bytes are more than a file of `packed` bytes can plausibly hold.
void check_growth(std::uint64_t unpacked, std::uint64_t packed, const std::string& where);

bool is_gzip(std::string_view bytes);
/// The first bytes of a gzip file, at most `most`; fewer if it is damaged.
std::string start_of_gzip(std::string_view packed, std::size_t most);
/// The first `most` bytes of a gzip file, or all of it. Throws UserError (Input) if it is damaged before them.
std::string gunzip(std::string_view packed, std::size_t most, const std::string& where);
std::string gzip(const std::string& bytes);

/// A Zstandard frame that holds exactly `size` bytes. Throws UserError (Input) for other sizes and damage.
std::string unpack_zstd(std::string_view packed, std::size_t size, const std::string& where);

}  // namespace fastsplat::scene
