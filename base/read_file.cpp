// SPDX-License-Identifier: Apache-2.0
#include "base/read_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <vector>

#include "base/error.hpp"
#include "base/machine_error.hpp"
#include "base/suggest.hpp"
#include "base/utf8.hpp"

namespace fastsplat {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& path, std::string what, std::string fix) {
  throw_input({.where = path.string(), .what = std::move(what), .expected = {}, .got = {}, .fix = std::move(fix)});
}

/// Missing and unreadable files: failures of the machine, as a sweep read them before.
[[noreturn]] void unreadable(const std::filesystem::path& path, std::string what, std::string fix) {
  throw_machine({.where = path.string(), .what = std::move(what), .expected = {}, .got = {}, .fix = std::move(fix)});
}

/// Suggests the most similar name in the folder, if any.
std::string similar_in_folder(const std::filesystem::path& path) {
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) return "the folder " + folder.string() + " does not exist";
  const std::string wanted = path.filename().string();
  if (wanted.find("\xef\xbf\xbd") != std::string::npos)
    return "the file's name is not UTF-8, so JSON holds U+FFFD: rename the file, then write the result again";
  std::string best;
  std::vector<std::string> names;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    names.push_back(entry->path().filename().string());
    if (!is_utf8(names.back())) names.pop_back();  // it cannot be typed, and may look the same
    if (names.size() == 10000) break;
  }
  std::sort(names.begin(), names.end());
  for (const auto& name : names) {
    if (may_mean(wanted, name) && (best.empty() || edit_distance(wanted, name) < edit_distance(wanted, best)))
      best = name;
  }
  return best.empty() ? "check the path" : "did you mean '" + (path.parent_path() / best).string() + "'?";
}

}  // namespace

namespace {

/// Its size in bytes. Refuses all but readable regular files.
off_t size_of_regular_file(const std::filesystem::path& path, const std::string& fix_if_missing) {
  // O_NONBLOCK: opening a pipe without a writer must not hang before it can be refused.
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) {
    const int reason = errno;
    if (reason == ENOENT)
      unreadable(path, "no such file", fix_if_missing.empty() ? similar_in_folder(path) : fix_if_missing);
    if (reason == EACCES) unreadable(path, "permission denied", "make it readable (chmod +r)");
    unreadable(path, std::string("cannot open: ") + std::strerror(reason), "check the path");
  }
  struct stat status {};
  const int outcome = ::fstat(descriptor, &status);
  ::close(descriptor);
  if (outcome != 0) unreadable(path, std::string("cannot read: ") + std::strerror(errno), "check the path");
  if (S_ISDIR(status.st_mode)) refuse(path, "a directory, not a file", "name a file inside it");
  if (!S_ISREG(status.st_mode)) refuse(path, "not a regular file", "save it to a file first");
  return status.st_size;
}

}  // namespace

void require_regular_file(const std::filesystem::path& path, const std::string& fix_if_missing) {
  size_of_regular_file(path, fix_if_missing);
}

void require_readable_file(const std::filesystem::path& path, const std::string& fix_if_missing) {
  if (size_of_regular_file(path, fix_if_missing) == 0) refuse(path, "the file is empty", "write or download it again");
}

std::string start_of(const std::filesystem::path& path, std::size_t most) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return {};
  std::ifstream file(path, std::ios::binary);
  std::string start(most, '\0');
  file.read(start.data(), static_cast<std::streamsize>(start.size()));
  start.resize(static_cast<std::size_t>(file.gcount()));
  return start;
}

std::string read_text_file(const std::filesystem::path& path, std::uint64_t max_bytes) {
  max_bytes = std::min<std::uint64_t>(max_bytes, std::numeric_limits<std::size_t>::max() / 4);
  require_readable_file(path);
  std::error_code error;
  const auto size = std::filesystem::file_size(path, error);
  if (error) unreadable(path, "cannot read: " + error.message(), "check the path");
  if (size > max_bytes) {
    throw_input({.where = path.string(),
                 .what = "the file is too large",
                 .expected = "at most " + std::to_string(max_bytes) + " bytes",
                 .got = std::to_string(size) + " bytes",
                 .fix = "check that this is the right file"});
  }
  std::ifstream in(path, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  in.read(text.data(), static_cast<std::streamsize>(size));
  if (!in) unreadable(path, "cannot read the whole file", "check the disk, then try again");
  return text;
}

}  // namespace fastsplat
