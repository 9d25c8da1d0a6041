// SPDX-License-Identifier: Apache-2.0
// Opens a file that the user named; every failure is reported in one line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

namespace fastsplat {

/// Throws UserError (Input) unless `path` is a readable, non-empty regular file. `fix_if_missing` ends the message for
/// a missing file; if empty, similar names in its folder are suggested.
void require_readable_file(const std::filesystem::path& path, const std::string& fix_if_missing = {});

/// The same, but the file may be empty.
void require_regular_file(const std::filesystem::path& path, const std::string& fix_if_missing = {});

/// The file's first bytes, at most `most`; empty unless it is a readable regular file.
std::string start_of(const std::filesystem::path& path, std::size_t most);

/// The whole file. Refuses files larger than `max_bytes`, or than a quarter of the address space, before reading them.
std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes = 1U << 20U);

}  // namespace fastsplat
