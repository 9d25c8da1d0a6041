#include "base/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
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

// Temporary files that exist now, where a signal handler can read them: fixed storage, no locks.
enum SlotState : int { Free, Claimed, Live };
struct Slot {
  std::atomic<int> state{Free};
  std::array<char, 4096> path{};
};
std::array<Slot, 64> unfinished;

// When all slots are taken or the path is too long, only an interrupt leaves the file behind.
void remember(const std::string& path) {
  if (path.size() >= unfinished[0].path.size()) return;
  for (auto& slot : unfinished) {
    int expected = Free;
    if (!slot.state.compare_exchange_strong(expected, Claimed)) continue;
    std::memcpy(slot.path.data(), path.c_str(), path.size() + 1);
    slot.state = Live;
    return;
  }
}

void forget(const std::string& path) {
  for (auto& slot : unfinished) {
    if (slot.state == Live && path == slot.path.data()) slot.state = Free;
  }
}

}  // namespace

void remove_unfinished_files() noexcept {
  for (auto& slot : unfinished) {
    if (slot.state == Live) ::unlink(slot.path.data());
  }
}

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)) {
  std::error_code ignored;
  // The rename must replace what a link points to, not the link, and never a device node or a protected file.
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
  remember(temporary_.string());
  const int descriptor = ::open(temporary_.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0666);
  if (descriptor < 0) {
    const int reason = errno;
    forget(temporary_.string());
    cannot_write(path_, std::strerror(reason));
  }
  ::close(descriptor);
}

AtomicFile::~AtomicFile() {
  if (committed_) return;
  std::error_code ignored;
  std::filesystem::remove(temporary_, ignored);
  forget(temporary_.string());
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
  forget(temporary_.string());
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
