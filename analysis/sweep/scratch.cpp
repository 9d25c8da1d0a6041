// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/scratch.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "base/machine_error.hpp"

namespace fastsplat::plan {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot_write(const fs::path& path, int reason) {
  throw_machine({.where = path.string(),
                 .what = std::string("cannot write: ") + std::strerror(reason),
                 .expected = {},
                 .got = {},
                 .fix = "choose a writable folder with enough free space (--results)"});
}

std::string host() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return "host";
  return name.data();
}

/// Locks a folder without waiting; -1 if another process holds the lock.
int lock_of(const fs::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return -1;
  if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  ::close(descriptor);
  return -1;
}

void remove_left_behind(const fs::path& all, const std::string& own) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(all, ignored)) {
    if (!entry.path().filename().string().starts_with(own)) continue;
    const int lock = lock_of(entry.path());
    if (lock < 0) continue;
    fs::remove_all(entry.path(), ignored);
    ::close(lock);
  }
}

}  // namespace

Scratch::Scratch(const fs::path& folder) {
  const fs::path all = folder / ".scratch";
  std::error_code error;
  make_folder(all);
  const std::string own = host() + ".";
  remove_left_behind(all, own);
  // Another process may remove a new folder that is not locked yet, as left behind.
  for (int tries = 0; tries < 100 && lock_ < 0; ++tries) {
    std::string name = (all / (own + "XXXXXX")).string();
    if (::mkdtemp(name.data()) == nullptr) cannot_write(folder, errno);
    path_ = name;
    lock_ = lock_of(path_);
    if (lock_ >= 0 && !fs::exists(path_, error)) {
      ::close(lock_);
      lock_ = -1;
    }
  }
  if (lock_ < 0) cannot_write(all, EBUSY);
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
  ::close(lock_);
}

void Scratch::make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) cannot_write(folder, error.value());
}

fs::path Scratch::fresh(const std::string& name) const {
  const fs::path folder = path_ / name;
  std::error_code error;
  fs::remove_all(folder, error);
  fs::create_directory(folder, error);
  if (error) cannot_write(folder, error.value());
  return folder;
}

void Scratch::publish(const fs::path& file, const fs::path& as) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) cannot_write(file, errno);
  const int status = ::fsync(descriptor);
  const int reason = errno;
  ::close(descriptor);
  if (status != 0 && reason != EINVAL) cannot_write(as, reason);
  std::error_code error;
  fs::rename(file, as, error);
  if (error) cannot_write(as, error.value());
}

}  // namespace fastsplat::plan
