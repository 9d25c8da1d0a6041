// SPDX-License-Identifier: Apache-2.0
#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/error.hpp"
#include "base/machine_error.hpp"

namespace fastsplat {
namespace {

[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& reason) {
  throw_machine({.where = path.string(),
                 .what = "cannot write: " + reason,
                 .expected = {},
                 .got = {},
                 .fix = "choose a writable folder with enough free space"});
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  // The rename must replace a link's target, not the link, and never a device node or a protected file.
  for (int links = 0; links < 40 && std::filesystem::is_symlink(path_, ignored); ++links) {
    path_ =
        path_.parent_path() / std::filesystem::read_symlink(path_, ignored);  // an absolute target replaces the folder
  }
  const auto status = std::filesystem::status(path_, ignored);
  if (std::filesystem::is_directory(status)) cannot_write(path_, "it is a directory");
  if (std::filesystem::exists(status)) {
    if (!std::filesystem::is_regular_file(status)) cannot_write(path_, "it is not a regular file");
    if (::access(path_.c_str(), W_OK) != 0) cannot_write(path_, std::strerror(errno));
  }
  const auto folder = path_.has_parent_path() ? path_.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, ignored))
    cannot_write(path_, "the folder " + folder.string() + " does not exist");
  temporary_ = folder / (".tmp" + std::to_string(::getpid()) + "." + path_.filename().string());
  unfinished_.emplace(temporary_);
  const int descriptor = ::open(temporary_.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0666);
  if (descriptor < 0) cannot_write(path_, std::strerror(errno));
  ::close(descriptor);
}

void AtomicFile::commit() {
  const int descriptor = ::open(temporary_.c_str(), O_RDONLY);
  if (descriptor < 0) cannot_write(path_, std::strerror(errno));
  const int status = ::fsync(descriptor);
  const int reason = errno;
  ::close(descriptor);
  if (status != 0 && reason != EINVAL) cannot_write(path_, std::strerror(reason));
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) cannot_write(path_, error.message());
  unfinished_->keep();
}

void write_text_file(const std::filesystem::path& path, const std::string& text) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (std::filesystem::is_character_file(status) || std::filesystem::is_fifo(status)) {
    std::ofstream device(path, std::ios::binary);
    device << text;
    device.close();
    if (!device) cannot_write(path, std::strerror(errno));
    return;
  }
  AtomicFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  out << text;
  out.close();
  if (!out) cannot_write(path, std::strerror(errno));
  file.commit();
}

}  // namespace fastsplat
