// Opening what the user named, with every way that can fail told in one line.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace fastsplat {

/// Throws UserError (Input) unless `path` is a readable, non-empty regular file. `fix_if_missing` ends the message for
/// a file that is not there; empty: similar names in its folder are offered.
void require_readable_file(const std::filesystem::path& path, const std::string& fix_if_missing = {});

/// The same, but empty is well.
void require_regular_file(const std::filesystem::path& path, const std::string& fix_if_missing = {});

/// The file's first bytes, at most `most`; none of what is not a regular file that can be read.
std::string start_of(const std::filesystem::path& path, std::size_t most);

/// The whole file; also refuses files above `max_bytes` before reading them.
std::string read_text_file(const std::filesystem::path& path, std::size_t max_bytes = std::size_t{1} << 20);

}  // namespace fastsplat
