// SPDX-License-Identifier: Apache-2.0
#include "tests/process/process_helper.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace fastsplat::cli_test {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
constexpr auto kLongest = std::chrono::seconds(120);

struct Pipe {
  int read_end = -1, write_end = -1;
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe");
    read_end = ends[0];
    write_end = ends[1];
  }
  ~Pipe() {
    close_read();
    close_write();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  void close_read() { close_end(read_end); }
  void close_write() { close_end(write_end); }
  static void close_end(int& end) {
    if (end >= 0) ::close(end);
    end = -1;
  }
};

// Between fork and exec.
[[noreturn]] void become(const std::vector<std::string>& words, const Surroundings& surroundings, const Pipe& out,
                         const Pipe& err) {
  if (!surroundings.folder.empty() && ::chdir(surroundings.folder.c_str()) != 0) ::_exit(126);
  for (const auto& setting : surroundings.environment) ::putenv(::strdup(setting.c_str()));
  // A test runner in the background may have handed down ignored signals.
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGXFSZ}) ::signal(signal, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDWR);
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(surroundings.stdout_to ? ::open(surroundings.stdout_to->c_str(), O_WRONLY) : out.write_end, STDOUT_FILENO);
  ::dup2(err.write_end, STDERR_FILENO);
  if (surroundings.stdin_closed) ::close(STDIN_FILENO);
  if (surroundings.stdout_closed) ::close(STDOUT_FILENO);
  if (surroundings.stderr_closed) ::close(STDERR_FILENO);
  ::close(nothing);
  if (surroundings.largest_file) {
    const rlimit limit{*surroundings.largest_file, *surroundings.largest_file};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  std::vector<char*> arguments;
  for (const auto& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::execvp(arguments[0], arguments.data());
  ::_exit(127);
}

// Appends what the pipe holds now; closes it at its end.
void drain(int& end, std::string& to) {
  std::array<char, 1 << 16> buffer{};
  const ssize_t got = ::read(end, buffer.data(), buffer.size());
  if (got > 0) {
    to.append(buffer.data(), static_cast<std::size_t>(got));
  } else if (got == 0 || errno != EINTR) {
    Pipe::close_end(end);
  }
}

}  // namespace

TempFolder::TempFolder() {
  std::string pattern = (fs::temp_directory_path() / "fastsplat-test-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("mkdtemp: " + pattern);
  path_ = pattern;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::vector<std::string> TempFolder::entries() const {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(path_)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

std::string TempFolder::write(const std::string& name, const std::string& bytes) const {
  std::ofstream(path_ / name, std::ios::binary) << bytes;
  return *this / name;
}

std::string read_bytes(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

Result run_words(const std::vector<std::string>& words, const Surroundings& surroundings) {
  Pipe out, err;
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork");
  if (child == 0) become(words, surroundings, out, err);
  out.close_write();
  err.close_write();

  Result result;
  bool signalled = surroundings.signal == 0;
  const auto deadline = Clock::now() + kLongest;
  while (out.read_end >= 0 || err.read_end >= 0) {
    std::array<pollfd, 2> ends{{{out.read_end, POLLIN, 0}, {err.read_end, POLLIN, 0}}};
    ::poll(ends.data(), ends.size(), 20);
    if (ends[0].revents != 0) drain(out.read_end, result.out);
    if (ends[1].revents != 0) drain(err.read_end, result.err);
    const bool enough = surroundings.stop_reading_after >= 0 &&
                        result.out.size() >= static_cast<std::size_t>(surroundings.stop_reading_after);
    if (enough) out.close_read();
    if (!signalled && surroundings.when(child)) {
      ::kill(child, surroundings.signal);
      signalled = true;
    }
    if (Clock::now() > deadline) {
      ::kill(child, SIGKILL);
      result.timed_out = true;
      break;
    }
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) result.code = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result.signal = WTERMSIG(status);
  return result;
}

bool handles_signal(pid_t process, int signal) {
  const std::string status = read_bytes("/proc/" + std::to_string(process) + "/status");
  const auto at = status.find("SigCgt:");
  if (at == std::string::npos) return false;
  const auto caught = std::strtoull(status.c_str() + at + 7, nullptr, 16);
  return (caught >> (signal - 1) & 1u) != 0;
}

std::string program() { return FASTSPLAT_PROGRAM; }

Result fastsplat(const std::vector<std::string>& arguments, const Surroundings& surroundings) {
  std::vector<std::string> words{program()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_words(words, surroundings);
}

void expect_error(const Result& result, int code, const std::vector<std::string>& words) {
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, 0) << "crashed";
  EXPECT_EQ(result.code, code) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  EXPECT_EQ(result.err.rfind("fastsplat: error: ", 0), 0u) << result.err;
  EXPECT_NE(result.err.find("; "), std::string::npos) << "no fix in: " << result.err;
  for (const auto& word : words)
    EXPECT_NE(result.err.find(word), std::string::npos) << "'" << word << "' is not in: " << result.err;
}

void expect_success(const Result& result) {
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.signal, 0) << "crashed";
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(result.err.find("error:"), std::string::npos) << result.err;
}

TinyDisk::TinyDisk(const fs::path& folder, int bytes) : folder_(folder) {
  fs::create_directories(folder_);
  const std::string options = "size=" + std::to_string(bytes);
  mounted_ = ::mount("tmpfs", folder_.c_str(), "tmpfs", 0, options.c_str()) == 0;
  if (!mounted_) reason_ = std::string("may not mount a tmpfs: ") + std::strerror(errno);
}

TinyDisk::~TinyDisk() {
  if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
}

}  // namespace fastsplat::cli_test
