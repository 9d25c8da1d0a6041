#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "base/error.hpp"

namespace fastsplat {
namespace {

[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& reason) {
  throw_input({.where = path.string(),
               .what = "cannot write: " + reason,
               .expected = {},
               .got = {},
               .fix = "choose a writable folder with enough free space"});
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path_, ignored)) cannot_write(path_, "it is a directory");
  const auto folder = path_.has_parent_path() ? path_.parent_path() : std::filesystem::path(".");
  if (!std::filesystem::is_directory(folder, ignored)) cannot_write(path_, "the folder " + folder.string() + " does not exist");
  temporary_ = folder / ("." + path_.stem().string() + ".tmp" + std::to_string(::getpid()) + path_.extension().string());
  const int descriptor = ::open(temporary_.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0666);
  if (descriptor < 0) cannot_write(path_, std::strerror(errno));
  ::close(descriptor);
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
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
  committed_ = true;
}

void write_text_file(const std::filesystem::path& path, const std::string& text) {
  AtomicFile file(path);
  std::ofstream out(file.temporary(), std::ios::binary);
  out << text;
  out.close();
  if (!out) cannot_write(path, std::strerror(errno));
  file.commit();
}

}  // namespace fastsplat
